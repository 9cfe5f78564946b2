//! Failure at the largest principal stress, tension only (Rankine): brittle materials and spall.
//!
//! σ₁ = max( ½ (σ_xx + σ_yy) + √(¼ (σ_xx − σ_yy)² + σ_xy²), σ_zz ) where no shear acts across the plane, else
//! the largest eigenvalue.

use super::CriterionKind;
use crate::quantity::{Dimension, Parameter, Range};
use crate::tensor::{Solid, SymmetricTensor};

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
        let all = seen.stress();
        let [xx, yy, zz, xy, yz, zx] = all;
        std::array::from_fn(|lane| {
            if yz.0[lane] != 0.0 || zx.0[lane] != 0.0 {
                let (values, _) = Solid(all.map(|component| component.0[lane])).principal();
                return values[0].max(values[1]).max(values[2]) >= limit;
            }
            let (half, shear) = (0.5 * (xx.0[lane] - yy.0[lane]), xy.0[lane]);
            let in_plane = 0.5 * (xx.0[lane] + yy.0[lane]) + (half * half + shear * shear).sqrt();
            in_plane.max(zz.0[lane]) >= limit
        })
    },
};
