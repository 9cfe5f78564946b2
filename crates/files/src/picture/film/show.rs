//! What is decided for a whole film: the field that is shown, its colour range, how much is seen, the time
//! labels. Read from all stored frames; `film` draws with it.

use super::Film;
use super::stored::Stored;
use crate::outline::Extent;
use crate::picture::scale::{decimals, number, unit};
use crate::picture::sheet::Key;
use crate::picture::space::Sight;
use crate::picture::space::obstacle::Solid;
use crate::picture::view::{self, NOTHING, extent, joined, mirrored, nothing, size};

/// What was decided for the whole film.
#[derive(Clone, Debug)]
pub(super) struct Show {
    pub(super) scalar: Option<usize>,
    pub(super) range: [f64; 2],
    pub(super) key: Key,
    pub(super) view: Extent<2>,
    /// Side of the mirror lines on which the model lies.
    pub(super) sides: [f64; 2],
    /// In 3D: box around the bodies and their mirror images, m.
    pub(super) bodies: Extent<3>,
}

impl Film {
    /// Field, colour range and view for all stored frames.
    pub(super) fn show(&self) -> Show {
        let all = |k: usize| self.stored.iter().flat_map(move |frame| frame.values[k].iter().copied()).filter(|v| v.is_finite());
        // The first scalar that is not zero throughout; if all are, the last (equivalent stress before
        // plastic strain).
        let scalar = (0..self.scalars.len()).find(|k| all(*k).any(|v| v != 0.0)).or(self.scalars.len().checked_sub(1));
        let (sides, bodies, view) = if self.is_in_3d() { self.view_in_3d() } else { self.view_in_plane() };
        let view = self.settings.view.unwrap_or(view);
        let Some(chosen) = scalar else { return Show { scalar, range: [0.0, 1.0], key: Key::Empty, view, sides, bodies } };
        let kind = self.scalars[chosen];
        let states = kind.states();
        let (range, beyond) = match states.len().checked_sub(1) {
            Some(last) => ([0.0, last as f64], [false; 2]),
            None => colour_range(all(chosen), kind.starts_at_zero()),
        };
        let si = if self.settings.of_whole_bodies && kind.kind.unit == "N/m" { "N" } else { kind.kind.unit };
        let key = Key::Bar { label: kind.label(), si, range, beyond, states };
        Show { scalar, range, key, view, sides, bodies }
    }

    /// Sides of the mirror lines on which the model lies, nothing, and what is seen.
    fn view_in_plane(&self) -> ([f64; 2], Extent<3>, Extent<2>) {
        let sides = self.stored.first().map_or([1.0; 2], |first| view::sides(self.nodes(first)));
        (sides, nothing(), mirrored(self.view(sides), self.mirror_lines()))
    }

    /// Nothing, the box around bodies and mirror images, and what is seen of them and of the obstacles near
    /// them.
    fn view_in_3d(&self) -> ([f64; 2], Extent<3>, Extent<2>) {
        let (own, sight) = (self.bodies(), self.sight());
        let bodies = mirrored(own, self.settings.mirror);
        let view = self.stored.iter().map(|frame| self.seen(frame, own, bodies, &sight)).fold(NOTHING, joined);
        ([1.0; 2], bodies, sight.aimed(view))
    }

    /// What is seen of one frame in 3D: of nodes in the box `own`, and of the obstacles near `bodies`.
    fn seen(&self, frame: &Stored, own: Extent<3>, bodies: Extent<3>, sight: &Sight) -> Extent<2> {
        let origin = self.origin();
        let places = frame.places::<3>().iter().map(|p| [0, 1, 2].map(|k| f64::from(p[k]) + origin[k]));
        let nodes = places.filter(|x| (0..3).all(|k| x[k] >= own[0][k] && x[k] <= own[1][k]));
        let solids = self.solids(frame, bodies);
        sight.view(nodes.chain(solids.iter().flat_map(|solid| solid.seen(bodies))))
    }

    /// Obstacles of a frame in 3D, beside these bodies.
    pub(super) fn solids(&self, frame: &Stored, bodies: Extent<3>) -> Vec<Solid> {
        let shapes = self.space.iter().flat_map(|space| &space.shapes);
        frame.surfaces.iter().zip(shapes).filter_map(|(points, shape)| shape.solid(points, bodies)).collect()
    }

    /// How a film in 3D is seen.
    pub(super) fn sight(&self) -> Sight {
        Sight::new(&self.settings.camera, self.settings.mirror)
    }

    fn mirror_lines(&self) -> [bool; 2] {
        [self.settings.mirror[0], self.settings.mirror[1]]
    }

    /// Positions of a frame, m.
    fn nodes<'a>(&self, frame: &'a Stored) -> impl ExactSizeIterator<Item = [f64; 2]> + Clone + use<'a> {
        let origin = self.origin();
        frame.places::<2>().iter().map(move |p| [f64::from(p[0]) + origin[0], f64::from(p[1]) + origin[1]])
    }

    /// What is to be seen of the obstacles beside `bodies` in one frame.
    fn obstacles(&self, frame: &Stored, bodies: Extent<2>, sides: [f64; 2]) -> Extent<2> {
        view::obstacles(&frame.obstacles, self.nodes(frame), bodies, view::room(bodies, self.mirror_lines(), sides))
    }

    /// Box of all finite positions, m. If single nodes have been thrown far away (a run that failed), they
    /// don't count.
    fn bodies<const D: usize>(&self) -> Extent<D> {
        let boxes: Vec<Extent<D>> = self.stored.iter().map(|frame| extent(frame.places::<D>().iter(), 0.0)).collect();
        let union = boxes.iter().copied().reduce(joined).unwrap_or(nothing());
        let mut view = union;
        if boxes.first().is_some_and(|first| size(union) > 4.0 * size(*first)) {
            let trimmed = self.stored.iter().map(|frame| extent(frame.places::<D>().iter(), 0.005)).reduce(joined).unwrap_or(union);
            if size(union) > 3.0 * size(trimmed) {
                view = trimmed;
            }
        }
        let origin = self.origin();
        view.map(|corner| std::array::from_fn(|k| corner[k] + origin[k]))
    }

    /// Box of all bodies in 2D and of the obstacles near them, m.
    pub(super) fn view(&self, sides: [f64; 2]) -> Extent<2> {
        let bodies = self.bodies();
        self.stored.iter().map(|frame| self.obstacles(frame, bodies, sides)).fold(bodies, joined)
    }

    /// What is decided for one frame alone: the box of its bodies and of the obstacles near them, m, within
    /// the film's view, as a still picture needs no room for where they were. A view that was asked for
    /// stays.
    pub(super) fn show_of(&self, frame: &Stored, show: &Show) -> Show {
        let Show { scalar, range, key, view: whole, sides, mut bodies } = show.clone();
        let mut view = whole;
        if self.settings.view.is_none() {
            let own = if self.is_in_3d() {
                let own = self.box_of::<3>(frame);
                bodies = mirrored(own, self.settings.mirror);
                let sight = self.sight();
                sight.aimed(self.seen(frame, own, bodies, &sight))
            } else {
                let own = self.box_of::<2>(frame);
                mirrored(joined(own, self.obstacles(frame, own, sides)), self.mirror_lines())
            };
            let kept = [[0, 1].map(|k| own[0][k].max(whole[0][k])), [0, 1].map(|k| own[1][k].min(whole[1][k]))];
            if (0..2).all(|k| kept[0][k] <= kept[1][k]) {
                view = kept;
            } else {
                bodies = show.bodies;
            }
        }
        Show { scalar, range, key, view, sides, bodies }
    }

    fn box_of<const D: usize>(&self, frame: &Stored) -> Extent<D> {
        let origin = self.origin();
        extent(frame.places::<D>().iter(), 0.0).map(|corner| std::array::from_fn(|k| corner[k] + origin[k]))
    }

    /// `t = 3.10 ms` for each stored frame, with as many decimals as distinguish them.
    pub(super) fn notes(&self) -> Vec<String> {
        let last = self.stored.iter().map(|frame| frame.time.abs()).filter(|t| t.is_finite()).fold(0.0, f64::max);
        let unit = unit("s", last);
        let interval = last * unit.factor / (self.stored.len().max(2) - 1) as f64;
        let digits = if interval > 0.0 { (1.0 - interval.log10().floor()).clamp(0.0, 4.0) as i32 } else { 0 };
        let step = 10f64.powi(-digits);
        debug_assert_eq!(decimals(step), digits as usize);
        self.stored.iter().map(|frame| format!("t = {} {}", number(frame.time * unit.factor, step), unit.name)).collect()
    }
}

/// Range of the colour map, and whether values lie below or above it. Single peaks far above everything else
/// don't set the range.
fn colour_range(values: impl Iterator<Item = f32> + Clone, from_zero: bool) -> ([f64; 2], [bool; 2]) {
    const SAMPLES: usize = 400_000;
    let count = values.clone().count();
    let mut sorted: Vec<f32> = values.clone().step_by(count.div_ceil(SAMPLES).max(1)).collect();
    if sorted.is_empty() {
        return ([0.0, 1.0], [false; 2]);
    }
    sorted.sort_unstable_by(f32::total_cmp);
    let at = |share: f64| f64::from(sorted[((sorted.len() - 1) as f64 * share).round() as usize]);
    let (least, most) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(f64::from(v)), b.max(f64::from(v))));
    let (calm_low, calm_high) = (at(0.002), at(0.998));
    let spread = calm_high - if from_zero { 0.0 } else { calm_low };
    let mut low = if from_zero || (least >= 0.0 && least < 0.5 * most) { 0.0 } else { least };
    let mut high = most;
    if spread > 0.0 {
        if most > calm_high + 0.6 * spread {
            high = calm_high;
        }
        if low < 0.0 && least < calm_low - 0.6 * spread {
            low = calm_low;
        }
    }
    if high - low <= 1e-9 * high.abs().max(low.abs()) {
        // One value throughout: the range has it in the middle, or starts at zero.
        let half = if low == 0.0 { 1.0 } else { 0.5 * low.abs() };
        return if from_zero && low >= 0.0 { ([0.0, high.max(low) + half], [false; 2]) } else { ([low - half, low + half], [false; 2]) };
    }
    ([low, high], [least < low, most > high])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_peak_does_not_set_the_colour_range() {
        let values = (0..1000).map(|k| k as f32 * 1e5).chain([1e12]);
        let (range, beyond) = colour_range(values, true);
        assert!(range[0] == 0.0 && (0.9e8..1.01e8).contains(&range[1]), "{range:?}");
        assert_eq!(beyond, [false, true]);
        assert_eq!(colour_range([0.1f32, 0.2, 0.3].into_iter(), true).1, [false, false]);
    }

    #[test]
    fn a_constant_or_empty_field_has_a_range() {
        for (values, zero) in [(vec![], true), (vec![0.0f32], true), (vec![5.0; 9], false), (vec![-5.0; 9], false), (vec![5.0; 9], true)] {
            let ([low, high], _) = colour_range(values.iter().copied(), zero);
            assert!(low < high, "{values:?}");
        }
    }
}
