//! Which number of a frame is shown as colour: a scalar field, one component, or the size of a vector or
//! stress. Taken from [`Frame::fields`]; goes to `film` as one `f32` per node or cell.

use embate_solver::output::{Field, FieldKind, Frame, Location};

/// A scalar that is read from frames.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Scalar {
    pub(crate) kind: &'static FieldKind,
    /// Component of a vector or stress; none: its size.
    component: Option<usize>,
}

impl Scalar {
    /// The scalar `name` of a frame: `von_mises`, `velocity` (its size) or `stress.xy`.
    pub(super) fn named(frame: &Frame, name: &str) -> Option<Self> {
        Self::of(frame.fields.iter().map(|field| field.kind), name)
    }

    /// The same of some fields.
    pub(crate) fn of(kinds: impl IntoIterator<Item = &'static FieldKind>, name: &str) -> Option<Self> {
        let (field, component) = match name.split_once('.') {
            Some((field, component)) => (field, Some(component)),
            None => (name, None),
        };
        let kind = kinds.into_iter().find(|kind| kind.name == field)?;
        let component = match component {
            Some(wanted) => Some(kind.components.iter().position(|c| *c == wanted)?),
            None => None,
        };
        Some(Self { kind, component })
    }

    /// The scalars that are shown when none was chosen, the best first: plastic strain, equivalent stress,
    /// else the frame's first field.
    pub(super) fn defaults(frame: &Frame) -> Vec<Self> {
        let mut found: Vec<Self> = ["plastic_strain", "von_mises"].iter().filter_map(|name| Self::named(frame, name)).collect();
        if found.is_empty() {
            found.extend(frame.fields.first().map(|f| Self { kind: f.kind, component: None }));
        }
        found
    }

    /// All that can be reported of some fields, by what [`Scalar::of`] knows them by: each, and its
    /// components.
    pub(crate) fn all(kinds: &[&'static FieldKind]) -> Vec<(String, Self)> {
        let has_equivalent = kinds.iter().any(|kind| kind.name == "von_mises");
        let mut all = Vec::new();
        for &kind in kinds {
            // The size of a stress is the equivalent stress.
            if !(kind.name == "stress" && has_equivalent) {
                all.push((kind.name.to_string(), Self { kind, component: None }));
            }
            all.extend(
                kind.components.iter().enumerate().map(|(k, name)| (format!("{}.{name}", kind.name), Self { kind, component: Some(k) })),
            );
        }
        all
    }

    /// Values of a frame; empty if it does not hold the field.
    pub(super) fn values(&self, frame: &Frame) -> Vec<f32> {
        let Some(field) = frame.fields.iter().find(|f| f.kind.name == self.kind.name) else { return Vec::new() };
        let width = self.kind.width();
        field.values.chunks_exact(width).map(|tuple| self.scalar(tuple) as f32).collect()
    }

    /// Of the values of a node or cell.
    pub(crate) fn scalar(&self, tuple: &[f64]) -> f64 {
        match (self.component, tuple) {
            (Some(index), _) => tuple[index],
            (None, [value]) => *value,
            // A stress: its equivalent (von Mises) value.
            (None, [xx, yy, zz, xy]) => {
                let squares = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
                (0.5 * squares + 3.0 * xy * xy).sqrt()
            }
            (None, [xx, yy, zz, xy, yz, zx]) => {
                let squares = (xx - yy).powi(2) + (yy - zz).powi(2) + (zz - xx).powi(2);
                (0.5 * squares + 3.0 * (xy * xy + yz * yz + zx * zx)).sqrt()
            }
            (None, vector) => vector.iter().map(|v| v * v).sum::<f64>().sqrt(),
        }
    }

    /// Whether values live at nodes.
    pub(crate) fn at_nodes(&self) -> bool {
        self.kind.location == Location::Node
    }

    /// Whether the colour range starts at zero by nature.
    pub(crate) fn starts_at_zero(&self) -> bool {
        let size = self.component.is_none() && !self.kind.components.is_empty();
        let scalars = ["plastic_strain", "von_mises", "energy_density", "damage", "contact_pressure", "contact_slip", "friction_heat"];
        size || scalars.contains(&self.kind.name)
    }

    /// Names of the values 0, 1, ... of a field that reports states; empty for quantities.
    pub(crate) fn states(&self) -> &'static [&'static str] {
        if self.kind.name == "contact_status" { &["open", "stick", "slip"] } else { &[] }
    }

    /// Name for people.
    pub(crate) fn label(&self) -> String {
        match (self.kind.name, self.component) {
            ("von_mises", _) | ("stress", None) => "von Mises stress".into(),
            (name, None) => name.replace('_', " "),
            (name, Some(index)) => format!("{} {}", name.replace('_', " "), self.kind.components[index]),
        }
    }
}

/// Names that [`Scalar::named`] would find in these fields.
pub(super) fn names(fields: &[Field]) -> String {
    if fields.is_empty() { "no field".into() } else { fields.iter().map(|f| f.kind.name).collect::<Vec<_>>().join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::{field_kind, fields_of};

    fn frame(fields: &[(&str, &[f64])]) -> Frame {
        let fields = fields.iter().map(|(name, values)| Field { kind: field_kind(name).unwrap(), values: values.to_vec() }).collect();
        Frame { fields, ..Frame::of(&[[0.0; 2]; 2]) }
    }

    #[test]
    fn vectors_show_their_size_and_components_by_name() {
        let frame = frame(&[("velocity", &[3.0, -4.0, 0.0, 2.0])]);
        assert_eq!(Scalar::named(&frame, "velocity").unwrap().values(&frame), [5.0, 2.0]);
        assert_eq!(Scalar::named(&frame, "velocity.y").unwrap().values(&frame), [-4.0, 2.0]);
        assert!(Scalar::named(&frame, "velocity.z").is_none());
        assert!(Scalar::named(&frame, "stress").is_none());
    }

    #[test]
    fn a_stress_shows_its_equivalent_value() {
        let frame = frame(&[("stress", &[7.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0])]);
        let values = Scalar::named(&frame, "stress").unwrap().values(&frame);
        assert!((values[0] - 7.0).abs() < 1e-6 && (values[1] - 12f32.sqrt()).abs() < 1e-6, "{values:?}");
    }

    #[test]
    fn a_stress_of_3d_shows_its_equivalent_value_and_a_velocity_has_a_third_component() {
        let named = |name: &str, values: &[f64]| Field {
            kind: fields_of(3).iter().find(|kind| kind.name == name).unwrap(),
            values: values.to_vec(),
        };
        let fields = vec![named("velocity", &[2.0, -3.0, 6.0]), named("stress", &[7.0, 0.0, 0.0, 0.0, 2.0, 0.0])];
        let frame = Frame { fields, ..Frame::of(&[[0.0; 3]]) };
        let value = |name: &str| Scalar::named(&frame, name).unwrap().values(&frame)[0];
        assert_eq!((value("velocity"), value("velocity.z"), value("stress.yz")), (7.0, 6.0, 2.0));
        assert!((value("stress") - 61f32.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn plastic_strain_is_the_first_choice() {
        let frame = frame(&[("pressure", &[1.0]), ("von_mises", &[1.0]), ("plastic_strain", &[0.0])]);
        let names: Vec<&str> = Scalar::defaults(&frame).iter().map(|s| s.kind.name).collect();
        assert_eq!(names, ["plastic_strain", "von_mises"]);
    }
}
