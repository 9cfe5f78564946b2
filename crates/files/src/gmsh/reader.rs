//! A cursor over the bytes of a .msh file: numbers of a text or binary file through the same calls, and the
//! `$Section` marks around them.
//!
//! The bytes come from [`super::parse`]; `version2.rs` and `version4.rs` ask for what the format says comes
//! next. Whatever is not there becomes a fault with its line (text) or byte offset (binary). A count is
//! handed out only after a check against the bytes that are left, so no file makes the program allocate more
//! than a small multiple of its own size.

use crate::gmsh::messages::DAMAGED;
use embate_solver::error::Fault;
use embate_solver::message::Message;
use std::str::FromStr;

/// How numbers stand in the file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    Binary { big_endian: bool, size_bytes: usize },
}

/// Least number of bytes that one item takes: in text one digit and one separator for each number.
#[derive(Clone, Copy, Debug)]
pub(super) struct Least {
    /// Numbers of an item in a text file.
    pub(super) numbers: usize,
    /// Bytes of an item in a binary file.
    pub(super) bytes: usize,
}

const CUT: &str = "the file was cut, or a count before this place is too large; export the mesh again";
const SHORT: &str = "a number is missing on this line, or a count before it is too large; export the mesh again";
const LONG: &str = "a number too many on this line, or a count before it is too small; export the mesh again";

/// A position in the bytes of a .msh file.
#[derive(Clone, Debug)]
pub(super) struct Reader<'a> {
    bytes: &'a [u8],
    source: &'a str,
    at: usize,
    encoding: Encoding,
}

impl<'a> Reader<'a> {
    pub(super) fn new(bytes: &'a [u8], source: &'a str) -> Self {
        Self { bytes, source, at: 0, encoding: Encoding::Text }
    }

    pub(super) fn set_encoding(&mut self, encoding: Encoding) {
        self.encoding = encoding;
    }

    pub(super) fn is_binary(&self) -> bool {
        self.encoding != Encoding::Text
    }

    /// Offset of the next byte.
    pub(super) fn at(&self) -> usize {
        self.at
    }

    pub(super) fn is_at_end(&self) -> bool {
        self.at >= self.bytes.len()
    }

    pub(super) fn source(&self) -> &'a str {
        self.source
    }

    /// A fault at the byte offset `at`, given as a line in a text file.
    pub(super) fn fault(&self, kind: &'static Message, at: usize, message: impl Into<String>, help: impl Into<String>) -> Fault {
        let place = match self.encoding {
            Encoding::Text => {
                let before = &self.bytes[..at.min(self.bytes.len())];
                format!("line {}", 1 + before.iter().filter(|b| **b == b'\n').count())
            }
            Encoding::Binary { .. } => format!("byte {at}"),
        };
        Fault::new(kind, format!("{}, {place}", self.source), message, help)
    }

    fn rest(&self) -> &'a [u8] {
        &self.bytes[self.at.min(self.bytes.len())..]
    }

    // ----
    // text

    /// Skips blanks and line ends.
    pub(super) fn skip_space(&mut self) {
        self.at += self.rest().iter().take_while(|b| b.is_ascii_whitespace()).count();
    }

    fn skip_blanks(&mut self) {
        self.at += self.rest().iter().take_while(|b| matches!(b, b' ' | b'\t')).count();
    }

    /// The next word on this line; `what` says what is expected.
    pub(super) fn word(&mut self, what: &str) -> Result<&'a [u8], Fault> {
        self.skip_blanks();
        let rest = self.rest();
        let length = rest.iter().take_while(|b| !b.is_ascii_whitespace()).count();
        match rest.first() {
            None => Err(self.fault(&DAMAGED, self.at, format!("the file ends where {what} is expected"), CUT)),
            Some(b'$') => Err(self.fault(&DAMAGED, self.at, format!("expected {what}, found {}", shown(&rest[..length])), CUT)),
            Some(_) if length == 0 => Err(self.fault(&DAMAGED, self.at, format!("the line ends where {what} is expected"), SHORT)),
            Some(_) => {
                self.at += length;
                Ok(&rest[..length])
            }
        }
    }

    /// A number written as text, in whatever kind of file.
    pub(super) fn text<T: FromStr>(&mut self, what: &str) -> Result<T, Fault> {
        let word = self.word(what)?;
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number.ok_or_else(|| {
            let at = self.at - word.len();
            self.fault(&DAMAGED, at, format!("expected {what}, found {}", shown(word)), "the file is damaged here; export the mesh again")
        })
    }

    /// The rest of the line without its end and outer blanks.
    pub(super) fn line(&mut self) -> &'a [u8] {
        let rest = self.rest();
        let length = rest.iter().take_while(|b| **b != b'\n').count();
        self.at += (length + 1).min(rest.len());
        rest[..length].trim_ascii()
    }

    /// Goes past the end of this line, on which nothing else may stand.
    pub(super) fn end_of_line(&mut self) -> Result<(), Fault> {
        self.skip_blanks();
        let rest = self.rest();
        let length = match rest {
            [] => 0,
            [b'\n', ..] => 1,
            [b'\r', b'\n', ..] => 2,
            _ => {
                let word = rest.split(u8::is_ascii_whitespace).next().unwrap_or(rest);
                return Err(self.fault(&DAMAGED, self.at, format!("expected the end of the line, found {}", shown(word)), LONG));
            }
        };
        self.at += length;
        Ok(())
    }

    /// A count that stands alone on a text line.
    pub(super) fn count_line(&mut self, what: &str, least: Least) -> Result<usize, Fault> {
        self.skip_space();
        let at = self.at;
        let count = self.text(&format!("the number of {what}"))?;
        self.end_of_line()?;
        self.checked(count, at, what, least)
    }

    // ---- numbers of either
    // encoding ---------------------------------------------------------------------------------------------

    /// In a text file: goes to the next line with something on it.
    pub(super) fn start_of_record(&mut self) {
        if !self.is_binary() {
            self.skip_space();
        }
    }

    /// In a text file: the line must end here.
    pub(super) fn end_of_record(&mut self) -> Result<(), Fault> {
        if self.is_binary() { Ok(()) } else { self.end_of_line() }
    }

    fn take<const N: usize>(&mut self, what: &str) -> Result<[u8; N], Fault> {
        match self.rest().first_chunk::<N>() {
            Some(bytes) => {
                self.at += N;
                Ok(*bytes)
            }
            None => Err(self.fault(&DAMAGED, self.at, format!("the file ends inside {what}"), CUT)),
        }
    }

    /// The four bytes that show the byte order of a binary file.
    pub(super) fn byte_order_mark(&mut self) -> Result<[u8; 4], Fault> {
        self.take("the number one that shows the byte order")
    }

    /// A signed number: 4 bytes in a binary file.
    pub(super) fn int(&mut self, what: &str) -> Result<i64, Fault> {
        match self.encoding {
            Encoding::Text => self.text(what),
            Encoding::Binary { big_endian: false, .. } => Ok(i32::from_le_bytes(self.take(what)?).into()),
            Encoding::Binary { big_endian: true, .. } => Ok(i32::from_be_bytes(self.take(what)?).into()),
        }
    }

    /// A number of zero or more that version 2 writes as a signed number.
    pub(super) fn natural(&mut self, what: &str) -> Result<u64, Fault> {
        let at = self.at;
        let value = self.int(what)?;
        u64::try_from(value)
            .map_err(|_| self.fault(&DAMAGED, at, format!("{what} is {value}"), "it can't be negative: the file is damaged here"))
    }

    /// A `size_t`: 8 (or 4) bytes in a binary file.
    pub(super) fn size(&mut self, what: &str) -> Result<u64, Fault> {
        match self.encoding {
            Encoding::Text => self.text(what),
            Encoding::Binary { big_endian: false, size_bytes: 4 } => Ok(u32::from_le_bytes(self.take(what)?).into()),
            Encoding::Binary { big_endian: true, size_bytes: 4 } => Ok(u32::from_be_bytes(self.take(what)?).into()),
            Encoding::Binary { big_endian: false, .. } => Ok(u64::from_le_bytes(self.take(what)?)),
            Encoding::Binary { big_endian: true, .. } => Ok(u64::from_be_bytes(self.take(what)?)),
        }
    }

    /// A floating point number: 8 bytes in a binary file.
    pub(super) fn double(&mut self, what: &str) -> Result<f64, Fault> {
        match self.encoding {
            Encoding::Text => self.text(what),
            Encoding::Binary { big_endian: false, .. } => Ok(f64::from_le_bytes(self.take(what)?)),
            Encoding::Binary { big_endian: true, .. } => Ok(f64::from_be_bytes(self.take(what)?)),
        }
    }

    /// Bytes of a `size_t` in a binary file.
    pub(super) fn size_bytes(&self) -> usize {
        match self.encoding {
            Encoding::Text => 8,
            Encoding::Binary { size_bytes, .. } => size_bytes,
        }
    }

    /// A `size_t` that counts items which follow.
    pub(super) fn count(&mut self, what: &str, least: Least) -> Result<usize, Fault> {
        let at = self.at;
        let count = self.size(&format!("the number of {what}"))?;
        self.checked(count, at, what, least)
    }

    /// `count` if so many items of the least size fit into the bytes that are left; `at` is where it stands.
    pub(super) fn checked(&self, count: u64, at: usize, what: &str, least: Least) -> Result<usize, Fault> {
        let left = self.rest().len();
        // The last number of a text file needs no separator.
        let (each, room) = if self.is_binary() { (least.bytes, left) } else { (2 * least.numbers, left + 1) };
        usize::try_from(count).ok().filter(|n| n.saturating_mul(each) <= room).ok_or_else(|| {
            let message = format!("the file announces {count} {what}, but only {left} bytes follow");
            self.fault(&DAMAGED, at, message, "the count is wrong or the file was cut; export the mesh again")
        })
    }

    // ----
    // sections

    /// The name on a line `$Name`.
    pub(super) fn section_start(&mut self) -> Result<&'a str, Fault> {
        let at = self.at;
        let word = self.rest().split(u8::is_ascii_whitespace).next().unwrap_or_default();
        let name = word.strip_prefix(b"$").filter(|name| !name.is_empty()).and_then(|name| std::str::from_utf8(name).ok());
        let Some(name) = name else {
            let message = format!("expected a section such as $Nodes, found {}", shown(word));
            return Err(self.fault(
                &DAMAGED,
                at,
                message,
                "a count above is too small, or the file is damaged here; export the mesh again",
            ));
        };
        self.at += word.len();
        self.end_of_line()?;
        Ok(name)
    }

    /// Goes past `$EndName`.
    pub(super) fn section_end(&mut self, name: &str) -> Result<(), Fault> {
        self.skip_space();
        let word = self.rest().split(u8::is_ascii_whitespace).next().unwrap_or_default();
        if word.strip_prefix(b"$End") != Some(name.as_bytes()) {
            let found = match word.first() {
                None => "the end of the file".to_string(),
                Some(b'$') => shown(word),
                Some(_) if self.is_binary() => "other bytes".to_string(),
                Some(_) => shown(word),
            };
            let message = format!("expected $End{name}, found {found}");
            return Err(self.fault(
                &DAMAGED,
                self.at,
                message,
                "the section's counts don't agree with what it holds, or the file was cut; export the mesh again",
            ));
        }
        self.at += word.len();
        self.end_of_line()
    }

    /// Goes to the `$EndName` of a section whose contents are not needed.
    pub(super) fn skip_section(&mut self, name: &str, start: usize) -> Result<(), Fault> {
        let mark = format!("$End{name}");
        let mut from = self.at;
        while let Some(step) = self.bytes[from..].iter().position(|b| *b == b'$') {
            from += step;
            let tail = &self.bytes[from..];
            if tail.starts_with(mark.as_bytes()) && tail.get(mark.len()).is_none_or(u8::is_ascii_whitespace) {
                self.at = from;
                return Ok(());
            }
            from += 1;
        }
        Err(self.fault(&DAMAGED, start, format!("section ${name} has no ${}", &mark[1..]), "the file was cut; export the mesh again"))
    }
}

/// A word of the file for a message: in quotes, cut when long, strange bytes made visible.
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 30;
    let cut = String::from_utf8_lossy(&word[..word.len().min(LONGEST)]).into_owned();
    if word.len() > LONGEST { format!("{:?}", cut + "...") } else { format!("{cut:?}") }
}
