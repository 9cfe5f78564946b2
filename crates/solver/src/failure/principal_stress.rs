//! Failure at the largest principal stress, tension only (Rankine): brittle materials and spall.
//!
//! σ₁ = max( ½ (σ_xx + σ_yy) + √(¼ (σ_xx − σ_yy)² + σ_xy²), σ_zz ).

use super::CriterionKind;
use crate::quantity::{Dimension, Parameter, Range};

pub(super) const KIND: CriterionKind = CriterionKind {
    limit: Parameter::new(
        "principal_stress",
        "σ_f",
        Dimension::PRESSURE,
        Range::Positive,
        "Largest principal stress (tension) at which an element fails.",
    ),
    needs: None,
    fails: |seen, limit| {
        let [xx, yy, zz, xy] = seen.stress();
        std::array::from_fn(|lane| {
            let (half, shear) = (0.5 * (xx.0[lane] - yy.0[lane]), xy.0[lane]);
            let in_plane = 0.5 * (xx.0[lane] + yy.0[lane]) + (half * half + shear * shear).sqrt();
            in_plane.max(zz.0[lane]) >= limit
        })
    },
};
