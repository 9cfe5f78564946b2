//! Lists of any length, one for each key, in one array (compressed rows): slots of a node, elements at it,
//! edges from it. Counted, then put into their places, so that building costs what there is.
//!
//! Mesh, blocks, assembly and contact make them from connectivities; what visits the neighbours of a node
//! reads them.

/// A list of items for each key below a count.
#[derive(Clone, Debug, PartialEq)]
pub struct Rows<T> {
    /// Where the items of each key begin; one more than keys.
    starts: Vec<u32>,
    items: Vec<T>,
}

impl<T> Default for Rows<T> {
    fn default() -> Self {
        Self { starts: vec![0], items: Vec::new() }
    }
}

impl<T: Copy + Default> Rows<T> {
    /// From pairs of a key below `count` and an item; the items of a key keep the order of the pairs.
    pub fn new(count: usize, pairs: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        let mut rows = Self::default();
        rows.fill(count, pairs);
        rows
    }

    /// The same in the memory that is there.
    pub fn fill(&mut self, count: usize, pairs: impl Iterator<Item = (u32, T)> + Clone) {
        let Self { starts, items } = self;
        // Counted two places further: the sums are then one place further, where each moves on to the end of
        // its key, which is the start of the next.
        starts.clear();
        starts.resize(count + 2, 0);
        pairs.clone().for_each(|(key, _)| starts[key as usize + 2] += 1);
        for key in 0..count {
            starts[key + 2] += starts[key + 1];
        }
        items.clear();
        items.resize(starts[count + 1] as usize, T::default());
        for (key, item) in pairs {
            let place = &mut starts[key as usize + 1];
            items[*place as usize] = item;
            *place += 1;
        }
        starts.truncate(count + 1);
    }

    /// Number of keys.
    pub fn count(&self) -> usize {
        self.starts.len() - 1
    }

    /// Items of a key below the count.
    #[inline]
    pub fn of(&self, key: usize) -> &[T] {
        &self.items[self.starts[key] as usize..self.starts[key + 1] as usize]
    }

    /// The same, to be put into another order.
    pub fn of_mut(&mut self, key: usize) -> &mut [T] {
        &mut self.items[self.starts[key] as usize..self.starts[key + 1] as usize]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn items_keep_their_order_and_keys_without_any_have_none() {
        let rows = Rows::new(4, [(2, 'a'), (0, 'b'), (2, 'c'), (3, 'd'), (2, 'e')].into_iter());
        assert_eq!(rows.count(), 4);
        assert_eq!([0, 1, 2, 3].map(|key| rows.of(key)), [&['b'][..], &[], &['a', 'c', 'e'], &['d']]);
    }
}
