//! Stresses and states of points on other elements, whatever the dimension.

use crate::block::PointValues;
use embate_remesh::transfer::{Failure, Order, Values};

/// What the points of old elements have, on new ones: stresses by volume, what the law remembers by mass.
/// `densities` are those of the old elements; `map` takes values to the new ones.
pub(super) fn carried(
    old: &PointValues,
    densities: &[f64],
    map: impl Fn(&Values<'_>) -> Result<Vec<f64>, Failure>,
) -> Result<Vec<f64>, String> {
    let (components, width) = (old.components, old.width);
    let part = |from: usize, to: usize| -> Vec<f64> { old.values.chunks(width).flat_map(|own| own[from..to].to_vec()).collect() };
    let carried = |own: &[f64], count: usize, densities: Option<&[f64]>| -> Result<Vec<f64>, String> {
        if count == 0 {
            return Ok(Vec::new());
        }
        // What a law remembers, such as plastic strain, stays within what it is anywhere.
        let range = |k: usize| {
            own.iter().skip(k).step_by(count).fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &it| [low.min(it), high.max(it)])
        };
        let ranges: Vec<[f64; 2]> = (0..count).map(range).collect();
        let limits = densities.is_some().then_some(&ranges[..]);
        let values = Values { values: own, width: count, densities, order: Order::Linear, limits };
        let mut carried = map(&values).map_err(|failure| failure.to_string())?;
        if limits.is_some() {
            // To the last digit.
            carried.iter_mut().zip(ranges.iter().cycle()).for_each(|(value, &[low, high])| *value = value.max(low).min(high));
        }
        Ok(carried)
    };
    let stress = carried(&part(0, components), components, old.is_strain.then_some(densities))?;
    let state = carried(&part(components, width), width - components, Some(densities))?;
    let mut all = Vec::with_capacity(stress.len() + state.len());
    for (point, stress) in stress.chunks(components).enumerate() {
        all.extend_from_slice(stress);
        all.extend_from_slice(&state[point * (width - components)..][..width - components]);
    }
    Ok(all)
}
