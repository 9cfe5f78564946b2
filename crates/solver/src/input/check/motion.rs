//! Faults of what moves or is held: obstacles, rigid parts, constraints, and the curves that they follow.
//! Loads are in `load.rs`.

use super::Check;
use crate::contact::messages::OBSTACLE;
use crate::expression::Expression;
use crate::load::curve::Curve;
use crate::load::messages::{BEGINNING, CURVE, CURVE_DIMENSION, EXPRESSION, INERTIA, JUMP, NO_EFFECT, PRESCRIBED_TWICE, RIGID};
use crate::mesh::messages::SHELLS;
use crate::model::Sine;
use crate::model::messages::{LIST_LENGTH, LIST_ORDER, OF_REVOLUTION, PERIOD, UNKNOWN_NAME};
use crate::model::reference::{Reference, Wanted};
use crate::model::{Constraint, CurveShape, Drive, Motion, Obstacle, ObstacleShape, Part, RadialVelocity};
use crate::quantity::{Dimension, Range};
use crate::vocabulary::excerpt;
use crate::vocabulary::suggestion;

/// Intervals of a run at whose ends formulas are tried.
const SAMPLES: u32 = 1000;
/// Names of the degrees of freedom.
const AXES: [&str; 3] = ["x", "y", "rotation"];
/// Components of a vector.
const STRAIGHT: [&str; 3] = ["x", "y", "z"];

impl Check<'_> {
    pub(super) fn curves(&mut self) {
        let model = self.model;
        for (name, curve) in &model.curves {
            let path = format!("curve.{name}");
            self.name(&path, name);
            if name == "free" || !name.starts_with(char::is_alphabetic) {
                let message = format!("a curve can't be called `{}`", excerpt(name));
                self.fault(&CURVE, path.as_str(), message, "its name must begin with a letter, and `free` means something else");
            }
            match &curve.shape {
                CurveShape::Table { times, values, .. } => self.table(&path, times, values),
                CurveShape::Sine(sine) => self.sine(&format!("{path}.sine"), sine),
                CurveShape::Expression(text) => self.expression(&format!("{path}.expression"), text),
            }
        }
    }

    fn table(&mut self, path: &str, times: &[f64], values: &[f64]) {
        let [times_path, values_path] = ["time", "value"].map(|key| format!("{path}.{key}"));
        self.each(&times_path, times);
        self.each(&values_path, values);
        if times.is_empty() {
            self.fault(&CURVE, times_path.as_str(), "the curve has no point", "give at least one time and its value");
        }
        if times.len() != values.len() {
            let message = format!("there are {} times, but {} values", times.len(), values.len());
            self.fault(&LIST_LENGTH, values_path, message, "give one value for each time");
        }
        self.ascending(&times_path, "times", times, "s");
    }

    fn sine(&mut self, path: &str, sine: &Sine) {
        self.within(&format!("{path}.frequency"), sine.frequency, Dimension::RATE, Range::Positive);
        for (key, value) in [("amplitude", sine.amplitude), ("phase", sine.phase), ("offset", sine.offset)] {
            self.within(&format!("{path}.{key}"), value, Dimension::NONE, Range::Finite);
        }
    }

    /// A formula must be one, and have a value at all times of the run.
    fn expression(&mut self, path: &str, text: &str) {
        let formula = match Expression::parse(text) {
            Ok(formula) => formula,
            Err(wrong) => {
                let message = format!("at character {} of `{}`: {}", wrong.at, excerpt(text), wrong.message);
                return self.fault(&EXPRESSION, path, message, "write it like \"2*sin(3*t) + exp(-t)\", with the time t in s");
            }
        };
        let end = if self.model.run.end.is_finite() { self.model.run.end.max(0.0) } else { 0.0 };
        let times = (0..=SAMPLES).map(|k| end * f64::from(k) / f64::from(SAMPLES));
        if let Some((time, value)) = times.map(|time| (time, formula.value(time))).find(|(_, value)| !value.is_finite()) {
            let what = if value.is_nan() { "not a number".to_string() } else { value.to_string() };
            self.fault(
                &EXPRESSION,
                path,
                format!("`{}` is {what} at {time} s", excerpt(text)),
                "give a formula with a finite value from the start to `run.end`",
            );
        }
    }

    /// Numbers of a list.
    pub(super) fn each(&mut self, path: &str, values: &[f64]) {
        for (index, value) in values.iter().enumerate() {
            self.number(&format!("{path}[{index}]"), *value);
        }
    }

    /// The first place where a list does not ascend.
    pub(super) fn ascending(&mut self, path: &str, what: &str, values: &[f64], unit: &str) {
        if let Some(at) = values.windows(2).position(|pair| pair[1] <= pair[0]) {
            let message = format!("{} {unit} does not follow {} {unit}: the {what} must ascend", values[at + 1], values[at]);
            self.fault(&LIST_ORDER, format!("{path}[{}]", at + 1), message, "give each of them once, in ascending order");
        }
    }

    /// Times of beginning and end.
    pub(super) fn window(&mut self, path: &str, [from, until]: [&str; 2], active: [f64; 2]) {
        self.within(&format!("{path}.{from}"), active[0], Dimension::TIME, Range::NotNegative);
        let path = format!("{path}.{until}");
        if active[1] == f64::INFINITY {
            return;
        }
        self.within(&path, active[1], Dimension::TIME, Range::Positive);
        if active[1] > 0.0 && active[1] <= active[0] {
            let message = format!("it ends at {} s, not after its beginning at {} s", active[1], active[0]);
            self.fault(&PERIOD, path, message, format!("give a later `{until}` or an earlier `{from}`"));
        }
    }

    /// A prescribed velocity: a finite number, or a curve of the right dimension.
    pub(super) fn drive(&mut self, path: &str, drive: &Drive, dimension: Dimension) {
        let model = self.model;
        let name = match drive {
            Drive::Constant(velocity) => return self.within(path, *velocity, dimension, Range::Finite),
            Drive::Curve(name) => name,
        };
        let Some(curve) = model.curves.get(name) else {
            let known: Vec<&str> = model.curves.keys().map(String::as_str).collect();
            let help = if known.is_empty() {
                format!("add [curve.{}], for example with `time` and `value`, or give a number", excerpt(name))
            } else {
                suggestion(name, &known)
            };
            return self.fault(&UNKNOWN_NAME, path, format!("there is no curve `{}`", excerpt(name)), help);
        };
        if let Some(other) = curve.dimension.filter(|other| *other != dimension) {
            let key = path.rsplit('.').next().unwrap_or(path);
            let unit = if other == Dimension::NONE { "pure numbers".to_string() } else { format!("in {other}") };
            let wanted = if dimension == Dimension::RATE { "rad/s".to_string() } else { dimension.unit() };
            let message = format!("the values of curve `{}` are {unit}, but `{key}` is in {wanted}", excerpt(name));
            self.fault(&CURVE_DIMENSION, path, message, "take a curve of the right dimension, or give its values as numbers without units");
        }
    }

    /// How a rigid body moves, and how it begins where it is free.
    fn motion(&mut self, body: &str, key: &str, motion: &Motion, velocity: [f64; 3], spin: f64) {
        let drives = drives(motion);
        for ((axis, drive), dimension) in AXES.iter().zip(drives).zip([Dimension::VELOCITY, Dimension::VELOCITY, Dimension::RATE]) {
            if let Some(drive) = drive {
                self.drive(&format!("{body}.{key}.{axis}"), drive, dimension);
            }
        }
        let begins = [("velocity[0]", velocity[0]), ("velocity[1]", velocity[1]), ("spin", spin)];
        if self.model.is_axisymmetric() {
            let help = "leave it out: it moves along its axis y only";
            for k in [0, 2] {
                let (axis, (begin, value)) = (AXES[k], begins[k]);
                let asked = drives[k].is_some_and(|drive| *drive != Drive::Constant(0.0));
                if asked || (key == "motion" && drives[k].is_none()) {
                    let message = format!("`{axis}` of a rigid axisymmetric body can't be prescribed or free");
                    self.fault(&OF_REVOLUTION, format!("{body}.{key}.{axis}"), message, help);
                } else if drives[k].is_none() && value != 0.0 {
                    let message = format!("a rigid axisymmetric body can't begin with a motion in `{axis}`");
                    self.fault(&OF_REVOLUTION, format!("{body}.{begin}"), message, help);
                }
            }
        }
        for ((axis, drive), (begin, value)) in AXES.iter().zip(drives).zip(begins) {
            if drive.is_some() && value != 0.0 && value.is_finite() {
                let message = format!("`{axis}` is not free, so it can't begin with {value}");
                self.fault(
                    &BEGINNING,
                    format!("{body}.{begin}"),
                    message,
                    format!("leave it out, or write `{axis} = \"free\"` in `{key}`"),
                );
            }
        }
    }

    /// Initial motion of a part, and how it moves if it is rigid.
    pub(super) fn part_motion(&mut self, path: &str, part: &Part) {
        self.vector(&format!("{path}.velocity"), part.velocity);
        self.number(&format!("{path}.spin"), part.spin);
        self.direction(&format!("{path}.spin_axis"), part.spin_axis);
        part.spin_centre.iter().for_each(|centre| self.vector(&format!("{path}.spin_centre"), *centre));
        part.radial_velocity.iter().for_each(|radial| self.radial_velocity(path, part, radial));
        if part.is_axisymmetric() && part.spin != 0.0 && part.rigid.is_none() {
            let message = "`spin` rotates a part in its plane, which an axisymmetric body can't";
            self.fault(
                &OF_REVOLUTION,
                format!("{path}.spin"),
                message,
                "leave it out; for a rotation about the axis take the load `centrifugal`",
            );
        }
        if let Some(motion) = &part.rigid {
            self.motion(path, "rigid", motion, part.velocity, part.spin);
        }
    }

    /// Velocities away from a point or an axis.
    fn radial_velocity(&mut self, part_path: &str, part: &Part, radial: &RadialVelocity) {
        let path = format!("{part_path}.radial_velocity");
        self.number(&format!("{path}.speed"), radial.speed);
        self.number(&format!("{path}.rate"), radial.rate);
        self.vector(&format!("{path}.centre"), radial.centre);
        radial.axis.iter().for_each(|axis| self.direction(&format!("{path}.axis"), *axis));
        if part.rigid.is_some() {
            let help = "leave one of them out; a rigid part moves by `velocity` and `spin`";
            self.fault(&BEGINNING, path, "a rigid part can't go apart", help);
        } else if part.is_axisymmetric() && (radial.axis.is_some() || radial.centre[0] != 0.0) {
            let message = "in an axisymmetric part it points away from a point of the axis x = 0";
            self.fault(
                &OF_REVOLUTION,
                path,
                message,
                "let `centre` be [0, y], without `axis`; away from the axis itself `velocity` = [v, 0] points",
            );
        }
    }

    pub(super) fn obstacles(&mut self) {
        let model = self.model;
        self.names("obstacle", model.obstacles.iter().map(|obstacle| obstacle.name.as_str()));
        for (index, obstacle) in model.obstacles.iter().enumerate() {
            let path = format!("obstacle[{index}]");
            self.part_list(&format!("{path}.parts"), &obstacle.parts);
            self.with_surface(&format!("{path}.parts"), &obstacle.parts);
            self.obstacle_shape(&path, &obstacle.shape);
            self.obstacle_motion(&path, obstacle);
            self.interface(&path, &obstacle.interface);
            self.pushes_no_shells(&path, &obstacle.interface, &obstacle.parts);
            if drives(&obstacle.motion).iter().all(Option::is_some) && self.all_driven(&obstacle.parts) {
                self.nothing_gives_way(format!("{path}.parts"));
            }
        }
    }

    fn obstacle_shape(&mut self, path: &str, shape: &ObstacleShape) {
        match shape {
            ObstacleShape::Plane { point, normal, length } => {
                self.vector(&format!("{path}.plane.point"), *point);
                self.direction(&format!("{path}.plane.normal"), *normal);
                if let Some(length) = length {
                    self.number(&format!("{path}.plane.length"), *length);
                }
            }
            ObstacleShape::Circle { centre, radius, .. } => {
                self.vector(&format!("{path}.circle.centre"), *centre);
                self.number(&format!("{path}.circle.radius"), *radius);
            }
            ObstacleShape::Sphere { centre, radius, .. } => {
                self.vector(&format!("{path}.sphere.centre"), *centre);
                self.number(&format!("{path}.sphere.radius"), *radius);
            }
            ObstacleShape::Cylinder { point, axis, radius, .. } => {
                self.vector(&format!("{path}.cylinder.point"), *point);
                self.direction(&format!("{path}.cylinder.axis"), *axis);
                self.number(&format!("{path}.cylinder.radius"), *radius);
            }
            ObstacleShape::Triangles(surface) => {
                self.faults.extend(
                    surface.faults().into_iter().map(|fault| crate::error::Fault { path: format!("{path}.{}", fault.path), ..fault }),
                );
            }
            ObstacleShape::Polyline { points } => self.polyline(&format!("{path}.polyline.points"), points),
        }
    }

    fn polyline(&mut self, path: &str, points: &[[f64; 2]]) {
        for (index, point) in points.iter().enumerate() {
            self.vector(&format!("{path}[{index}]"), *point);
        }
        if points.len() < 2 {
            self.fault(&OBSTACLE, path, format!("a polyline needs at least 2 points, but there are {}", points.len()), "");
        }
        let equal: Vec<usize> = points.windows(2).enumerate().filter(|(_, pair)| pair[0] == pair[1]).map(|(at, _)| at + 1).collect();
        for at in &equal {
            let message = format!("point {at} is the same as the one before it, so there is no line between them");
            self.fault(&OBSTACLE, format!("{path}[{at}]"), message, "leave one of the two out");
        }
        if points.len() == 3 && points[0] == points[2] && equal.is_empty() {
            self.fault(
                &OBSTACLE,
                path,
                "the polyline goes back on its own line, so it has no free side",
                "a closed one needs at least 3 different points",
            );
        }
    }

    /// How an obstacle moves; mass and inertia where it is free.
    fn obstacle_motion(&mut self, path: &str, obstacle: &Obstacle) {
        self.vector(&format!("{path}.velocity"), obstacle.velocity);
        self.number(&format!("{path}.spin"), obstacle.spin);
        self.motion(path, "motion", &obstacle.motion, obstacle.velocity, obstacle.spin);
        if let Some(reference) = obstacle.reference {
            self.vector(&format!("{path}.reference"), reference);
        }
        let moves = obstacle.motion.velocity[..self.model.dimension()].iter().any(Option::is_none);
        let turns = obstacle.motion.spin.is_none();
        for (key, value, free, verb, axes, example) in [
            ("mass", obstacle.mass, moves, "move", "`x` or `y`", "10 kg/m"),
            ("inertia", obstacle.inertia, turns, "turn", "`rotation`", "0.1 kg m"),
        ] {
            let path = format!("{path}.{key}");
            match value {
                Some(value) if free => self.number(&path, value),
                Some(_) => {
                    let message = format!("`{key}` has no effect, because the obstacle is not free to {verb}");
                    self.fault(&INERTIA, path, message, format!("leave it out, or let {axes} be \"free\" in `motion`"));
                }
                None if free => {
                    let message = format!("the obstacle is free to {verb}, so it needs `{key}`");
                    self.fault(&INERTIA, path, message, format!("add `{key} = \"{example}\"`, or prescribe {axes} in `motion`"));
                }
                None => {}
            }
        }
    }

    pub(super) fn constraints(&mut self) {
        let model = self.model;
        for (index, constraint) in model.constraints.iter().enumerate() {
            let path = format!("constraint[{index}]");
            let on = self.reference(&format!("{path}.on"), &constraint.on, Wanted::Nodes);
            if let Some(Reference::Part(part) | Reference::Side { part, .. }) = on
                && model.parts[part].rigid.is_some()
            {
                let message =
                    format!("part `{}` is rigid, so its nodes can't be held or moved one by one", excerpt(&model.parts[part].name));
                self.fault(
                    &RIGID,
                    format!("{path}.on"),
                    message,
                    "prescribe its motion: `rigid = { x = 0, y = 0, rotation = 0 }` holds it",
                );
            }
            // What is clamped may be a set of other parts too.
            if constraint.spin.iter().flatten().any(|spin| *spin != Drive::Constant(0.0)) {
                self.rotates(&format!("{path}.on"), on.as_ref());
            }
            self.prescribed(&path, constraint);
        }
    }

    /// A set whose nodes shall have rotations.
    pub(super) fn rotates(&mut self, path: &str, on: Option<&Reference>) {
        if let Some(Reference::Part(part) | Reference::Side { part, .. }) = on {
            let part = &self.model.parts[*part];
            if !part.has_rotations() {
                let message = format!("nodes of part `{}` have no rotations", excerpt(&part.name));
                self.fault(&SHELLS, path, message, "name a set of a part of shells or beams; on others couples are pairs of forces");
            } else if part.rigid.is_some() {
                let message = format!("part `{}` is rigid: its nodes rotate with it", excerpt(&part.name));
                self.fault(&SHELLS, path, message, "prescribe its motion, or let a pair of forces act on it");
            }
        }
    }

    /// What a constraint prescribes.
    fn prescribed(&mut self, path: &str, constraint: &Constraint) {
        let kinds = [
            ("velocity", &constraint.velocity, Dimension::VELOCITY),
            ("displacement", &constraint.displacement, Dimension::LENGTH),
            ("acceleration", &constraint.acceleration, Dimension::ACCELERATION),
        ];
        for (key, drives, dimension) in kinds {
            for (axis, drive) in STRAIGHT.iter().zip(drives) {
                if let Some(drive) = drive {
                    self.drive(&format!("{path}.{key}.{axis}"), drive, dimension);
                }
            }
        }
        for (axis, drive) in STRAIGHT.iter().zip(&constraint.displacement) {
            if let Some(drive) = drive {
                self.begins_with_zero(format!("{path}.displacement.{axis}"), drive);
            }
        }
        for axis in 0..3 {
            let several: Vec<&str> = kinds.iter().filter(|(_, drives, _)| drives[axis].is_some()).map(|(key, ..)| *key).collect();
            if let [first, second, ..] = several[..] {
                let message = format!("`{}` is prescribed by both `{first}` and `{second}`", STRAIGHT[axis]);
                self.fault(&PRESCRIBED_TWICE, format!("{path}.{second}.{}", STRAIGHT[axis]), message, "leave it out of one of the two");
            }
        }
        for (axis, drive) in STRAIGHT.iter().zip(&constraint.spin) {
            if let Some(drive) = drive {
                self.drive(&format!("{path}.spin.{axis}"), drive, Dimension::RATE);
            }
        }
        let spins = constraint.spin.iter().any(Option::is_some);
        let straight = kinds.iter().any(|(_, drives, _)| drives.iter().any(Option::is_some));
        if let Some(rotation) = &constraint.rotation {
            self.axis(&format!("{path}.rotation"), &rotation.about);
            self.drive(&format!("{path}.rotation.speed"), &rotation.speed, Dimension::RATE);
            if straight || spins {
                let message = "nodes with a prescribed rotation can't have another prescribed motion as well";
                self.fault(&PRESCRIBED_TWICE, format!("{path}.rotation"), message, "leave one of the two out");
            }
        } else if !straight && !spins {
            self.fault(
                &NO_EFFECT,
                path,
                "the constraint leaves both components free, so it does nothing",
                "add `fixed = \"x\"` or `velocity = { x = \"1 m/s\" }`",
            );
        }
    }

    /// Nodes begin where they are: a displacement must begin with zero.
    fn begins_with_zero(&mut self, path: String, drive: &Drive) {
        match drive {
            Drive::Constant(value) if *value != 0.0 && value.is_finite() => {
                let message = "a displacement that is the same at all times would move the nodes at once";
                self.fault(&JUMP, path, message, "name a curve that begins with 0, or use `fixed`");
            }
            Drive::Constant(_) => {}
            Drive::Curve(name) => {
                let Some(curve) = self.model.curves.get(name) else { return };
                let curve = Curve::new(curve);
                let (begin, later) = (curve.value(0.0), curve.value(self.model.run.end));
                if begin.is_finite() && begin.abs() > 1e-12 * later.abs() {
                    let message = format!("curve `{}` begins with {begin} m, so it would move the nodes at once", excerpt(name));
                    self.fault(&JUMP, path, message, "let it be 0 at time 0");
                }
            }
        }
    }
}

/// Whether a part is rigid and free in nothing.
pub(super) fn is_driven(part: &Part) -> bool {
    // Of an axisymmetric body there is only y to ask for.
    let reported =
        |motion: &Motion| if part.is_axisymmetric() { drives(motion)[1].is_some() } else { drives(motion).iter().all(Option::is_some) };
    part.rigid.as_ref().is_some_and(reported)
}

fn drives(motion: &Motion) -> [Option<&Drive>; 3] {
    [motion.velocity[0].as_ref(), motion.velocity[1].as_ref(), motion.spin.as_ref()]
}
