//! From the forces that chunks of elements leave to nodal forces: each node sums its slots in a fixed order, whoever does it.
//!
//! A chunk has summed the forces of its own elements on its nodes already, in the order of the elements (`block/local.rs`), so most nodes have one slot. The slots of a
//! node ascend by block and chunk.

use crate::block::NO_NODE;
use embate_lanes::BATCH;

/// Slots of every node.
#[derive(Clone, Debug, Default)]
pub struct Assembly {
    /// Where each node's slots begin; one more than nodes.
    starts: Vec<u32>,
    slots: Vec<u32>,
    /// Of each group of eight nodes with one slot each, one beside the other: the first; else [`NO_NODE`].
    rows: Vec<u32>,
    /// Slots of all blocks.
    pub count: usize,
}

impl Assembly {
    /// For `nodes` nodes and blocks with the node of each of their slots.
    #[must_use]
    pub fn new(nodes: usize, blocks: &[&[u32]]) -> Self {
        let all = || (0u32..).zip(blocks.iter().copied().flatten().copied()).filter(|&(_, node)| node != NO_NODE);
        let mut starts = vec![0u32; nodes + 1];
        all().for_each(|(_, node)| starts[node as usize + 1] += 1);
        for node in 0..nodes {
            starts[node + 1] += starts[node];
        }
        let (mut next, mut slots) = (starts.clone(), vec![0; starts[nodes] as usize]);
        for (slot, node) in all() {
            slots[next[node as usize] as usize] = slot;
            next[node as usize] += 1;
        }
        let row = |group: usize| {
            let own = starts[group * BATCH] as usize..starts[(group + 1) * BATCH] as usize;
            let single = (0..BATCH).all(|k| starts[group * BATCH + k + 1] == starts[group * BATCH + k] + 1);
            let beside = single && slots[own.clone()].windows(2).all(|pair| pair[1] == pair[0] + 1);
            if beside { slots[own.start] } else { NO_NODE }
        };
        let rows = (0..nodes / BATCH).map(row).collect();
        Self { rows, starts, slots, count: blocks.iter().map(|block| block.len()).sum() }
    }

    /// Forces at the eight nodes of a group, N/m in the plane.
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

    /// Sum of the forces at `node`, N/m in the plane.
    #[inline]
    #[must_use]
    pub fn force<const D: usize>(&self, node: usize, forces: &[[f64; D]]) -> [f64; D] {
        let slots = &self.slots[self.starts[node] as usize..self.starts[node + 1] as usize];
        let Some((&first, others)) = slots.split_first() else { return [0.0; D] };
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
