//! Gas at a uniform pressure in a closed surface, as plain data: `[[cavity]]`.

use super::{Drive, section};
use crate::quantity::Dimension;
use crate::quantity::Range::{NotNegative, Positive, UpTo};
use crate::vocabulary::Kind::{self, MassFlow, Name, Quantity, Reference, References, Tables};
use crate::vocabulary::{Form, Section};

section! {
    /// `[[cavity]]`: gas at a uniform pressure in a closed surface.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Cavity in CAVITY = Section {
        name: "cavity",
        doc: "Gas at one pressure in a closed surface: an airbag, a tyre, a can, a bellows. Its volume is that which the \
            surface encloses now, its pressure p V^exponent = constant while nothing flows in or out, and the difference to \
            the pressure outside acts on the surface. Rims of the surface must lie on planes of `[[symmetry]]`, or on the \
            axis of an axisymmetric model.",
        form: Form::Repeated,
        ..Section::EMPTY
    };
    name: String = Name, Required, "Unique name.";
    on: Vec<String> = References(None), Required,
        "The surface, from the side of the gas: sides such as `tank.inner` or `bag.lower`, groups of a mesh file, or parts, their whole outsides.";
    ambient: f64 = Quantity(Dimension::PRESSURE, NotNegative), Required,
        "Pressure outside, absolute: the gas acts with its pressure less this.";
    pressure: Option<f64> = Quantity(Dimension::PRESSURE, Positive), Optional("that outside"), "Pressure of the gas at the start, absolute.";
    exponent: f64 = Quantity(Dimension::NONE, Positive), Default("1.4"),
        "Ratio of the specific heats, 1 or more: the gas is adiabatic. With 1 it keeps its temperature.";
    temperature: f64 = Quantity(Dimension::TEMPERATURE, Positive), Default("293.15"), "Temperature of the gas at the start.";
    gas_constant: f64 = Quantity(Dimension::SPECIFIC_HEAT, Positive), Default("287.06"),
        "Specific gas constant R, that of air left out: 8.314 J/mol/K over the molar mass.";
    inflow: Vec<Inflow> = Tables(&INFLOW), Optional("none"), "Gas of the same kind that flows in, as from an inflator.";
    vents: Vec<Vent> = Tables(&VENT), Optional("none"), "Openings through which gas flows out, into the pressure outside.";
}

section! {
    /// Gas that flows into a cavity.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Inflow in INFLOW = Section {
        name: "inflow",
        doc: "Gas that flows into a cavity; its enthalpy comes with it.",
        ..Section::EMPTY
    };
    rate: f64 = MassFlow(Dimension::VISCOSITY, NotNegative), Required, "Mass per time.";
    curve: Option<String> = Reference, Optional("constant"), "Name of a curve of pure numbers by whose value the rate is multiplied.";
    temperature: Drive = Kind::Drive(Dimension::TEMPERATURE), Required,
        "Temperature of what flows in: a number or the name of a curve. A cavity with the exponent 1 takes it up at its own.";
}

section! {
    /// An opening of a cavity.
    #[derive(Clone, Debug, PartialEq)]
    pub struct Vent in VENT = Section {
        name: "vents",
        doc: "An opening of a cavity: an isentropic orifice, choked where the pressure outside is low enough. Nothing flows in through it.",
        ..Section::EMPTY
    };
    orifice: f64 = Quantity(Dimension::LENGTH, Positive), Required, "Area of the opening, in 2D per metre of depth.";
    discharge: f64 = Quantity(Dimension::NONE, UpTo(0.0, 1.0)), Default("1"), "Discharge coefficient, by which the area is multiplied.";
    opens_at: Option<f64> = Quantity(Dimension::PRESSURE, Positive), Optional("open from the start"),
        "Pressure of the gas, absolute, at which it opens, for good.";
}

impl Cavity {
    /// The pressure at the start, Pa.
    #[must_use]
    pub fn pressure_at_start(&self) -> f64 {
        self.pressure.unwrap_or(self.ambient)
    }
}
