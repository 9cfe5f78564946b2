//! The state of a run as bytes: one function of each type for both directions, so that writing and reading
//! cannot diverge.
//!
//! Whatever changes while a run continues and can't be made again of the model, bit for bit, is [`Persist`]:
//! its one function hands every value to an [`Archive`], which either writes it down or fills it. Values are
//! little-endian; lists have their length before them, and what is read of a length is held against the bytes
//! that are left before room is made. What is read is checked where it would be used as an index. The state
//! comes from [`crate::simulation`]; who stores the sections is not known here.

use embate_lanes::Batch;
use std::collections::BTreeMap;

/// A piece of the state: what belongs together, mostly numbers of eight bytes.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Section {
    /// What it holds.
    pub name: String,
    /// Its values, little-endian.
    pub bytes: Vec<u8>,
}

/// Why bytes are not the state of a model.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ArchiveError(pub(crate) Box<str>);

impl ArchiveError {
    pub(crate) fn new(what: impl Into<String>) -> Self {
        Self(what.into().into())
    }
}

/// How keeping ended.
pub type ArchiveResult = Result<(), ArchiveError>;

/// What is written to, or read from.
pub struct Archive<'a> {
    /// Those that were written.
    written: Vec<Section>,
    /// Those that are left to read, and the rest of the one in work; `None`: it writes.
    left: Option<(&'a [Section], &'a [u8])>,
    /// What indices of nodes, and of nodes and rigid bodies, must be below.
    pub(crate) nodes: usize,
    pub(crate) places: usize,
}

impl<'a> Archive<'a> {
    /// One to write to.
    #[must_use]
    pub fn new() -> Self {
        Self { written: Vec::new(), left: None, nodes: 0, places: 0 }
    }

    /// One to read from.
    #[must_use]
    pub fn of(sections: &'a [Section]) -> Self {
        Self { left: Some((sections, &[])), ..Self::new() }
    }

    /// Whether values are filled.
    #[must_use]
    pub fn reads(&self) -> bool {
        self.left.is_some()
    }

    /// Begins a section.
    ///
    /// # Errors
    /// Another one comes next, or bytes of the last one are left.
    pub fn section(&mut self, name: &str) -> ArchiveResult {
        self.end_section()?;
        match &mut self.left {
            None => self.written.push(Section { name: name.into(), bytes: Vec::new() }),
            Some((sections, rest)) => match sections.split_first() {
                Some((first, others)) if first.name == name => (*sections, *rest) = (others, &first.bytes),
                Some((first, _)) => return Err(ArchiveError::new(format!("there is \"{}\" where \"{name}\" should be", first.name))),
                None => return Err(ArchiveError::new(format!("\"{name}\" is missing"))),
            },
        }
        Ok(())
    }

    fn end_section(&self) -> ArchiveResult {
        match self.left {
            Some((_, rest)) if !rest.is_empty() => Err(ArchiveError::new(format!("{} bytes are left over", rest.len()))),
            _ => Ok(()),
        }
    }

    /// What was written; nothing must be left to read.
    ///
    /// # Errors
    /// Something is left.
    pub fn finish(self) -> Result<Vec<Section>, ArchiveError> {
        self.end_section()?;
        match self.left {
            Some(([first, ..], _)) => Err(ArchiveError::new(format!("nothing is known of \"{}\"", first.name))),
            _ => Ok(self.written),
        }
    }

    /// Bytes that are left of the section.
    fn rest(&self) -> usize {
        self.left.map_or(usize::MAX, |(_, rest)| rest.len())
    }

    /// Writes or fills the bytes of a value.
    #[inline(always)]
    fn pass<const N: usize>(&mut self, bytes: &mut [u8; N]) -> ArchiveResult {
        match &mut self.left {
            None => match self.written.last_mut() {
                Some(section) => section.bytes.extend_from_slice(bytes),
                None => return Err(ArchiveError::new("no section has begun")),
            },
            Some((_, rest)) => match rest.split_first_chunk() {
                Some((first, others)) => (*bytes, *rest) = (*first, others),
                None => return Err(ArchiveError::new("it ends too early")),
            },
        }
        Ok(())
    }

    /// Makes room for so many bytes.
    fn expect(&mut self, bytes: usize) {
        if let (None, Some(section)) = (self.left, self.written.last_mut()) {
            section.bytes.reserve(bytes);
        }
    }

    /// Nothing where what was read is possible.
    ///
    /// # Errors
    /// What is wrong, where it is not.
    pub fn check(&self, is_possible: bool, what: &str) -> ArchiveResult {
        if is_possible { Ok(()) } else { Err(ArchiveError::new(what)) }
    }

    /// Forces, or moments, on some nodes, each named once.
    ///
    /// # Errors
    /// There are no such nodes.
    pub(crate) fn on_nodes<const N: usize>(&mut self, list: &mut Vec<(u32, [f64; N])>) -> ArchiveResult {
        let mut count = list.len();
        count.persist(self)?;
        self.check(count <= self.nodes, "forces act on more nodes than there are")?;
        list.resize(count, (0, [0.0; N]));
        for (node, force) in list {
            node.persist(self)?;
            force.persist(self)?;
            self.check((*node as usize) < self.nodes, "a force acts on a node that is not there")?;
        }
        Ok(())
    }
}

impl Default for Archive<'_> {
    fn default() -> Self {
        Self::new()
    }
}

/// What is part of the state.
pub trait Persist {
    /// Writes this to an archive, or fills it from there.
    ///
    /// # Errors
    /// What is read can't be.
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult;
}

macro_rules! numbers {
    ($($number:ty),*) => {$(
        impl Persist for $number {
            #[inline(always)]
            fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
                let mut bytes = self.to_le_bytes();
                archive.pass(&mut bytes)?;
                *self = Self::from_le_bytes(bytes);
                Ok(())
            }
        }
    )*};
}

numbers!(u8, u16, u32, i32, f32, f64);

/// Numbers of eight bytes are counts, to which a run adds.
const COUNT_MAX: u64 = 1 << 62;

impl Archive<'_> {
    /// A number of eight bytes: written, or what is read in its place.
    #[inline(always)]
    fn number(&mut self, number: u64) -> Result<u64, ArchiveError> {
        let mut bytes = number.to_le_bytes();
        self.pass(&mut bytes)?;
        Ok(u64::from_le_bytes(bytes))
    }
}

impl Persist for u64 {
    #[inline(always)]
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        *self = archive.number(*self)?;
        archive.check(*self < COUNT_MAX, "a count is too large")
    }
}

impl Persist for usize {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let number = archive.number(*self as u64)?;
        *self = Self::try_from(number).map_err(|_| ArchiveError::new(format!("{number} is too large a number")))?;
        Ok(())
    }
}

impl Persist for bool {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut byte = u8::from(*self);
        byte.persist(archive)?;
        *self = byte == 1;
        archive.check(byte < 2, "invalid boolean")
    }
}

impl<T: Persist, const N: usize> Persist for [T; N] {
    #[inline(always)]
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.iter_mut().try_for_each(|item| item.persist(archive))
    }
}

impl Persist for Batch {
    #[inline(always)]
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.0.persist(archive)
    }
}

impl<A: Persist, B: Persist> Persist for (A, B) {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        self.0.persist(archive)?;
        self.1.persist(archive)
    }
}

impl<T: Persist + Default> Persist for Option<T> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut is_there = self.is_some();
        is_there.persist(archive)?;
        if !is_there {
            *self = None;
            return Ok(());
        }
        self.get_or_insert_default().persist(archive)
    }
}

/// A list whose length the model gives.
impl<T: Persist> Persist for [T] {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut count = self.len();
        count.persist(archive)?;
        if count != self.len() {
            return Err(ArchiveError::new(format!("a list has {count} items, the model's {}", self.len())));
        }
        archive.expect(size_of_val(self));
        self.iter_mut().try_for_each(|item| item.persist(archive))
    }
}

/// A list of any length.
impl<T: Persist + Default> Persist for Vec<T> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut count = self.len();
        count.persist(archive)?;
        if !archive.reads() {
            archive.expect(size_of_val(&self[..]));
            return self.iter_mut().try_for_each(|item| item.persist(archive));
        }
        // Every item has a byte at least.
        if count > archive.rest() {
            return Err(ArchiveError::new(format!("a list of {count} items has {} bytes", archive.rest())));
        }
        self.clear();
        self.reserve(count.min(archive.rest() / size_of::<T>().max(1) + 1));
        for _ in 0..count {
            let mut item = T::default();
            item.persist(archive)?;
            self.push(item);
        }
        Ok(())
    }
}

impl Persist for String {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut bytes = std::mem::take(self).into_bytes();
        bytes.persist(archive)?;
        *self = Self::from_utf8(bytes).map_err(|_| ArchiveError::new("a text is no text"))?;
        Ok(())
    }
}

impl<K: Persist + Default + Ord + Clone, V: Persist + Default> Persist for BTreeMap<K, V> {
    fn persist(&mut self, archive: &mut Archive<'_>) -> ArchiveResult {
        let mut items: Vec<(K, V)> = std::mem::take(self).into_iter().collect();
        items.persist(archive)?;
        *self = items.into_iter().collect();
        Ok(())
    }
}

/// Makes a structure [`Persist`] all of its fields: each is named, so that none can be forgotten.
macro_rules! persist_all {
    ($name:ty { $($field:ident),* $(,)? } $(but { $($left_out:ident),* })?) => {
        impl $crate::archive::Persist for $name {
            fn persist(&mut self, archive: &mut $crate::archive::Archive<'_>) -> $crate::archive::ArchiveResult {
                let Self { $($field),* $(, $($left_out: _),*)? } = self;
                $($crate::archive::Persist::persist($field, archive)?;)*
                Ok(())
            }
        }
    };
}

/// Keeps several values in this order.
macro_rules! persist_each {
    ($archive:expr; $($value:expr),* $(,)?) => {{
        $($crate::archive::Persist::persist($value, $archive)?;)*
    }};
}

pub(crate) use {persist_all, persist_each};

/// A plain value: copied, compared and kept.
pub trait Plain: Copy + std::fmt::Debug + Default + PartialEq + Persist + Send + Sync + 'static {}
impl<T: Copy + std::fmt::Debug + Default + PartialEq + Persist + Send + Sync + 'static> Plain for T {}

#[cfg(test)]
mod tests {
    use super::*;

    type All = (Vec<[f64; 2]>, (Option<u64>, (String, (BTreeMap<usize, bool>, [i32; 2]))));

    fn some() -> All {
        let map = [(3, true), (70_000, false)].into_iter().collect();
        (vec![[1.0, -0.0], [f64::NAN, f64::INFINITY]], (Some(7), ("place ½".into(), (map, [-1, i32::MIN]))))
    }

    fn written() -> Vec<Section> {
        let mut archive = Archive::new();
        archive.section("all").unwrap();
        some().persist(&mut archive).unwrap();
        archive.finish().unwrap()
    }

    fn read(sections: &[Section]) -> Result<All, ArchiveError> {
        let mut archive = Archive::of(sections);
        let mut all = All::default();
        archive.section("all")?;
        all.persist(&mut archive)?;
        archive.finish()?;
        Ok(all)
    }

    #[test]
    fn a_count_to_which_nothing_can_be_added_is_refused() {
        let sections = [Section { name: "all".into(), bytes: u64::MAX.to_le_bytes().to_vec() }];
        let mut archive = Archive::of(&sections);
        archive.section("all").unwrap();
        assert!(0_u64.persist(&mut archive).unwrap_err().0.contains("too large"));
    }

    #[test]
    fn what_was_written_is_read_bit_by_bit() {
        assert_eq!(format!("{:?}", read(&written()).unwrap()), format!("{:?}", some()));
    }

    #[test]
    fn no_byte_can_be_missing_or_left_and_no_damage_panics_or_asks_for_much_memory() {
        let sections = written();
        for length in 0..sections[0].bytes.len() {
            let short = Section { bytes: sections[0].bytes[..length].to_vec(), ..sections[0].clone() };
            assert!(read(&[short]).is_err(), "{length}");
        }
        let mut long = sections[0].clone();
        long.bytes.push(0);
        assert!(read(&[long]).is_err());
        for at in 0..sections[0].bytes.len() {
            for flip in [1, 0x80, 0xff] {
                let mut damaged = sections[0].clone();
                damaged.bytes[at] ^= flip;
                // That a number is another one, only check sums find.
                let _ = read(&[damaged]);
            }
        }
        assert!(read(&[]).is_err() && read(&[sections[0].clone(), sections[0].clone()]).is_err());
        assert!(read(&[Section { name: "none".into(), ..sections[0].clone() }]).is_err());
    }
}
