//! Assembly of nodal forces from the forces of chunks of elements: each node sums its slots in a fixed order,
//! for any number of threads.
//!
//! A chunk has summed the forces of its own elements on its nodes already, in the order of the elements
//! (`block/local.rs`), so most nodes have one slot. The slots of a node ascend by block and chunk.

use crate::block::NO_NODE;
use crate::rows::Rows;
use embate_lanes::BATCH;

/// Slots of every node.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    slots: Rows<u32>,
    /// Of each group of eight nodes with one slot each, one beside the other: the first; else [`NO_NODE`].
    rows: Vec<u32>,
    /// Slots of all blocks.
    pub count: usize,
}

impl Assembly {
    /// For `nodes` nodes and blocks with the node of each of their slots.
    #[must_use]
    pub fn new(nodes: usize, blocks: &[&[u32]]) -> Self {
        let all = (0u32..).zip(blocks.iter().copied().flatten().copied()).filter(|&(_, node)| node != NO_NODE);
        let slots = Rows::new(nodes, all.map(|(slot, node)| (node, slot)));
        let row = |group: usize| {
            let first = slots.of(group * BATCH).first().copied().unwrap_or(NO_NODE);
            let beside = (0..BATCH).all(|k| slots.of(group * BATCH + k) == [first.saturating_add(k as u32)]);
            if beside { first } else { NO_NODE }
        };
        let rows = (0..nodes / BATCH).map(row).collect();
        Self { rows, slots, count: blocks.iter().map(|block| block.len()).sum() }
    }

    /// Forces at the eight nodes of a group, N/m in 2D.
    #[inline(always)]
    #[must_use]
    pub fn forces<const D: usize>(&self, group: usize, forces: &[[f64; D]]) -> [[f64; D]; BATCH] {
        // Nodes inside a chunk lie side by side in it as they do in the mesh.
        if let Some(row) = forces.get(self.rows[group] as usize..).and_then(|row| row.first_chunk()) {
            return *row;
        }
        let mut sums = [[0.0; D]; BATCH];
        for (k, sum) in sums.iter_mut().enumerate() {
            *sum = self.force(group * BATCH + k, forces);
        }
        sums
    }

    /// Sum of the forces at `node`, N/m in 2D.
    #[inline]
    #[must_use]
    pub fn force<const D: usize>(&self, node: usize, forces: &[[f64; D]]) -> [f64; D] {
        let Some((&first, others)) = self.slots.of(node).split_first() else { return [0.0; D] };
        let mut sum = forces[first as usize];
        for &slot in others {
            let other = &forces[slot as usize];
            for d in 0..D {
                sum[d] += other[d];
            }
        }
        sum
    }
}
