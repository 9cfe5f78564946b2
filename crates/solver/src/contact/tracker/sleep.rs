//! Groups that are far from their candidates sleep: they are looked at again when these may have come near.
//!
//! Where a node was d away from all its candidates at the travel T (the way that no node has exceeded since
//! the start), it is at least d − 2 (T' − T) away at T'. Within a step of the way s nothing is touched,
//! passed through or seen ahead that is farther than near + look-ahead · √2 · 2 s, the bound of what a gap
//! changes in it. So
//!
//! d + 2 T > near + 2 T' + look-ahead · √8 s
//!
//! proves that the group would be found as it was: outside, with nothing near. The left side is kept per
//! group, the right side is one number per step. What sleeps gives the same bits as what is looked at in
//! vain.

/// Wakes at once.
pub(in crate::contact) const AWAKE: f64 = f64::NEG_INFINITY;
/// Bound of √8 with what rounding may add.
const MOTION: f64 = 2.83;

/// What a group that is `clear` (m) from all its candidates keeps, at the travel (m) of this step.
pub(in crate::contact) fn wake_at(clear: f64, travel: f64) -> f64 {
    let wake = clear + 2.0 * travel;
    if wake < f64::INFINITY { wake } else { AWAKE }
}

/// What is kept must be more than this for a group to sleep on in a step of the way `way` (m) that ends at
/// the travel `travel` (m).
pub(in crate::contact) fn awake(near: f64, look_ahead: f64, travel: f64, way: f64) -> f64 {
    let bound = near + 2.0 * travel + look_ahead * MOTION * way;
    // A little for rounding. Where travels are not known nothing sleeps.
    if way >= 0.0 && bound < f64::INFINITY { bound * (1.0 + 1e-12) } else { f64::INFINITY }
}
