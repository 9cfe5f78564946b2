//! What a page wants to see of a frame, and how addresses and messages write it.

/// A number by its bits, so that requests can be compared and sorted.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Number(u64);

impl Number {
    fn new(value: f64) -> Self {
        Self(value.to_bits())
    }

    fn value(self) -> f64 {
        f64::from_bits(self.0)
    }
}

/// A plane: the points x with normal · x = offset, as the bodies are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Plane {
    normal: [Number; 3],
    offset: Number,
}

impl Plane {
    /// A plane; the normal is made a unit vector. None where there is no direction.
    #[must_use]
    pub fn new(normal: [f64; 3], offset: f64) -> Option<Self> {
        let length = normal.iter().map(|n| n * n).sum::<f64>().sqrt();
        let is_sound = length.is_normal() && offset.is_finite();
        is_sound.then(|| Self { normal: normal.map(|n| Number::new(n / length)), offset: Number::new(offset) })
    }

    /// Unit normal.
    #[must_use]
    pub fn normal(&self) -> [f64; 3] {
        self.normal.map(Number::value)
    }

    /// Distance from the origin along the normal, m.
    #[must_use]
    pub fn offset(&self) -> f64 {
        self.offset.value()
    }
}

/// Planes that cut the bodies, with the factor of the displacements with which these are shown.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct SectionRequest {
    /// Each mirror image of the bodies may be cut by another plane.
    pub planes: Vec<Plane>,
    scale: Number,
}

/// Mirror images of a model across three planes.
const IMAGES: usize = 8;

impl SectionRequest {
    /// Planes as `nx,ny,nz,offset`, several with `;` between them, and the factor of the displacements.
    ///
    /// # Errors
    /// What can't be read, and what is expected.
    pub fn read(text: &str, scale: f64) -> Result<Self, String> {
        let plane = |text: &str| {
            let numbers: Vec<f64> = text.split(',').filter_map(|number| number.trim().parse().ok()).collect();
            let [x, y, z, offset] = numbers[..] else { return None };
            Plane::new([x, y, z], offset).filter(|_| text.split(',').count() == 4)
        };
        let planes: Option<Vec<Plane>> = text.split(';').map(plane).collect();
        let planes = planes.filter(|planes| planes.len() <= IMAGES);
        let planes =
            planes.ok_or_else(|| format!("section={text} is no plane: give nx,ny,nz,offset (m), at most {IMAGES} with ; between them"))?;
        if !scale.is_finite() {
            return Err(format!("scale={scale} is no factor of displacements: give a finite number"));
        }
        Ok(Self { planes, scale: Number::new(scale) })
    }

    /// Factor of the displacements.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale.value()
    }
}

/// What a page wants to see of a frame.
#[derive(Clone, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct FrameRequest {
    /// `von_mises`, `velocity` (its size), `stress.xy`; none: no colours.
    pub scalar: Option<String>,
    /// Whether values of cells are averaged at the nodes of each part.
    pub averaged: bool,
    /// Contact forces.
    pub arrows: bool,
    /// A vector field of nodes, or a symmetric tensor field of cells, of which each place gets a glyph.
    pub glyphs: Option<String>,
    /// What planes cut of solid cells; of models in 2D nothing.
    pub section: Option<SectionRequest>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_are_read_with_unit_normals_and_what_is_none_is_refused_with_a_reason() {
        let read = SectionRequest::read("0,0,2,0.5;1,1,0,-1e-3", 2.0).unwrap();
        assert_eq!((read.planes.len(), read.scale()), (2, 2.0));
        assert_eq!((read.planes[0].normal(), read.planes[0].offset()), ([0.0, 0.0, 1.0], 0.5));
        let length: f64 = read.planes[1].normal().iter().map(|n| n * n).sum();
        assert!((length - 1.0).abs() < 1e-15);
        for text in [
            "",
            "1,0,0",
            "0,0,0,1",
            "1,0,0,inf",
            "nan,0,0,1",
            "1,0,0,x,2",
            "1,0,0,1;",
            "1,0,0,1;1,0,0,2;1,0,0,3;1,0,0,1;1,0,0,1;1,0,0,1;1,0,0,1;1,0,0,1;1,0,0,1",
        ] {
            assert!(SectionRequest::read(text, 1.0).is_err(), "{text}");
        }
        assert!(SectionRequest::read("1,0,0,0", f64::NAN).is_err());
    }
}
