//! The text of an Abaqus or CalculiX deck: files and what they include become blocks, one for each keyword
//! with its parameters and data lines.
//!
//! Every later message takes its place (file, line) from here. Keywords and names of parameters are in
//! capitals with single spaces; values keep their spelling, because names are compared without case but shown
//! as written.

use crate::abaqus::messages::{DECK, SYNTAX};
use crate::path_policy::Bounds;
use embate_solver::error::Fault;
use embate_solver::message::Message;
use std::path::{Path, PathBuf};

/// How deep files may include each other.
const DEPTH_MAX: usize = 16;
/// Most files and most bytes in all.
const FILES_MAX: usize = 1000;
const BYTES_MAX: usize = 1 << 30;
/// Longest keyword line with its continuations, bytes.
const KEYWORD_MAX: usize = 64 << 10;

/// A line of one of the files: number of the file, number of the line from 1, bytes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line {
    source: u32,
    /// From 1.
    pub(super) number: u32,
    start: usize,
    end: usize,
}

/// A keyword with its parameters and data lines.
#[derive(Clone, Debug)]
pub(super) struct Block {
    /// In capitals, without the star.
    pub(super) keyword: String,
    /// Names in capitals, values as written (empty: none).
    pub(super) parameters: Vec<(String, String)>,
    pub(super) line: Line,
    pub(super) data: Vec<Line>,
}

impl Block {
    /// The value of a parameter; empty when it stands without one.
    pub(super) fn parameter(&self, name: &str) -> Option<&str> {
        self.parameters.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
    }

    pub(super) fn has(&self, name: &str) -> bool {
        self.parameter(name).is_some()
    }

    /// Whether a parameter has this value, whatever the case.
    pub(super) fn is(&self, name: &str, value: &str) -> bool {
        self.parameter(name).is_some_and(|it| folded(it) == value)
    }
}

/// A name as it is compared: in capitals, with single spaces.
pub(super) fn folded(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join(" ").to_uppercase()
}

#[derive(Debug)]
struct Source {
    name: String,
    text: String,
}

/// The files of a deck, cut into blocks.
#[derive(Debug, Default)]
pub(super) struct Text {
    sources: Vec<Source>,
    pub(super) blocks: Vec<Block>,
    bytes: usize,
    /// The lines of all files in the order in which they are read, include lines left out.
    lines: Vec<Line>,
}

impl Text {
    /// Reads a file and what it includes.
    pub(super) fn read(path: &Path, shown: &str, bounds: &Bounds) -> Result<Self, Fault> {
        let bytes = read(path).map_err(|error| {
            Fault::new(&DECK, shown, format!("the file can't be read: {error}"), "check its path, which starts at the model file's folder")
        })?;
        Self::parse(&bytes, shown, path.parent().unwrap_or(Path::new("")), bounds)
    }

    /// Cuts the bytes of a file; what it includes is looked for in `folder`.
    pub(super) fn parse(bytes: &[u8], shown: &str, folder: &Path, bounds: &Bounds) -> Result<Self, Fault> {
        let mut text = Self::default();
        text.add(bytes, shown.to_string(), (folder, bounds), 0)?;
        Ok(text)
    }

    fn add(&mut self, bytes: &[u8], name: String, place: (&Path, &Bounds), depth: usize) -> Result<(), Fault> {
        if bytes.starts_with(b"HDF") || bytes.iter().take(4096).any(|b| *b == 0) {
            return Err(Fault::new(&DECK, name, "this is not a text", "an input deck (.inp) is a text of keywords that begin with a star"));
        }
        self.bytes += bytes.len();
        if self.sources.len() >= FILES_MAX || self.bytes > BYTES_MAX {
            let message = format!("the deck has more than {FILES_MAX} files or {} MiB", BYTES_MAX >> 20);
            return Err(Fault::new(&DECK, name, message, "look whether a file includes itself"));
        }
        let source = self.sources.len() as u32;
        // Comments in older encodings are no reason to stop.
        let text = String::from_utf8_lossy(bytes).into_owned();
        let mut lines = Vec::new();
        let (mut start, mut number) = (0, 0);
        while start < text.len() {
            let end = text[start..].find('\n').map_or(text.len(), |at| start + at);
            number += 1;
            lines.push(Line { source, number, start, end: end - usize::from(text[start..end].ends_with('\r')) });
            start = end + 1;
        }
        self.sources.push(Source { name, text });
        let mut lines = lines.into_iter();
        while let Some(line) = lines.next() {
            let first = self.lines.len();
            self.lines.push(line);
            let words = self.line(line).trim();
            if words.is_empty() || words.starts_with("**") {
                continue;
            }
            if !words.starts_with('*') {
                self.data(line)?;
                continue;
            }
            let mut whole = words.to_string();
            while whole.trim_end().ends_with(',') && whole.len() < KEYWORD_MAX {
                let Some(next) = lines.next() else { break };
                self.lines.push(next);
                whole.push_str(self.line(next).trim());
            }
            let block = self.keyword(&whole, line)?;
            if block.keyword == "INCLUDE" {
                self.lines.truncate(first);
                self.include(&block, place, depth)?;
            } else {
                self.blocks.push(block);
            }
        }
        Ok(())
    }

    fn data(&mut self, line: Line) -> Result<(), Fault> {
        let Some(block) = self.blocks.last_mut() else {
            let help = "the first line of a deck is a keyword such as *NODE; is it the right file?";
            return Err(self.fault(&SYNTAX, line, "this is not an Abaqus or CalculiX deck", help));
        };
        block.data.push(line);
        Ok(())
    }

    fn keyword(&self, whole: &str, line: Line) -> Result<Block, Fault> {
        let mut words = split(whole.strip_prefix('*').unwrap_or(whole)).into_iter();
        let keyword = folded(words.next().unwrap_or_default());
        if keyword.is_empty() {
            return Err(self.fault(&SYNTAX, line, "a keyword line without a keyword", "a comment begins with two stars"));
        }
        let mut parameters = Vec::new();
        for word in words.map(str::trim).filter(|word| !word.is_empty()) {
            let (name, value) = word.split_once('=').unwrap_or((word, ""));
            parameters.push((folded(name), unquoted(value).to_string()));
        }
        Ok(Block { keyword, parameters, line, data: Vec::new() })
    }

    fn include(&mut self, block: &Block, (folder, bounds): (&Path, &Bounds), depth: usize) -> Result<(), Fault> {
        let Some(file) = block.parameter("INPUT").filter(|file| !file.is_empty()) else {
            return Err(self.fault(&SYNTAX, block.line, "*INCLUDE names no file", "write *INCLUDE, INPUT=file.inp"));
        };
        if depth + 1 >= DEPTH_MAX {
            let message = format!("files include each other more than {DEPTH_MAX} deep");
            return Err(self.fault(&DECK, block.line, message, "look whether a file includes itself"));
        }
        let path: PathBuf = folder.join(file);
        bounds.hold(&path, &shown(file)).map_err(|(kind, message, help)| self.fault(kind, block.line, message, help))?;
        let bytes = read(&path).map_err(|error| {
            let message = format!("the file {} can't be read: {error}", shown(file));
            self.fault(&DECK, block.line, message, "paths begin at the folder of the file that includes")
        })?;
        let inner = path.parent().unwrap_or(folder).to_path_buf();
        self.add(&bytes, file.to_string(), (&inner, bounds), depth + 1)
    }

    /// The text of a line.
    pub(super) fn line(&self, line: Line) -> &str {
        &self.sources[line.source as usize].text[line.start..line.end]
    }

    /// The fields of a data line, without the empty one after a last comma.
    pub(super) fn fields(&self, line: Line) -> Vec<&str> {
        let mut fields: Vec<&str> = split(self.line(line)).into_iter().map(unquoted).collect();
        if fields.len() > 1 && fields.last().is_some_and(|field| field.is_empty()) {
            fields.pop();
        }
        fields
    }

    /// Whether a data line continues in the next one.
    pub(super) fn continues(&self, line: Line) -> bool {
        self.line(line).trim_end().ends_with(',')
    }

    /// Where a line stands.
    pub(super) fn place(&self, line: Line) -> String {
        format!("{}, line {}", self.sources[line.source as usize].name, line.number)
    }

    pub(super) fn fault(&self, kind: &'static Message, line: Line, message: impl Into<String>, help: impl Into<String>) -> Fault {
        Fault::new(kind, self.place(line), message, help)
    }

    /// A number; Fortran's exponent letter D is read too.
    pub(super) fn number(&self, line: Line, field: &str, what: &str) -> Result<f64, Fault> {
        let plain = field.replace(['d', 'D'], "e");
        match plain.parse::<f64>() {
            Ok(value) if value.is_finite() && !field.is_empty() => Ok(value),
            _ if field.is_empty() => Err(self.fault(&SYNTAX, line, format!("{what} is missing"), "give a number")),
            _ => Err(self.fault(&SYNTAX, line, format!("{what} is {}, not a number", shown(field)), "write numbers with a decimal point")),
        }
    }

    /// A number of a node or element.
    pub(super) fn tag(&self, line: Line, field: &str, what: &str) -> Result<u64, Fault> {
        let whole = field.parse::<u64>().ok();
        whole.filter(|tag| *tag > 0).ok_or_else(|| {
            let message = if field.is_empty() { format!("{what} is missing") } else { format!("{what} is {}", shown(field)) };
            self.fault(&SYNTAX, line, message, "numbers of nodes and elements are whole and greater than 0")
        })
    }

    /// The whole deck in one text, with the included files in the places of their include lines.
    pub(super) fn whole(&self) -> String {
        self.lines.iter().flat_map(|line| [self.line(*line), "\n"]).collect()
    }

    /// Whether it stands in more than one file.
    pub(super) fn shown_name(&self) -> &str {
        self.sources.first().map_or("", |source| &source.name)
    }
}

/// The bytes of a file; what is none, a pipe for one, would be waited for.
fn read(path: &Path) -> std::io::Result<Vec<u8>> {
    if std::fs::metadata(path)?.is_file() { std::fs::read(path) } else { Err(std::io::Error::other("it is no file")) }
}

/// Cuts at commas that are not in quotes; the pieces are trimmed.
fn split(line: &str) -> Vec<&str> {
    let mut quoted = false;
    line.split(|c| {
        quoted ^= c == '"';
        c == ',' && !quoted
    })
    .map(str::trim)
    .collect()
}

fn unquoted(field: &str) -> &str {
    let field = field.trim();
    field.strip_prefix('"').and_then(|field| field.strip_suffix('"')).unwrap_or(field)
}

/// A word of the file for a message: in quotes, cut when long.
pub(super) fn shown(word: &str) -> String {
    const LONGEST: usize = 40;
    if word.chars().count() > LONGEST {
        format!("{:?}", word.chars().take(LONGEST).collect::<String>() + "...")
    } else {
        format!("{word:?}")
    }
}
