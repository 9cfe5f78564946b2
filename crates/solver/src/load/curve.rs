//! Curves: functions of time by points, sine or formula; and prescribed motion that follows them.
//!
//! Curves come from the model. Constraints, rigid bodies and loads ask for means over a step, so that what is
//! driven is at every step where its curve says, whatever the step, and a load's impulse is the integral of
//! its curve. Means and moments of what has no closed form are taken by four Gauss points between the
//! corners: exact for lines and smooth steps, of eighth order in the step for formulas.

pub mod factor;
pub mod sine;
pub mod steered;
pub mod table;

use crate::archive::{Archive, ArchiveResult, Persist, persist_each};
use crate::expression::Expression;
use crate::model::in_3d;
use crate::model::{self, CurveShape, Drive, Model, Sine, Window};
use crate::vector::{dot, plus, times};
use steered::Steered;
use table::Table;

/// Points and weights of Gauss' rule on −1..1.
const GAUSS: [(f64, f64); 4] = [
    (-0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
    (-0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.339_981_043_584_856_26, 0.652_145_154_862_546_1),
    (0.861_136_311_594_052_6, 0.347_854_845_137_453_85),
];

/// A function of time.
#[derive(Clone, Debug, PartialEq)]
pub enum Curve {
    /// Through points.
    Table(Table),
    /// A wave.
    Sine(Sine),
    /// A formula.
    Expression(Expression),
    /// As the program that drives the simulation says.
    Steered(Steered),
}

impl Curve {
    /// Of a model that has been checked; a formula that can't be read counts as zero.
    #[must_use]
    pub fn new(curve: &model::Curve) -> Self {
        match &curve.shape {
            CurveShape::Table { times, values, smooth } => {
                Self::Table(Table { times: times.clone(), values: values.clone(), smooth: *smooth })
            }
            CurveShape::Sine(sine) => Self::Sine(*sine),
            CurveShape::Expression(text) => Expression::parse(text).map_or_else(|_| Self::Table(Table::default()), Self::Expression),
        }
    }

    /// Value at `time`, s.
    #[must_use]
    pub fn value(&self, time: f64) -> f64 {
        match self {
            Self::Table(table) => table.value(time),
            Self::Sine(sine) => sine.value(time),
            Self::Expression(expression) => expression.value(time),
            Self::Steered(steered) => steered.value(time),
        }
    }

    /// Mean value between two times; the value itself where they are one.
    #[must_use]
    pub fn mean(&self, from: f64, to: f64) -> f64 {
        match self {
            Self::Table(table) if !table.smooth => table.mean(from, to),
            Self::Sine(sine) => sine.mean(from, to),
            Self::Steered(steered) => steered.mean(from, to),
            _ if from == to => self.value(from),
            _ => self.gauss(from, to, |_| 1.0) / (to - from),
        }
    }

    /// ∫ (to − t) y(t) dt / (to − from): what an acceleration adds to the mean velocity.
    #[must_use]
    pub fn moment(&self, from: f64, to: f64) -> f64 {
        if from == to { 0.0 } else { self.gauss(from, to, |time| to - time) / (to - from) }
    }

    /// ∫ y(t) weight(t) dt.
    fn gauss(&self, from: f64, to: f64, weight: impl Fn(f64) -> f64) -> f64 {
        let corners = if let Self::Steered(steered) = self { steered.times() } else { [f64::INFINITY; 3] };
        let times = if let Self::Table(table) = self { &table.times[..] } else { &corners[..] };
        let (first, last) = (times.partition_point(|&t| t <= from), times.partition_point(|&t| t < to));
        let (mut sum, mut begin) = (0.0, from);
        for &end in times[first..last.max(first)].iter().chain([&to]) {
            let (middle, half) = (0.5 * (begin + end), 0.5 * (end - begin));
            for (at, share) in GAUSS {
                let time = middle + half * at;
                sum += half * share * weight(time) * self.value(time);
            }
            begin = end;
        }
        sum
    }
}

/// The curves of a model.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curves {
    list: Vec<Curve>,
    names: Vec<String>,
    /// ∫ y dt of each curve from time zero to now: the velocity of what it accelerates.
    integrals: Vec<f64>,
    /// A time that is short in the run, s: over it slopes at time zero are taken.
    short: f64,
    /// Stage from whose beginning the times of each curve count, and that time, s: infinite until then.
    /// Empty where there are no stages.
    begins: Vec<(usize, f64)>,
    /// When loads act that do so in some stages alone, with their places in the model.
    windows: Vec<(usize, Window)>,
}

/// What a curve or a number prescribes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Meaning {
    /// A velocity, m/s or rad/s.
    Velocity,
    /// A displacement from the initial position, m: the velocity over a step is its difference over the step.
    Displacement,
    /// An acceleration, m/s²: the velocity is the initial one plus its integral.
    Acceleration,
}

/// A velocity that is prescribed: a constant, what grows with time, and multiples of what curves mean; m/s or
/// rad/s.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Speed {
    constant: f64,
    /// Constant acceleration, m/s².
    growth: f64,
    /// Shares of the components of the node's initial velocity.
    initial: [f64; 3],
    terms: Vec<Term>,
}

/// A multiple of what a curve means.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Term {
    factor: f64,
    curve: usize,
    meaning: Meaning,
}

impl Persist for Curves {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // Stages say when they began.
        let Self { list, names: _, integrals, short: _, begins: _, windows: _ } = self;
        integrals[..].persist(archive)?;
        for curve in list {
            let mut steered = if let Curve::Steered(steered) = curve { Some(*steered) } else { None };
            steered.persist(archive)?;
            if let Some(steered) = steered {
                *curve = Curve::Steered(steered);
            }
        }
        Ok(())
    }
}

impl Curves {
    /// Of a model that has been checked.
    #[must_use]
    pub fn new(model: &Model) -> Self {
        let list: Vec<Curve> = model.curves.values().map(Curve::new).collect();
        let integrals = vec![0.0; list.len()];
        let begin = |curve: &model::Curve| {
            let stage = curve.stage.as_ref().and_then(|name| model.stages.iter().position(|stage| stage.name == *name)).unwrap_or(0);
            (stage, if stage == 0 { 0.0 } else { f64::INFINITY })
        };
        let begins = if model.stages.is_empty() { Vec::new() } else { model.curves.values().map(begin).collect() };
        let windows = factor::windows(model);
        Self { list, names: model.curves.keys().cloned().collect(), integrals, short: 1e-6 * model.run.end, begins, windows }
    }

    /// Notes that a stage begins at `now`, s.
    pub fn enter(&mut self, stage: usize, now: f64) {
        for ((_, begin), integral) in self.begins.iter_mut().zip(&mut self.integrals).filter(|((own, _), _)| *own == stage) {
            (*begin, *integral) = (now, 0.0);
        }
        for (_, window) in &mut self.windows {
            window.enter(stage, now);
        }
    }

    /// Time of a curve, s.
    fn time_of(&self, number: usize, time: f64) -> f64 {
        self.begins.get(number).map_or(time, |(_, begin)| f64::max(time - begin, 0.0))
    }

    /// Value of a curve at a time of the run, s.
    #[must_use]
    pub fn value(&self, number: usize, time: f64) -> f64 {
        self.list[number].value(self.time_of(number, time))
    }

    /// Mean value of a curve between two times of the run, s; the value itself where they are one.
    #[must_use]
    pub fn mean_of(&self, number: usize, from: f64, to: f64) -> f64 {
        let (curve, [begin, end]) = (&self.list[number], [from, to].map(|time| self.time_of(number, time)));
        let stage = self.begins.get(number).map_or(0.0, |(_, begin)| *begin);
        if from < stage && stage < to {
            return ((stage - from) * curve.value(0.0) + end * curve.mean(0.0, end)) / (to - from);
        }
        curve.mean(begin, end)
    }

    /// Number of the curve called so.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<usize> {
        self.names.iter().position(|it| it == name)
    }

    /// Names of all, in the order of their numbers.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// Lets a curve continue from a time as the program says: to a value that it reaches in a straight line
    /// at `end`, at once where that is not later, and keeps. Loads look back over `half`, half of a step; all
    /// times in s.
    pub fn steer(&mut self, number: usize, [from, half, end]: [f64; 3], value: f64) {
        let past = [from - half, from].map(|time| [self.time_of(number, time), self.value(number, time)]);
        let end = self.time_of(number, end.max(from));
        self.list[number] = Curve::Steered(Steered::new(past, [end, value]));
    }

    /// The velocity that a drive means; `None` where there is no such curve.
    #[must_use]
    pub fn speed(&self, drive: &Drive) -> Option<Speed> {
        self.meant(drive, Meaning::Velocity)
    }

    /// The velocity that a drive of this meaning prescribes; `None` where there is no such curve.
    #[must_use]
    pub fn meant(&self, drive: &Drive, meaning: Meaning) -> Option<Speed> {
        match (drive, meaning) {
            (Drive::Constant(velocity), Meaning::Velocity) => Some(Speed::constant(*velocity)),
            // The check refuses it unless it is zero.
            (Drive::Constant(_), Meaning::Displacement) => Some(Speed::constant(0.0)),
            (Drive::Constant(growth), Meaning::Acceleration) => Some(Speed { growth: *growth, ..Speed::default() }),
            (Drive::Curve(name), _) => {
                let curve = self.find(name)?;
                Some(Speed { terms: vec![Term { factor: 1.0, curve, meaning }], ..Speed::default() })
            }
        }
    }

    /// Mean of `speed` between two times, s; `from` is now.
    #[must_use]
    pub fn mean(&self, speed: &Speed, from: f64, to: f64) -> f64 {
        let grown = if speed.growth == 0.0 { speed.constant } else { speed.constant + speed.growth * 0.5 * (from + to) };
        speed.terms.iter().fold(grown, |sum, term| sum + term.factor * self.mean_of_term(term, from, to))
    }

    fn mean_of_term(&self, term: &Term, from: f64, to: f64) -> f64 {
        match term.meaning {
            Meaning::Velocity => self.mean_of(term.curve, from, to),
            Meaning::Displacement => {
                let to = if to > from { to } else { from + self.short };
                (self.value(term.curve, to) - self.value(term.curve, from)) / (to - from)
            }
            Meaning::Acceleration => {
                let [from, to] = [from, to].map(|time| self.time_of(term.curve, time));
                self.integrals[term.curve] + self.list[term.curve].moment(from, to)
            }
        }
    }

    /// Notes that the time continues.
    pub fn pass(&mut self, from: f64, to: f64) {
        for number in 0..self.list.len() {
            self.integrals[number] += (to - from) * self.mean_of(number, from, to);
        }
    }
}

impl Speed {
    /// The same at all times.
    #[must_use]
    pub fn constant(velocity: f64) -> Self {
        Self { constant: velocity, ..Self::default() }
    }

    /// Whether it is the same at all times, and which.
    #[must_use]
    pub fn as_constant(&self) -> Option<f64> {
        (self.terms.is_empty() && self.growth == 0.0 && self.initial == [0.0; 3]).then_some(self.constant)
    }

    /// This velocity plus `share` of a node's initial velocity.
    #[must_use]
    pub fn from_initial<const D: usize>(mut self, share: [f64; D]) -> Self {
        self.initial = plus(self.initial, in_3d(share));
        self
    }

    /// Takes the node's initial velocity, m/s, from which it accelerates at a time (s).
    pub fn begin<const D: usize>(&mut self, velocity: [f64; D], curves: &Curves, time: f64) {
        self.constant += dot(self.initial, in_3d(velocity));
        self.initial = [0.0; 3];
        if time > 0.0 {
            // What would have been gained before.
            let gained = |term: &Term| if term.meaning == Meaning::Acceleration { term.factor * curves.integrals[term.curve] } else { 0.0 };
            self.constant -= self.growth * time + self.terms.iter().map(gained).sum::<f64>();
        }
    }

    /// What [`Speed::begin`] has found, in a kept state.
    pub(crate) fn persist_begun(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        persist_each!(archive; &mut self.constant, &mut self.initial);
        Ok(())
    }

    /// This velocity plus `factor` times another.
    #[must_use]
    pub fn plus(&self, factor: f64, other: &Self) -> Self {
        let mut sum = Self {
            constant: self.constant + factor * other.constant,
            growth: self.growth + factor * other.growth,
            initial: plus(self.initial, times(factor, other.initial)),
            terms: self.terms.clone(),
        };
        for term in &other.terms {
            match sum.terms.iter_mut().find(|own| (own.curve, own.meaning) == (term.curve, term.meaning)) {
                Some(own) => own.factor += factor * term.factor,
                None => sum.terms.push(Term { factor: factor * term.factor, ..*term }),
            }
        }
        sum
    }

    /// This velocity `factor` times.
    #[must_use]
    pub fn times(&self, factor: f64) -> Self {
        Self {
            constant: factor * self.constant,
            growth: factor * self.growth,
            initial: self.initial.map(|share| factor * share),
            terms: self.terms.iter().map(|term| Term { factor: factor * term.factor, ..*term }).collect(),
        }
    }

    /// Size of its constant parts, m/s and m/s².
    #[must_use]
    pub fn size(&self) -> f64 {
        self.constant.abs().max(self.growth.abs())
    }

    /// Whether it is nothing but round-off beside constants of the size of `scale` and whole curves.
    #[must_use]
    pub fn is_round_off(&self, scale: f64) -> bool {
        self.size() <= 1e-9 * scale
            && self.initial.iter().all(|share| share.abs() <= 1e-9)
            && self.terms.iter().all(|term| term.factor.abs() <= 1e-9)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(times: &[f64], values: &[f64], smooth: bool) -> Curve {
        Curve::Table(Table { times: times.into(), values: values.into(), smooth })
    }

    /// A table, smooth steps, a wave and a formula.
    fn all() -> [Curve; 4] {
        [
            table(&[1.0, 2.0, 4.0], &[3.0, 5.0, -1.0], false),
            table(&[1.0, 2.0, 4.0], &[3.0, 5.0, -1.0], true),
            Curve::Sine(Sine { amplitude: 2.0, frequency: 0.7, phase: 0.3, offset: 1.0 }),
            Curve::Expression(Expression::parse("1 + 2*sin(0.7*2*pi*t + 0.3)").unwrap()),
        ]
    }

    #[test]
    fn a_curve_is_linear_between_its_points_and_constant_beyond() {
        let curve = table(&[1.0, 2.0, 4.0], &[3.0, 5.0, -1.0], false);
        for (time, value) in [(-7.0, 3.0), (1.0, 3.0), (1.5, 4.0), (2.0, 5.0), (3.0, 2.0), (4.0, -1.0), (9.0, -1.0)] {
            assert_eq!(curve.value(time), value, "at {time}");
        }
        assert_eq!(table(&[2.0], &[7.0], false).value(1.0), 7.0);
    }

    #[test]
    fn a_smooth_step_begins_and_ends_without_velocity_and_acceleration() {
        let curve = table(&[1.0, 3.0], &[2.0, 6.0], true);
        assert_eq!([0.0, 1.0, 2.0, 3.0, 9.0].map(|time| curve.value(time)), [2.0, 2.0, 4.0, 6.0, 6.0]);
        let h = 1e-3;
        for (end, side) in [(1.0, 1.0), (3.0, -1.0)] {
            let rise = |k: f64| curve.value(end + side * k * h) - curve.value(end);
            // y ~ 10 s³ of the height: both differences vanish with the cube of the distance.
            assert!(rise(1.0).abs() < 1e-8 && (rise(2.0) - 2.0 * rise(1.0)).abs() < 1e-7);
        }
    }

    #[test]
    fn means_over_steps_add_up_to_the_integral() {
        let wave = |t: f64| t - 2.0 / (0.7 * std::f64::consts::TAU) * (0.7 * std::f64::consts::TAU * t + 0.3).cos();
        // 3 until 1, 4 until 2, 2 on average until 4 (smooth steps have the means of lines), then −1.
        for (curve, integral) in all().into_iter().zip([10.0, 10.0, wave(5.0) - wave(0.0), wave(5.0) - wave(0.0)]) {
            for steps in [1, 3, 7, 100] {
                if matches!(curve, Curve::Expression(_)) && steps < 100 {
                    continue; // a formula needs steps that resolve it
                }
                let dt = 5.0 / f64::from(steps);
                let sum: f64 = (0..steps).map(|k| dt * curve.mean(dt * f64::from(k), dt * f64::from(k + 1))).sum();
                assert!((sum - integral).abs() < 1e-12, "{curve:?} in {steps}: {sum} {integral}");
            }
            assert_eq!(curve.mean(3.0, 3.0), curve.value(3.0));
        }
        assert_eq!(all()[0].mean(2.0, 2.0), 5.0);
    }

    #[test]
    fn a_step_as_long_as_all_time_still_has_its_exact_mean() {
        let sine = all()[2].clone();
        assert!((sine.mean(0.0, 10.0 / 0.7) - 1.0).abs() < 1e-14, "ten whole waves");
        assert!((sine.mean(0.1, 0.1 + 1e-10) - sine.value(0.1)).abs() < 1e-9);
    }

    #[test]
    fn displacements_and_accelerations_lead_to_where_their_curves_say() {
        let curves = |list: Vec<Curve>| Curves {
            integrals: vec![0.0; list.len()],
            names: vec!["c".into(); list.len()],
            list,
            short: 1e-6,
            ..Curves::default()
        };
        let walk = |curve: &Curve, meaning: Meaning, steps: u32| {
            let mut curves = curves(vec![curve.clone()]);
            let speed = Speed { terms: vec![Term { factor: 1.0, curve: 0, meaning }], ..Speed::default() };
            let (mut x, dt) = (0.0, 5.0 / f64::from(steps));
            for k in 0..steps {
                let (from, to) = (dt * f64::from(k), dt * f64::from(k + 1));
                x += dt * curves.mean(&speed, from, to);
                curves.pass(from, to);
            }
            x
        };
        for curve in all() {
            let moved = walk(&curve, Meaning::Displacement, 37);
            assert!((moved - (curve.value(5.0) - curve.value(0.0))).abs() < 1e-13, "{curve:?}");
        }
        // ∫∫ of the points: 3 until 1, then 3 + 2 s until 2, then 5 − 3 s until 4, then −1.
        let (v1, x1) = (3.0, 1.5);
        let (v2, x2) = (v1 + 4.0, x1 + v1 + 1.5 + 1.0 / 3.0);
        let (v4, x4) = (v2 + 4.0, x2 + 2.0 * v2 + 10.0 - 4.0);
        let exact = x4 + v4 - 0.5;
        for steps in [1, 8, 37] {
            let found = walk(&all()[0], Meaning::Acceleration, steps);
            assert!((found - exact).abs() < 1e-12, "{steps}: {found} {exact}");
        }
        let sine = |steps| walk(&all()[2], Meaning::Acceleration, steps);
        assert!((sine(100) - sine(800)).abs() < 1e-10, "{} {}", sine(100), sine(800));
        let constant = Speed { growth: 3.0, constant: 1.0, ..Speed::default() };
        assert_eq!(curves(vec![]).mean(&constant, 2.0, 4.0), 10.0);
    }
}
