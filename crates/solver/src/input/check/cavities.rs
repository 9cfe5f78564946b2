//! Faults of cavities.

use super::Check;
use crate::load::curve::Curve;
use crate::model::Drive;
use crate::model::messages::{CLASH, RANGE};
use crate::model::reference::Wanted;
use crate::quantity::Dimension;

/// How often a curve is looked at.
const LOOKS: u32 = 64;

impl Check<'_> {
    pub(super) fn cavities(&mut self) {
        let model = self.model;
        self.names("cavity", model.cavities.iter().map(|cavity| cavity.name.as_str()));
        for (index, cavity) in model.cavities.iter().enumerate() {
            let path = format!("cavity[{index}]");
            for (number, on) in cavity.on.iter().enumerate() {
                self.reference(&format!("{path}.on[{number}]"), on, Wanted::Surface);
            }
            let numbers = [
                ("ambient", Some(cavity.ambient)),
                ("pressure", cavity.pressure),
                ("exponent", Some(cavity.exponent)),
                ("temperature", Some(cavity.temperature)),
                ("gas_constant", Some(cavity.gas_constant)),
            ];
            for (key, value) in numbers.into_iter().filter_map(|(key, value)| Some((key, value?))) {
                self.number(&format!("{path}.{key}"), value);
            }
            if cavity.pressure.is_none() && cavity.ambient == 0.0 {
                let message = "the gas begins with the pressure outside, and that is 0: there would be none";
                self.fault(&RANGE, format!("{path}.pressure"), message, "give the pressure at the start, absolute");
            }
            if cavity.exponent > 0.0 && cavity.exponent < 1.0 {
                let message = format!("`exponent` must be 1 or more, but it is {}", cavity.exponent);
                self.fault(&RANGE, format!("{path}.exponent"), message, "of air it is 1.4; with 1 the gas keeps its temperature");
            }
            for (number, inflow) in cavity.inflow.iter().enumerate() {
                let path = format!("{path}.inflow[{number}]");
                self.number(&format!("{path}.rate"), inflow.rate);
                self.factor(&path, &inflow.curve);
                if let Some(name) = &inflow.curve {
                    self.never_below(&format!("{path}.curve"), &Drive::Curve(name.clone()), |value| value >= 0.0, "0 or greater");
                }
                self.drive(&format!("{path}.temperature"), &inflow.temperature, Dimension::TEMPERATURE);
                self.never_below(&format!("{path}.temperature"), &inflow.temperature, |value| value > 0.0, "greater than 0");
            }
            for (number, vent) in cavity.vents.iter().enumerate() {
                let path = format!("{path}.vents[{number}]");
                self.number(&format!("{path}.orifice"), vent.orifice);
                self.number(&format!("{path}.discharge"), vent.discharge);
                if let Some(pressure) = vent.opens_at {
                    self.number(&format!("{path}.opens_at"), pressure);
                }
            }
        }
        if model.run.subcycling && !model.cavities.is_empty() {
            let message = "the gas of a cavity joins all nodes of its surface in every step";
            self.fault(&CLASH, "run.subcycling", message, "leave one of `subcycling` and `cavity` out");
        }
    }

    /// A value that must be in a range during the whole run; of curves it is looked at [`LOOKS`] times.
    fn never_below(&mut self, path: &str, drive: &Drive, is_sound: impl Fn(f64) -> bool, range: &str) {
        let found = match drive {
            Drive::Constant(value) => (!is_sound(*value)).then_some((*value, String::new())),
            Drive::Curve(name) => self.model.curves.get(name).and_then(|curve| {
                let curve = Curve::new(curve);
                let times = (0..=LOOKS).map(|k| self.model.run.end * f64::from(k) / f64::from(LOOKS));
                let mut values = times.map(|time| (curve.value(time), format!(" at {time:e} s")));
                values.find(|(value, _)| value.is_finite() && !is_sound(*value))
            }),
        };
        if let Some((value, when)) = found.filter(|(value, _)| value.is_finite()) {
            let key = path.rsplit('.').next().unwrap_or(path);
            self.fault(&RANGE, path, format!("`{key}` must be {range}, but it is {value}{when}"), "gas flows in, and is warm");
        }
    }
}
