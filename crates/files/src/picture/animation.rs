//! The moving picture: one palette for the film, made from the colour map, and per frame only the rectangle
//! that changed. Canvases come from `film`, some at once; what changed is packed frame by frame, each on its
//! own; bytes go to `animation.gif`.

pub(super) use super::palette::{Indices, Palette};

use super::PictureError;
use super::palette::UNKNOWN;
use super::raster::Canvas;
use crate::threads::{ScratchPool, Threads};
use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};
use std::io::Write;
use std::path::Path;

/// A GIF that is being written.
pub(super) struct Animation<'a> {
    encoder: Encoder<&'a mut dyn Write>,
    width: usize,
    height: usize,
    /// The frame before; empty before the first.
    before: Indices,
    path: &'a Path,
}

impl<'a> Animation<'a> {
    /// Writes the head of the file; `canvas` gives the size.
    pub(super) fn start(out: &'a mut dyn Write, canvas: &Canvas, palette: &Palette, path: &'a Path) -> Result<Self, PictureError> {
        let (width, height) = (canvas.width, canvas.height);
        let mut encoder = Encoder::new(out, width as u16, height as u16, &palette.bytes()).map_err(|e| refused(path, e))?;
        encoder.set_repeat(Repeat::Infinite).map_err(|e| refused(path, e))?;
        Ok(Self { encoder, width, height, before: Vec::new(), path })
    }

    /// Adds frames that follow each other, each with the hundredths of a second for which it stays.
    pub(super) fn frames(&mut self, pictures: Vec<Indices>, delays: &[u16], threads: &Threads) -> Result<(), PictureError> {
        let all: Vec<Indices> = std::iter::once(std::mem::take(&mut self.before)).chain(pictures).collect();
        let pieces: Vec<_> = all.windows(2).zip(delays).collect();
        let size = [self.width, self.height];
        let packed = threads.map(&pieces, &ScratchPool::default(), || (), |(), (pair, delay)| packed(size, &pair[0], &pair[1], **delay));
        for frame in packed {
            self.encoder.write_lzw_pre_encoded_frame(&frame).map_err(|e| refused(self.path, e))?;
        }
        self.before = all.into_iter().next_back().unwrap_or_default();
        Ok(())
    }
}

/// What changed from the frame before, ready to be written.
fn packed([width, height]: [usize; 2], before: &[u8], now: &[u8], delay: u16) -> Frame<'static> {
    let [left, top, right, bottom] = changed([width, height], before, now);
    let mut buffer = Vec::with_capacity((right - left) * (bottom - top));
    for row in top..bottom {
        let line = row * width + left..row * width + right;
        match before.get(line.clone()) {
            None => buffer.extend_from_slice(&now[line]),
            Some(before) => buffer.extend(now[line].iter().zip(before).map(|(n, b)| if n == b { UNKNOWN } else { *n })),
        }
    }
    let mut frame = Frame {
        delay,
        dispose: DisposalMethod::Keep,
        transparent: Some(UNKNOWN),
        left: left as u16,
        top: top as u16,
        width: (right - left) as u16,
        height: (bottom - top) as u16,
        buffer: buffer.into(),
        ..Frame::default()
    };
    frame.make_lzw_pre_encoded();
    frame
}

/// The rectangle outside which nothing changed; never empty, because a frame needs a pixel.
fn changed([width, height]: [usize; 2], before: &[u8], now: &[u8]) -> [usize; 4] {
    if before.is_empty() {
        return [0, 0, width, height];
    }
    let [mut left, mut top, mut right, mut bottom] = [width, height, 0, 0];
    for (row, (a, b)) in now.chunks_exact(width).zip(before.chunks_exact(width)).enumerate() {
        if a == b {
            continue;
        }
        let differ = |k: &usize| a[*k] != b[*k];
        left = (0..left).find(differ).unwrap_or(left);
        right = (right..width).rev().find(differ).map_or(right, |k| k + 1);
        (top, bottom) = (top.min(row), row + 1);
    }
    if bottom == 0 { [0, 0, 1, 1] } else { [left.min(right - 1), top, right, bottom] }
}

fn refused(path: &Path, error: EncodingError) -> PictureError {
    match error {
        EncodingError::Io(source) => PictureError::Io { path: path.to_path_buf(), source },
        other => PictureError::Encode { path: path.to_path_buf(), reason: other.to_string() },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::picture::colour::MAP;

    #[test]
    fn only_what_changed_is_written_and_reading_gives_it_back() {
        let mut canvas = Canvas::new(40, 30);
        let mut out = Vec::new();
        {
            let sink: &mut dyn Write = &mut out;
            let mut palette = Palette::new(&[]);
            let mut animation = Animation::start(sink, &canvas, &palette, Path::new("x.gif")).unwrap();
            let empty = palette.indices(&canvas, None);
            animation.frames(vec![empty.clone(), empty], &[5, 5], &Threads::new(2)).unwrap();
            canvas.rectangle(10.0, 12.0, 20.0, 15.0, MAP[100], 1.0);
            animation.frames(vec![palette.indices(&canvas, None)], &[150], &Threads::one()).unwrap();
        }
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::Indexed);
        let mut decoder = options.read_info(&out[..]).unwrap();
        let mut frames = Vec::new();
        while let Some(frame) = decoder.read_next_frame().unwrap() {
            frames.push((frame.left, frame.top, frame.width, frame.height, frame.delay));
        }
        assert_eq!(frames, [(0, 0, 40, 30, 5), (0, 0, 1, 1, 5), (10, 12, 10, 3, 150)]);
    }

    #[test]
    fn a_reader_who_lays_frame_over_frame_sees_each_picture_whole() {
        let mut canvas = Canvas::new(97, 61);
        let mut palette = Palette::new(&[]);
        let mut state = 7_u64;
        let mut random = |below: usize| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as usize % below) as f32
        };
        // Boxes come and go, some pictures stay as they were, one is white again.
        let mut pictures = Vec::new();
        for number in 0..30 {
            match number {
                9 => canvas = Canvas::new(97, 61),
                4 | 20 => {}
                _ => {
                    let ([x, y], [wide, high]) = ([random(100) - 5.0, random(60) - 5.0], [random(60), random(40)]);
                    canvas.rectangle(x, y, x + wide, y + high, MAP[random(256) as usize], 1.0);
                }
            }
            pictures.push(palette.indices(&canvas, None));
        }
        let mut out = Vec::new();
        {
            let sink: &mut dyn Write = &mut out;
            let mut animation = Animation::start(sink, &canvas, &palette, Path::new("x.gif")).unwrap();
            let (first, rest) = pictures.split_at(11);
            animation.frames(first.to_vec(), &[5; 11], &Threads::new(2)).unwrap();
            animation.frames(rest.to_vec(), &[5; 19], &Threads::one()).unwrap();
        }
        let mut options = gif::DecodeOptions::new();
        options.set_color_output(gif::ColorOutput::Indexed);
        let mut decoder = options.read_info(&out[..]).unwrap();
        let mut seen = vec![UNKNOWN; 97 * 61];
        let mut written = 0;
        for picture in &pictures {
            let frame = decoder.read_next_frame().unwrap().unwrap();
            assert_eq!(frame.dispose, DisposalMethod::Keep);
            written += frame.buffer.len();
            for (row, pixels) in frame.buffer.chunks_exact(usize::from(frame.width)).enumerate() {
                let start = (usize::from(frame.top) + row) * 97 + usize::from(frame.left);
                for (place, pixel) in seen[start..].iter_mut().zip(pixels).filter(|(_, pixel)| Some(**pixel) != frame.transparent) {
                    *place = *pixel;
                }
            }
            assert!(seen == *picture);
        }
        assert!(decoder.read_next_frame().unwrap().is_none());
        assert!(written < 97 * 61 * 20, "only what changed: {written} pixels");
    }
}
