//! A frame as a film keeps it: single precision, and in 3D the skin alone.
//! Made of the frames of a run; the checkpoint of a run has them too.

use crate::outline::Line;
use crate::picture::space::obstacle::Shape;
use crate::picture::space::{Skin, Skinner};
use embate_solver::archive::{Archive, ArchiveResult, Persist};
use embate_solver::output::{Cells, Frame};
use std::sync::Arc;

#[derive(Clone, Debug, Default)]
pub(super) struct Stored {
    pub(super) number: usize,
    pub(super) time: f64,
    /// From the film's origin, m, one after the other: of all nodes, in 3D of those of the skin.
    pub(super) positions: Vec<f32>,
    /// Eroded cells, ascending.
    pub(super) gone: Vec<u32>,
    pub(super) obstacles: Vec<Line>,
    /// In 3D: points of each obstacle, m.
    pub(super) surfaces: Vec<Vec<[f64; 3]>>,
    /// In 3D: what is seen of the cells.
    pub(super) skin: Option<Arc<Skin>>,
    /// Its cells, where they are no more those of the film: in 3D none, the skin is enough.
    pub(super) past: Option<Arc<Cells>>,
    /// One list per scalar: of nodes or cells, in 3D of the skin's nodes, or facets and bars.
    pub(super) values: Vec<Vec<f32>>,
}

impl Stored {
    /// Without the skin, which others share.
    pub(super) fn bytes(&self) -> usize {
        4 * self.positions.len()
            + 16 * self.obstacles.iter().map(|line| line.points.len()).sum::<usize>()
            + 24 * self.surfaces.iter().map(Vec::len).sum::<usize>()
            + 4 * self.values.iter().map(Vec::len).sum::<usize>()
    }

    /// The positions.
    pub(super) fn places<const D: usize>(&self) -> &[[f32; D]] {
        self.positions.as_chunks().0
    }
}

impl Persist for Stored {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        // The skin follows from the cells that are gone; the film has cells and skins of the past.
        let Self { number, time, positions, gone, obstacles, surfaces, skin: _, past: _, values } = self;
        number.persist(archive)?;
        time.persist(archive)?;
        positions.persist(archive)?;
        gone.persist(archive)?;
        let mut lines: Vec<(Vec<[f64; 2]>, bool)> =
            std::mem::take(obstacles).into_iter().map(|line| (line.points, line.is_endless)).collect();
        lines.persist(archive)?;
        *obstacles = lines.into_iter().map(|(points, is_endless)| Line { points, is_endless }).collect();
        surfaces.persist(archive)?;
        values.persist(archive)
    }
}

/// Cells or skins of the frames of a film that are no more those of its present cells: each as often as it
/// serves frames that follow each other, and once.
pub(super) fn persist_past(stored: &mut [Stored], archive: &mut Archive<'_>) -> ArchiveResult {
    // Cells and skin of the last frame that is so.
    let mut last: Option<(Arc<Cells>, Option<Arc<Skin>>)> = None;
    for frame in stored {
        let mut is_past = frame.past.is_some();
        is_past.persist(archive)?;
        if !is_past {
            continue;
        }
        let is_same = |(cells, skin): &(Arc<Cells>, Option<Arc<Skin>>)| {
            frame.past.as_ref().is_some_and(|own| Arc::ptr_eq(own, cells))
                && frame.skin.as_ref().zip(skin.as_ref()).is_none_or(|(own, skin)| Arc::ptr_eq(own, skin))
        };
        let mut is_shared = last.as_ref().is_some_and(is_same);
        is_shared.persist(archive)?;
        if !is_shared {
            let mut cells = frame.past.as_deref().cloned().unwrap_or_default();
            let mut skin = frame.skin.as_deref().cloned();
            cells.persist(archive)?;
            skin.persist(archive)?;
            last = Some(if archive.reads() {
                (Arc::new(cells), skin.map(Arc::new))
            } else {
                (frame.past.clone().unwrap_or_default(), frame.skin.clone())
            });
        }
        archive.check(last.is_some(), "a frame has cells of none before it")?;
        let (cells, skin) = last.clone().unzip();
        (frame.past, frame.skin) = (cells, skin.flatten());
    }
    Ok(())
}

/// Cells that were eroded, ascending.
pub(in crate::picture) fn gone(frame: &Frame) -> Vec<u32> {
    let Some(alive) = frame.fields.iter().find(|field| field.kind.name == "alive") else { return Vec::new() };
    (0..).zip(&alive.values).filter(|(_, alive)| **alive == 0.0).map(|(cell, _)| cell).collect()
}

/// What a film in 3D needs to store its frames.
#[derive(Clone, Debug)]
pub(super) struct Space {
    skinner: Skinner,
    /// The last skin, and the cells without which it is.
    skin: Arc<Skin>,
    gone: Vec<u32>,
    /// What does not change of the obstacles.
    pub(super) shapes: Vec<Shape>,
}

impl Space {
    pub(super) fn new(cells: &Cells, frame: &Frame) -> Self {
        let nodes = frame.nodes();
        let skinner = Skinner::new(cells, &|node| if (node as usize) < nodes { frame.place(node as usize) } else { [f64::NAN; 3] });
        let skin = Arc::new(skinner.skin(cells, &[]));
        Self { skinner, skin, gone: Vec::new(), shapes: Vec::new() }
    }

    /// The skin without these cells: that of the frame before as long as no other cell is gone.
    pub(super) fn skin(&mut self, cells: &Cells, gone: &[u32]) -> Arc<Skin> {
        if self.gone != gone {
            (self.skin, self.gone) = (Arc::new(self.skinner.skin(cells, gone)), gone.to_vec());
        }
        Arc::clone(&self.skin)
    }
}

/// Values of nodes or cells of a frame at the nodes of a skin, or at its facets and bars.
pub(super) fn on_skin(skin: &Skin, at_nodes: bool, values: &[f32]) -> Vec<f32> {
    let value = |index: u32| values.get(index as usize).copied().unwrap_or(f32::NAN);
    if at_nodes {
        skin.nodes.iter().map(|&node| value(node)).collect()
    } else {
        skin.facets.iter().map(|facet| facet.cell).chain(skin.bars.iter().map(|bar| bar.cell)).map(value).collect()
    }
}
