//! A model in 2D has nothing out of it: third components are zero, and what turns turns about z.

use super::Check;
use crate::model::messages::THIRD;
use crate::model::{Axis, Drive, Image, Load, Motion, ObstacleShape, ProbeAt};

/// What to do.
const HELP: &str = "leave it out, or make the parts solid: `extrude` them, or give them a 3D shape";

const NO_Z: &str = "there is no `z` in 2D";

impl Check<'_> {
    /// Faults of what points out of the plane.
    pub(super) fn nothing_out_of_2d(&mut self) {
        let model = self.model;
        for (index, part) in model.parts.iter().enumerate() {
            self.flat(&format!("part[{index}].velocity"), part.velocity);
            part.spin_centre.iter().for_each(|centre| self.flat(&format!("part[{index}].spin_centre"), *centre));
            self.along_z(&format!("part[{index}].spin_axis"), part.spin_axis, "rotations in 2D are about z");
            if let Some(radial) = &part.radial_velocity {
                let path = format!("part[{index}].radial_velocity");
                self.flat(&format!("{path}.centre"), radial.centre);
                radial.axis.iter().for_each(|axis| self.along_z(&format!("{path}.axis"), *axis, "an axis in 2D is along z"));
            }
            // What is left out is free: who holds z has written it.
            if part.rigid.as_ref().is_some_and(|motion| motion.velocity[2].is_some()) {
                self.third(format!("part[{index}].rigid.z"), NO_Z);
            }
        }
        for (index, symmetry) in model.symmetries.iter().enumerate() {
            self.flat(&format!("symmetry[{index}].point"), symmetry.point);
            self.flat(&format!("symmetry[{index}].normal"), symmetry.normal);
        }
        for (index, constraint) in model.constraints.iter().enumerate() {
            let path = format!("constraint[{index}]");
            let kinds = [
                ("velocity", &constraint.velocity),
                ("displacement", &constraint.displacement),
                ("acceleration", &constraint.acceleration),
            ];
            for (key, drives) in kinds {
                if let Some(drive) = &drives[2] {
                    // What is held is written in short.
                    let held = key == "velocity" && *drive == Drive::Constant(0.0);
                    let place = if held { format!("{path}.fixed") } else { format!("{path}.{key}.z") };
                    self.third(place, NO_Z);
                }
            }
            for (axis, spin) in ["x", "y"].iter().zip(&constraint.spin) {
                // What is clamped is written in short.
                if spin.as_ref().is_some_and(|spin| *spin != Drive::Constant(0.0)) {
                    self.third(format!("{path}.spin.{axis}"), "rotations in 2D are about z");
                }
            }
            constraint.rotation.iter().for_each(|rotation| self.flat_axis(&format!("{path}.rotation"), &rotation.about));
        }
        for (index, load) in model.loads.iter().enumerate() {
            let path = format!("load[{index}]");
            match load {
                Load::Gravity { acceleration, .. } => self.flat(&format!("{path}.gravity"), *acceleration),
                Load::Centrifugal { about, .. } => self.flat_axis(&path, about),
                Load::Force { force, .. } => self.flat(&format!("{path}.force"), *force),
                Load::Moment { moment: [x, y, _], .. } => {
                    if [*x, *y] != [0.0; 2] {
                        self.third(format!("{path}.moment"), "moments in 2D are about z");
                    }
                }
                Load::Pressure { .. } | Load::Damping { .. } | Load::StiffnessDamping { .. } => {}
            }
        }
        for (index, join) in model.joins.iter().enumerate() {
            match &join.image {
                Image::Same => {}
                Image::Translated(by) => self.flat(&format!("join[{index}].translation"), *by),
                Image::Turned { about, .. } => self.flat_axis(&format!("join[{index}]"), about),
            }
        }
        for (index, obstacle) in model.obstacles.iter().enumerate() {
            let path = format!("obstacle[{index}]");
            match &obstacle.shape {
                ObstacleShape::Plane { point, normal, .. } => {
                    self.flat(&format!("{path}.plane.point"), *point);
                    self.flat(&format!("{path}.plane.normal"), *normal);
                }
                ObstacleShape::Circle { centre, .. } => self.flat(&format!("{path}.circle.centre"), *centre),
                ObstacleShape::Polyline { .. } => {}
                ObstacleShape::Sphere { .. } => self.third(format!("{path}.sphere"), "there are no spheres in 2D; take `circle`"),
                ObstacleShape::Triangles(_) => self.third(format!("{path}.stl"), "a surface of triangles is a 3D one; take `polyline`"),
                ObstacleShape::Cylinder { .. } => self.third(format!("{path}.cylinder"), "there are no cylinders in 2D; take `circle`"),
            }
            obstacle.reference.iter().for_each(|reference| self.flat(&format!("{path}.reference"), *reference));
            self.flat(&format!("{path}.velocity"), obstacle.velocity);
            self.flat_motion(&format!("{path}.motion"), &obstacle.motion);
        }
        for (index, probe) in model.probes.iter().enumerate() {
            if let ProbeAt::Point { point, .. } = &probe.at {
                self.flat(&format!("probe[{index}].point"), *point);
            }
        }
        if model.output.camera.is_some() {
            self.third("output.camera".into(), "pictures of 2D models are seen along z: they have no camera");
        }
        if model.output.mirror[2] {
            self.third("output.mirror".into(), "a picture of a 2D model has no other half at z = 0");
        }
    }

    /// A vector without a third component; one that is no number has its fault already.
    fn flat(&mut self, path: &str, vector: [f64; 3]) {
        if vector[2] != 0.0 && vector[2].is_finite() {
            self.third(format!("{path}[2]"), "a 2D vector has no third component");
        }
    }

    fn flat_axis(&mut self, path: &str, axis: &Axis) {
        self.flat(&format!("{path}.centre"), axis.centre);
        self.along_z(&format!("{path}.axis"), axis.direction, "rotations in 2D are about z");
    }

    /// A direction out of the plane; one that is no number has its fault already.
    fn along_z(&mut self, path: &str, direction: [f64; 3], message: &str) {
        if direction[..2] != [0.0; 2] && direction.iter().all(|component| component.is_finite()) {
            self.third(path.into(), message);
        }
    }

    fn flat_motion(&mut self, path: &str, motion: &Motion) {
        if motion.velocity[2].as_ref().is_some_and(|drive| *drive != Drive::Constant(0.0)) {
            self.third(format!("{path}.z"), NO_Z);
        }
    }

    fn third(&mut self, path: String, message: &str) {
        self.fault(&THIRD, path, message, HELP);
    }
}
