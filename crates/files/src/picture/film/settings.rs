//! What a film looks like: chosen by the model's `[output]`, read by `film` and `mesh`.

use embate_solver::model::Camera;

/// What a film looks like.
#[derive(Clone, Debug, PartialEq)]
pub struct FilmSettings {
    /// Title, at the upper left.
    pub title: String,
    /// Whether bodies are also shown mirrored at x = 0, at y = 0 and, in 3D, at z = 0 (symmetric models).
    pub mirror: [bool; 3],
    /// Lower and upper corner of what is shown, mirror images included, m; none: all bodies, and obstacles
    /// near them. In 3D to the right and upwards in the picture, from the image of the origin.
    pub view: Option<[[f64; 2]; 2]>,
    /// From where a model in 3D is seen.
    pub camera: Camera,
    /// Whether forces are those of whole bodies, and not per metre of depth.
    pub of_whole_bodies: bool,
    /// Field shown as colour: a name (`von_mises`; vectors show their size) or a component (`stress.xy`);
    /// empty: plastic strain if there is any, else the equivalent stress.
    pub field: String,
    /// For each part whether it is rigid: nothing strains it, so fields of elements leave it grey. Parts
    /// beyond the list are not.
    pub rigid: Vec<bool>,
    /// Width of `final.png`, pixels; the animation is at most 640 wide.
    pub width: u32,
    /// Largest height of `final.png`, pixels; flat bodies get a lower picture.
    pub height: u32,
}

impl Default for FilmSettings {
    fn default() -> Self {
        Self {
            title: String::new(),
            mirror: [false; 3],
            view: None,
            camera: Camera::default(),
            of_whole_bodies: false,
            field: String::new(),
            rigid: Vec::new(),
            width: 960,
            height: 720,
        }
    }
}
