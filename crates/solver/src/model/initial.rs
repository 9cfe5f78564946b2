//! What a part holds at the start, as plain data: velocities away from a point or an axis, and stress that
//! varies linearly in 2D.
//!
//! Part of [`super::Part`]; velocities go into `build/bodies.rs`, stresses into `block/initial.rs`.

use super::placement::ALONG_Z;
use super::{Values, section};
use crate::quantity::Dimension;
use crate::quantity::Range::Finite;
use crate::rotation::Rotate;
use crate::tensor::Dim;
use crate::vector::{first, length, minus, times, unit};
use crate::vocabulary::Kind::{Quantity, Spatial, Table, Vector};
use crate::vocabulary::{Key, Need, Rule, Section, key};

section! {
    /// A velocity away from a point, or in 3D from an axis: (`speed`/r + `rate`) r, r from the point or the
    /// nearest of the axis.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct RadialVelocity in RADIAL_VELOCITY = Section {
        name: "radial_velocity",
        doc: "Initial velocity away from a point, or in 3D from an axis, as of a ring or a shell that a charge drives apart; \
            it is added to `velocity` and `spin`. With `speed` all nodes are equally fast (one at the centre rests), with `rate` they \
            are the faster the farther off they are: v = (speed / r + rate) r. What a rigid part can't do.",
        rules: &[Rule::SomeOf(&["speed", "rate"])],
        ..Section::EMPTY
    };
    speed: f64 = Quantity(Dimension::VELOCITY, Finite), Default("0"), "Speed, the same everywhere; negative: towards the centre.";
    rate: f64 = Quantity(Dimension::RATE, Finite), Default("0"), "Speed per distance.";
    centre: [f64; 3] = Spatial(Dimension::LENGTH, Finite), Default("[0, 0]"), "The point; in 3D one of the axis, where there is one.";
    axis: Option<[f64; 3]> = Spatial(Dimension::NONE, Finite), Optional("from the point"),
        "Direction of the axis, in 3D; any length but zero.";
}

impl RadialVelocity {
    /// At a place, m/s.
    pub(crate) fn at<const D: usize>(&self, x: [f64; D]) -> [f64; D]
    where
        Dim<D>: Rotate<D>,
    {
        let arm = minus(x, first(self.centre));
        let arm = self.axis.map_or(arm, |axis| <Dim<D>>::perpendicular(arm, unit(axis).unwrap_or(ALONG_Z)));
        let distance = length(arm);
        times(self.rate + if distance > 0.0 { self.speed / distance } else { 0.0 }, arm)
    }
}

section! {
    /// A Cauchy stress that varies linearly: σ(x) = σ₀ + (x − x₀) ∂σ/∂x + (y − y₀) ∂σ/∂y. Components xx, yy,
    /// zz, xy.
    #[derive(Clone, Copy, Debug, PartialEq)]
    pub struct InitialStress in STRESS_INITIAL = Section {
        name: "stress_initial",
        doc: "Cauchy stress at the start, tension positive: uniform, or linear in x and y. Its elastic energy is in the \
            energy balance from the start. The law must be one in rate form that can hold it; nothing makes sure that it \
            is in equilibrium. Of bars `xx` is the stress along the bar, and there is no other.",
        ..Section::EMPTY
    };
    /// σ₀, Pa. Of bars xx is the stress along the bar, and there is no other.
    value: [f64; 4], read components;
    "xx" = Quantity(Dimension::PRESSURE, Finite), Default("0"), "Normal stress along x (radial in an axisymmetric part).";
    "yy" = Quantity(Dimension::PRESSURE, Finite), Default("0"), "Normal stress along y (axial).";
    "zz" = Quantity(Dimension::PRESSURE, Finite), Default("0"), "Normal stress across the plane (around the axis); not in plane stress.";
    "xy" = Quantity(Dimension::PRESSURE, Finite), Default("0"), "Shear stress.";
    per_x: [f64; 4] = Table(&PER_X), Optional("uniform along x"), "How much the stress grows along x.", read |values| slope(values, "per_x");
    per_y: [f64; 4] = Table(&PER_Y), Optional("uniform along y"), "How much the stress grows along y.", read |values| slope(values, "per_y");
    point: [f64; 2] = Vector(Dimension::LENGTH, Finite), Default("[0, 0]"),
        "Where the stress is just `xx`, `yy`, `zz`, `xy`.";
}

const fn growth(name: &'static str, doc: &'static str) -> Key {
    key(name, Quantity(Dimension::PRESSURE_PER_LENGTH, Finite), Need::Default("0"), doc)
}

const SLOPES: [Key; 4] = [growth("xx", "Of `xx`."), growth("yy", "Of `yy`."), growth("zz", "Of `zz`."), growth("xy", "Of `xy`.")];

static PER_X: Section = Section { name: "per_x", doc: "Growth of a stress along x.", keys: &SLOPES, ..Section::EMPTY };
static PER_Y: Section = Section { name: "per_y", doc: "Growth of a stress along y.", keys: &SLOPES, ..Section::EMPTY };

fn components(values: &dyn Values) -> [f64; 4] {
    ["xx", "yy", "zz", "xy"].map(|name| values.get(name))
}

fn slope(values: &dyn Values, name: &str) -> [f64; 4] {
    values.table(name).map_or([0.0; 4], components)
}

impl InitialStress {
    /// The same everywhere, Pa.
    #[must_use]
    pub fn uniform(value: [f64; 4]) -> Self {
        Self { value, ..Self::default() }
    }

    /// The stress at a place, Pa.
    #[must_use]
    pub fn at(&self, [x, y]: [f64; 2]) -> [f64; 4] {
        let [x, y] = [x - self.point[0], y - self.point[1]];
        std::array::from_fn(|c| self.value[c] + x * self.per_x[c] + y * self.per_y[c])
    }

    /// Whether a component is zero everywhere.
    #[must_use]
    pub fn lacks(&self, component: usize) -> bool {
        [self.value, self.per_x, self.per_y].iter().all(|of| of[component] == 0.0)
    }
}
