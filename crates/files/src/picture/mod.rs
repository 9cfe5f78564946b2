//! Pictures of a run, as an engineer would show them: the moving field, the last state, the mesh, the history.
//!
//! Data comes from [`embate_solver::output`] (cells once, frames, history rows) and leaves as `animation.gif`, `final.png`, a mesh
//! picture and two SVG plots. The way of a picture: `film` or `mesh` choose what to show, `view` how much of it, `scale` its units and ticks, `sheet` writes title
//! and colour bar, `scene` lays out axes, `obstacle` and `body` hand lines, cells and edges to `raster`, `text` writes, `animation` and `lzw` encode; models of space
//! are drawn by `space`. `plots` chooses curves, `svg` draws them.

mod animation;
mod body;
pub(crate) mod colour;
pub(crate) mod field;
mod film;
mod lzw;
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
pub use mesh::mesh_png;
pub(crate) use plots::charts;
pub use plots::plots;
pub(crate) use space::base64;

use crate::results::messages::{PICTURE, REFUSED};
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
    #[error("{}: {source}; check that the folder exists, is writable and has space left", path.display())]
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
            Self::Io { .. } => &REFUSED,
            Self::Encode { .. } | Self::Field { .. } | Self::Empty => &PICTURE,
        }
    }
}

/// Writes `NAME.part` next to `path`, then renames it: a file under its final name is always whole.
fn write_whole(path: &Path, write: impl FnOnce(&mut dyn Write) -> Result<(), PictureError>) -> Result<(), PictureError> {
    let io = |source| PictureError::Io { path: path.to_path_buf(), source };
    if let Some(folder) = path.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder).map_err(io)?;
    }
    let mut part = path.as_os_str().to_owned();
    part.push(".part");
    let part = PathBuf::from(part);
    let written = (|| {
        let mut writer = BufWriter::new(fs::File::create(&part).map_err(io)?);
        write(&mut writer)?;
        writer.flush().map_err(io)?;
        drop(writer);
        fs::rename(&part, path).map_err(io)
    })();
    if written.is_err() {
        // The first error is the one to tell; a leftover that can't be removed either adds nothing.
        let _ = fs::remove_file(&part);
    }
    written
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
