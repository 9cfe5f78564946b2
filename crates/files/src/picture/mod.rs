//! Pictures of a run, as an engineer would show them: the moving field, the last state, the mesh, the
//! history.
//!
//! Data comes from [`embate_solver::output`] (cells once, frames, history rows) and leaves as
//! `animation.gif`, `final.png`, a mesh picture and two SVG plots. The way of a picture: `film` or `mesh`
//! choose what to show, `view` how much of it, `scale` its units and ticks, `sheet` writes title and colour
//! bar, `scene` lays out axes, `obstacle` and `body` hand lines, cells and edges to `raster`, `text` writes,
//! `animation` encodes; models in 3D are drawn by `space`. `plots` chooses curves, `svg` draws them.

mod animation;
mod body;
pub(crate) mod colour;
pub(crate) mod field;
mod film;
mod glyphs;
mod mesh;
pub(crate) mod neighbourhood;
mod obstacle;
mod palette;
pub(crate) mod place;
mod plots;

mod raster;
pub(crate) mod scale;
mod scene;
mod sheet;
pub(crate) mod space;
pub(crate) mod svg;
pub(crate) mod sweep;

mod text;
mod view;

pub use film::{Film, FilmSettings};
pub use mesh::{mesh_png, model_png};
pub(crate) use plots::charts;
pub use plots::plots;
pub(crate) use space::base64;

use crate::plain;
use crate::results::messages::{PICTURE, REFUSED};
use crate::results::write_whole_by;
use embate_solver::message::Message;
use raster::Canvas;
use std::fs;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use thiserror::Error;

/// Why a picture was not written.
#[derive(Debug, Error)]
pub enum PictureError {
    /// The disk refused.
    #[error("can't write {}: {source}{}", path.display(), remedy(source))]
    Io {
        #[doc = "File."]
        path: PathBuf,
        #[doc = "What the system said."]
        source: std::io::Error,
    },
    /// The encoder refused.
    #[error("{}: the picture can't be encoded: {reason}", path.display())]
    Encode {
        #[doc = "File."]
        path: PathBuf,
        #[doc = "What the encoder said."]
        reason: String,
    },
    /// The wanted field is not in the frames.
    #[error("the field \"{name}\" can't be shown; the frames hold {available}; choose one of these, or leave the field empty")]
    Field {
        #[doc = "Name that was asked for."]
        name: String,
        #[doc = "Names that would do."]
        available: String,
    },
    /// A film without a frame.
    #[error("the film has no frame; add at least one before it is finished")]
    Empty,
}

impl PictureError {
    /// Its kind.
    #[must_use]
    pub fn kind(&self) -> &'static Message {
        match self {
            Self::Io { source, .. } => plain::kind(source),
            Self::Encode { .. } | Self::Field { .. } | Self::Empty => &PICTURE,
        }
    }
}

/// What a person can do; what is no plain file says it itself.
fn remedy(error: &std::io::Error) -> &'static str {
    if plain::kind(error).code == REFUSED.code { "; check that the folder exists, is writable and has space left" } else { "" }
}

/// Writes `NAME.part` next to `path`, then renames it: a file under its final name is always whole.
fn write_whole(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<(), PictureError>) -> Result<(), PictureError> {
    let io = |source| PictureError::Io { path: path.to_path_buf(), source };
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(io)?;
    }
    let written = write_whole_by(path, |file| -> Result<_, Unwritten> {
        let mut writer = BufWriter::new(file);
        write(&mut writer).map_err(Unwritten::Picture)?;
        Ok(writer.into_inner().map_err(std::io::IntoInnerError::into_error)?)
    });
    written.map_err(|error| match error {
        Unwritten::Io(source) => io(source),
        Unwritten::Picture(error) => error,
    })
}

/// Why a file was not written: the system's words have no path yet.
enum Unwritten {
    Io(std::io::Error),
    Picture(PictureError),
}

impl From<std::io::Error> for Unwritten {
    fn from(source: std::io::Error) -> Self {
        Self::Io(source)
    }
}

/// Writes `canvas` as an RGB PNG.
fn write_png(canvas: &Canvas, path: &Path) -> Result<(), PictureError> {
    let encode = |error: png::EncodingError| match error {
        png::EncodingError::IoError(source) => PictureError::Io { path: path.to_path_buf(), source },
        other => PictureError::Encode { path: path.to_path_buf(), reason: other.to_string() },
    };
    write_whole(path, |out| {
        let mut encoder = png::Encoder::new(out, canvas.width as u32, canvas.height as u32);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Fast);
        let mut writer = encoder.write_header().map_err(encode)?;
        writer.write_image_data(canvas.pixels.as_flattened()).map_err(encode)?;
        writer.finish().map_err(encode)
    })
}
