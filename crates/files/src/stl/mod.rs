//! Triangulated surfaces of STL files, text or binary: the triangles of an obstacle in 3D, or the mesh of a
//! shell (`sheet.rs`).
//!
//! The bytes of a file become corners in its order, scaled to metres; corners at one place become one point,
//! and whether the triangles make a surface is the solver's to say ([`TriangleSurface`]). A file is binary if
//! its size is that of the triangles that its header reports (also where it begins with `solid`, as some do);
//! else it is text if it begins so. Names, normals, attributes and colours don't count; several solids in one
//! file are one surface.

pub(crate) mod messages;
mod sheet;
mod write;

use crate::gmsh::messages::MESH_FILE;
use crate::plain;
use embate_solver::error::Fault;
use embate_solver::model::{ImportedMesh, TriangleSurface};
use messages::STL;
use std::path::Path;
pub use write::outline;

/// Bytes before the triangles of a binary file, the last four of them their number; and bytes of a triangle.
const HEADER: usize = 84;
const TRIANGLE: usize = 50;
/// What to do about a damaged file.
const AGAIN: &str = "export the surface again, or copy the file again if it was cut on its way";

/// Reads an STL file; see [`parse`]. `source` names it in messages, `scale` is the length of its unit, m.
///
/// # Errors
/// The file can't be read, or what [`parse`] finds.
pub fn read(path: &Path, source: &str, scale: f64) -> Result<TriangleSurface, Fault> {
    parse(&bytes_of(path)?, source, scale)
}

fn bytes_of(path: &Path) -> Result<Vec<u8>, Fault> {
    plain::read(path).map_err(|error| {
        Fault::new(&MESH_FILE, "", format!("the file can't be read: {error}"), "check its path, which starts at the model file's folder")
    })
}

/// Reads an STL file as the mesh of a shell; see [`parse_sheet`].
///
/// # Errors
/// The file can't be read, or what [`parse_sheet`] finds.
pub fn read_sheet(path: &Path, source: &str, scale: f64, tolerance: Option<f64>) -> Result<ImportedMesh, Vec<Fault>> {
    parse_sheet(&bytes_of(path).map_err(|fault| vec![fault])?, source, scale, tolerance)
}

/// Makes the mesh of a shell from the bytes of an STL file: its triangles are the group `all`, the edges that
/// belong to one of them alone the group `rim`. Corners within `tolerance` (m; a millionth of the extent, if
/// it is not given) are one node, and triangles that become points or lines by that are left out.
///
/// # Errors
/// What [`parse`] finds; triangles that are there twice, or look to different sides.
pub fn parse_sheet(bytes: &[u8], source: &str, scale: f64, tolerance: Option<f64>) -> Result<ImportedMesh, Vec<Fault>> {
    let corners = corners(bytes, scale).map_err(|fault| vec![fault])?;
    sheet::mesh(source, &corners, tolerance)
}

/// Makes a surface from the bytes of an STL file; positions are those of the file times `scale`, m.
///
/// # Errors
/// The first fault with its line (text) or byte (binary): a cut file, a word where another one should be, a
/// number of triangles that does not fit the size, no triangles, coordinates that are no finite numbers.
pub fn parse(bytes: &[u8], source: &str, scale: f64) -> Result<TriangleSurface, Fault> {
    Ok(TriangleSurface::welded(source, &corners(bytes, scale)?))
}

/// Corners of the triangles of a file, m.
fn corners(bytes: &[u8], scale: f64) -> Result<Vec<[[f64; 3]; 3]>, Fault> {
    let count = bytes.get(HEADER - 4..HEADER).and_then(|count| count.try_into().ok()).map(|count| u32::from_le_bytes(count) as usize);
    let fits = count.is_some_and(|count| count.checked_mul(TRIANGLE).and_then(|size| size.checked_add(HEADER)) == Some(bytes.len()));
    let triangles = if !fits && is_text(bytes) { Text::new(bytes).triangles() } else { binary(bytes, count, fits) }?;
    if triangles.is_empty() {
        return Err(fault("", "the file holds no triangles", "export the surface as triangles; drawings of lines alone have none"));
    }
    Ok(triangles.iter().map(|triangle| triangle.map(|x| x.map(|c| c * scale))).collect())
}

fn fault(place: impl Into<String>, message: impl Into<String>, help: &str) -> Fault {
    Fault::new(&STL, place, message.into(), help)
}

/// Whether a file begins as one of text does, and has no byte that a text has not.
fn is_text(bytes: &[u8]) -> bool {
    let begin = bytes.trim_ascii_start();
    begin.get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid")) && !begin.iter().take(1000).any(|&byte| byte == 0)
}

fn binary(bytes: &[u8], count: Option<usize>, fits: bool) -> Result<Vec<[[f64; 3]; 3]>, Fault> {
    let Some(count) = count else {
        let message = format!(
            "the file has {} bytes, but the header of a binary STL file alone has {HEADER}, and one of text begins with `solid`",
            bytes.len()
        );
        return Err(fault("", message, AGAIN));
    };
    let (room, rest) = ((bytes.len() - HEADER) / TRIANGLE, (bytes.len() - HEADER) % TRIANGLE);
    if !fits {
        let partly = if rest > 0 { format!(" and {rest} bytes of another one") } else { String::new() };
        let message = format!("its header announces {count} triangles, but the file holds {room}{partly}");
        return Err(fault(
            "byte 80",
            message,
            if count > room { AGAIN } else { "export the surface again: the number or the size is wrong" },
        ));
    }
    let number = |at: usize| {
        bytes.get(at..at + 4).and_then(|four| four.try_into().ok()).map_or(f64::NAN, |four| f64::from(f32::from_le_bytes(four)))
    };
    let mut triangles = Vec::with_capacity(count);
    for triangle in 0..count {
        // The normal comes first.
        let at = HEADER + TRIANGLE * triangle + 12;
        let corners: [[f64; 3]; 3] = std::array::from_fn(|corner| std::array::from_fn(|d| number(at + 12 * corner + 4 * d)));
        if let Some(corner) = corners.iter().position(|x| !x.iter().all(|c| c.is_finite())) {
            let message = format!("corner {} of triangle {} has the coordinates {:?}", corner + 1, triangle + 1, corners[corner]);
            return Err(fault(format!("byte {}", at + 12 * corner), message, "all must be finite numbers; export the surface again"));
        }
        triangles.push(corners);
    }
    Ok(triangles)
}

/// Words with their lines.
type Words<'a> = Box<dyn Iterator<Item = (usize, &'a [u8])> + 'a>;

/// The words of a text with their lines.
struct Text<'a> {
    words: std::iter::Peekable<Words<'a>>,
    /// Line of the last word, from 1.
    line: usize,
}

impl<'a> Text<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        let of_line = |(line, text): (usize, &'a [u8])| {
            let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
            // Names may hold anything.
            let named =
                words.clone().next().is_some_and(|word| [&b"solid"[..], b"endsolid"].iter().any(|it| word.eq_ignore_ascii_case(it)));
            let most = if named { 1 } else { usize::MAX };
            std::iter::from_fn(move || words.next()).take(most).map(move |word| (line, word))
        };
        let words: Words<'a> = Box::new((1..).zip(bytes.split(|&byte| byte == b'\n')).flat_map(of_line));
        Self { words: words.peekable(), line: 1 }
    }

    /// The next word; `wanted` says what should stand there.
    fn word(&mut self, wanted: &str) -> Result<&'a [u8], Fault> {
        let Some((line, word)) = self.words.next() else {
            let message = format!("the file ends where {wanted} should follow");
            return Err(fault(format!("line {}", self.line), message, AGAIN));
        };
        self.line = line;
        Ok(word)
    }

    fn expect(&mut self, keyword: &str) -> Result<(), Fault> {
        let word = self.word(&format!("`{keyword}`"))?;
        if word.eq_ignore_ascii_case(keyword.as_bytes()) { Ok(()) } else { Err(self.wrong(word, &format!("`{keyword}`"))) }
    }

    fn wrong(&self, word: &[u8], wanted: &str) -> Fault {
        let shown: String = String::from_utf8_lossy(word).chars().take(30).collect();
        fault(
            format!("line {}", self.line),
            format!("here stands `{shown}`, but {wanted} should"),
            "export the surface again, or correct the line",
        )
    }

    fn number(&mut self, is_position: bool) -> Result<f64, Fault> {
        let word = self.word("a number")?;
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse::<f64>().ok());
        match number {
            // Of triangles without an area some programs write normals that are none.
            Some(number) if number.is_finite() || !is_position => Ok(number),
            _ => Err(self.wrong(word, "a finite number")),
        }
    }

    fn triangles(mut self) -> Result<Vec<[[f64; 3]; 3]>, Fault> {
        let mut triangles = Vec::new();
        while self.words.peek().is_some() {
            self.expect("solid")?;
            loop {
                let word = self.word("`facet` or `endsolid`")?;
                if word.eq_ignore_ascii_case(b"endsolid") {
                    break;
                }
                if !word.eq_ignore_ascii_case(b"facet") {
                    return Err(self.wrong(word, "`facet` or `endsolid`"));
                }
                triangles.push(self.facet()?);
            }
        }
        Ok(triangles)
    }

    /// What follows the word `facet`.
    fn facet(&mut self) -> Result<[[f64; 3]; 3], Fault> {
        self.expect("normal")?;
        for _ in 0..3 {
            self.number(false)?;
        }
        self.expect("outer")?;
        self.expect("loop")?;
        let mut corners = [[0.0; 3]; 3];
        for corner in &mut corners {
            self.expect("vertex")?;
            for component in corner {
                *component = self.number(true)?;
            }
        }
        self.expect("endloop")?;
        self.expect("endfacet")?;
        Ok(corners)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLES: [[[f32; 3]; 3]; 4] = [
        [[0.0, 0.0, 0.0], [0.0, 1.5, 0.0], [1.0, 0.0, 0.0]],
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, -2e1]],
        [[1.0, 0.0, 0.0], [0.0, 1.5, 0.0], [0.0, 0.0, -2e1]],
        [[0.0, 1.5, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, -2e1]],
    ];

    fn text() -> String {
        let facet = |triangle: &[[f32; 3]; 3]| {
            let vertex = |x: &[f32; 3]| format!("   vertex {:e} {} {:?}\n", x[0], x[1], x[2]);
            format!("  facet normal nan 0 0\r\n  OUTER LOOP\n{}  endloop\n  endfacet\n", triangle.iter().map(vertex).collect::<String>())
        };
        format!("solid a facet of my die\n{}endsolid a facet\n", TRIANGLES.iter().map(facet).collect::<String>())
    }

    fn bytes(header: &[u8]) -> Vec<u8> {
        let mut bytes = vec![0; 80];
        bytes[..header.len()].copy_from_slice(header);
        bytes.extend(4_u32.to_le_bytes());
        for triangle in TRIANGLES {
            let numbers = [0.0; 3].into_iter().chain(triangle.into_iter().flatten());
            bytes.extend(numbers.flat_map(f32::to_le_bytes).chain([1, 2]));
        }
        bytes
    }

    fn reported(bytes: &[u8]) -> String {
        let Fault { kind, path, message, .. } = parse(bytes, "a.stl", 1.0).unwrap_err();
        format!("{} {path}: {message}", kind.code)
    }

    #[test]
    fn text_and_binary_files_are_the_same_surface() {
        let surface = parse(text().as_bytes(), "a.stl", 1e-3).unwrap();
        assert_eq!((surface.positions.len(), surface.triangles.len()), (4, 4));
        assert_eq!(surface.positions[1], [0.0, 1.5e-3, 0.0]);
        for header in [&b"made by hand"[..], b"solid but binary"] {
            assert_eq!(parse(&bytes(header), "a.stl", 1e-3).unwrap(), surface);
        }
        // Several solids are one surface.
        let twice = text() + &text().replace("vertex 0e0", "vertex 7").to_uppercase();
        assert_eq!(parse(twice.as_bytes(), "a.stl", 1.0).unwrap().triangles.len(), 8);
    }

    #[test]
    fn a_cut_text_is_reported_with_its_line() {
        let text = text();
        for cut in [0, 30, 80, 200, 300] {
            let cut = text.len() - 10 - cut;
            let reported = reported(&text.as_bytes()[..cut]);
            assert!(reported.starts_with("E0240 line "), "{reported}");
        }
        assert_eq!(
            reported(b"solid one\n facet normal 0 0 1\n outer loop\n vertex 0 0\n"),
            "E0240 line 4: the file ends where a number should follow"
        );
        assert_eq!(reported(b"solid one\n"), "E0240 line 1: the file ends where `facet` or `endsolid` should follow");
        assert_eq!(reported(b"solid one\nendsolid\n"), "E0240 : the file holds no triangles");
    }

    #[test]
    fn words_and_numbers_that_are_none_are_reported() {
        let text = text();
        let reported_of = |from: &str, to: &str| reported(text.replacen(from, to, 1).as_bytes());
        assert_eq!(reported_of("vertex 0e0", "vertex NaN"), "E0240 line 4: here stands `NaN`, but a finite number should");
        assert_eq!(reported_of("vertex 0e0", "vertex zero"), "E0240 line 4: here stands `zero`, but a finite number should");
        assert_eq!(reported_of("endloop", "vertex"), "E0240 line 7: here stands `vertex`, but `endloop` should");
        assert_eq!(reported_of("facet normal", "face normal"), "E0240 line 2: here stands `face`, but `facet` or `endsolid` should");
    }

    #[test]
    fn binary_files_of_wrong_size_or_with_wrong_numbers_are_reported() {
        let good = bytes(b"");
        assert_eq!(
            reported(&good[..good.len() - 7]),
            "E0240 byte 80: its header announces 4 triangles, but the file holds 3 and 43 bytes of another one"
        );
        assert_eq!(reported(&[&good[..], &[0; 50]].concat()), "E0240 byte 80: its header announces 4 triangles, but the file holds 5");
        assert!(reported(&good[..60]).starts_with("E0240 : the file has 60 bytes"));
        let mut other = good.clone();
        other[84 + 50 + 24..][..4].copy_from_slice(&f32::NAN.to_le_bytes());
        assert_eq!(reported(&other), "E0240 byte 158: corner 2 of triangle 2 has the coordinates [NaN, 0.0, 0.0]");
        other[80..84].copy_from_slice(&0_u32.to_le_bytes());
        assert_eq!(reported(&other[..84]), "E0240 : the file holds no triangles");
        // So many that their size is none.
        other[80..84].copy_from_slice(&u32::MAX.to_le_bytes());
        assert!(reported(&other).contains("4294967295 triangles"));
    }
}
