//! The bytes of a checkpoint file: a head, then blocks, each with a check sum over what is stored, so that a
//! torn or flipped byte is found before anything is made of it.
//!
//! ```text
//! head    magic 8 | format 4 | length of the header 4 | header (JSON) | CRC32 of all that 4
//! block   length of the name 4 | name | plain length 8 | packed length 8 | CRC32 of the packed bytes 4
//!         | CRC32 of all that 4 | packed bytes
//! ```
//!
//! Numbers are little-endian. Lengths are held against what is left of the file before room is made; the
//! number of blocks is in the header.

use super::pack::{self, Packed};
use crate::threads::Threads;
use embate_solver::archive::Section;
use flate2::Crc;
use std::fs::File;
use std::io::{self, Write};

/// The first bytes of a checkpoint; the line ends are there to find a copy that was made as text.
const MAGIC: &[u8; 8] = b"embate\r\n";
/// Format of the file and of what the solver keeps; another one can't be read.
const FORMAT: u32 = 2;

/// A block to write.
pub(super) struct Block<'a> {
    pub(super) name: &'a str,
    pub(super) section: &'a Section,
}

fn crc(pieces: &[&[u8]]) -> u32 {
    let mut crc = Crc::new();
    pieces.iter().for_each(|piece| crc.update(piece));
    crc.sum()
}

/// Writes a file; `threads` pack it.
pub(super) fn write(mut file: File, header: &[u8], blocks: &[Block<'_>], threads: &Threads) -> io::Result<File> {
    let mut head = MAGIC.to_vec();
    head.extend(FORMAT.to_le_bytes());
    head.extend((header.len() as u32).to_le_bytes());
    head.extend(header);
    head.extend(crc(&[&head]).to_le_bytes());
    file.write_all(&head)?;
    for Block { name, section } in blocks {
        let Packed { pieces } = pack::pack(&section.bytes, threads);
        let slices: Vec<&[u8]> = pieces.iter().map(Vec::as_slice).collect();
        let length: usize = slices.iter().map(|piece| piece.len()).sum();
        let mut lead = (name.len() as u32).to_le_bytes().to_vec();
        lead.extend(name.as_bytes());
        lead.extend((section.bytes.len() as u64).to_le_bytes());
        lead.extend((length as u64).to_le_bytes());
        lead.extend(crc(&slices).to_le_bytes());
        lead.extend(crc(&[&lead]).to_le_bytes());
        file.write_all(&lead)?;
        slices.iter().try_for_each(|piece| file.write_all(piece))?;
    }
    Ok(file)
}

/// What is left to read.
struct Rest<'a>(&'a [u8]);

impl<'a> Rest<'a> {
    fn take(&mut self, count: usize) -> Result<&'a [u8], String> {
        let (first, rest) = self.0.split_at_checked(count).ok_or("it ends too early")?;
        self.0 = rest;
        Ok(first)
    }

    fn number<const N: usize>(&mut self) -> Result<u64, String> {
        let mut bytes = [0; 8];
        bytes[..N].copy_from_slice(self.take(N)?);
        Ok(u64::from_le_bytes(bytes))
    }

    fn length<const N: usize>(&mut self) -> Result<usize, String> {
        let length = self.number::<N>()?;
        usize::try_from(length).map_err(|_| format!("a length of {length} bytes is impossible"))
    }
}

/// What a file begins with.
pub(super) struct Head<'a> {
    format: u64,
    pub(super) header: &'a [u8],
    rest: &'a [u8],
}

impl<'a> Head<'a> {
    /// What follows; only this format can be read.
    pub(super) fn rest(&self) -> Result<&'a [u8], String> {
        if self.format == u64::from(FORMAT) {
            Ok(self.rest)
        } else {
            Err(format!("its format is {}, and this program reads {FORMAT}", self.format))
        }
    }
}

/// The head of a file, of whatever format.
pub(super) fn head(bytes: &[u8]) -> Result<Head<'_>, String> {
    let mut rest = Rest(bytes);
    if rest.take(MAGIC.len())? != MAGIC {
        return Err("it does not begin as a checkpoint does".into());
    }
    let format = rest.number::<4>()?;
    let length = rest.length::<4>()?;
    let header = rest.take(length)?;
    let end = bytes.len() - rest.0.len();
    if rest.number::<4>()? != u64::from(crc(&[&bytes[..end]])) {
        return Err("the check sum of its head is wrong".into());
    }
    Ok(Head { format, header, rest: rest.0 })
}

/// The blocks that follow the head.
pub(super) fn blocks(bytes: &[u8], count: usize, threads: &Threads) -> Result<Vec<Section>, String> {
    let mut rest = Rest(bytes);
    let mut sections = Vec::new();
    for _ in 0..count {
        let lead = rest.0;
        let length = rest.length::<4>()?;
        let name = rest.take(length)?;
        let (plain, packed, sum) = (rest.length::<8>()?, rest.length::<8>()?, rest.number::<4>()?);
        let lead = &lead[..lead.len() - rest.0.len()];
        if rest.number::<4>()? != u64::from(crc(&[lead])) {
            return Err("the check sum of the head of a block is wrong".into());
        }
        let name = String::from_utf8_lossy(name).into_owned();
        let stored = rest.take(packed)?;
        if sum != u64::from(crc(&[stored])) {
            return Err(format!("the check sum of the block \"{name}\" is wrong"));
        }
        let bytes = pack::unpack(stored, plain, threads).ok_or_else(|| format!("the block \"{name}\" can't be unpacked"))?;
        sections.push(Section { name, bytes });
    }
    if rest.0.is_empty() { Ok(sections) } else { Err("there are bytes after its end".into()) }
}
