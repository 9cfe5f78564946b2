//! The catalogue of messages: each kind of error and warning has a permanent code, a title, an example, a
//! cause and a remedy.
//!
//! Entries stand beside the code that raises them, as statics that a `MESSAGES` list of their file names;
//! [`crate::catalogue`] joins those of the solver, and the crates above add theirs. Every error is made with
//! a `&'static Message`, so there is none without an entry. `embate explain` and `docs/messages.md` print
//! them.

use std::fmt;

/// One kind of message.
#[derive(Debug, PartialEq, Eq)]
pub struct Message {
    /// `E0123` for an error, `W0123` for a warning; the first two digits are the area. A code is never given
    /// to another kind.
    pub code: &'static str,
    /// What it is, in a few words.
    pub title: &'static str,
    /// What provokes it.
    pub example: Example,
    /// How it comes about.
    pub cause: &'static str,
    /// What to do.
    pub remedy: &'static str,
}

/// What provokes a message; tests do so with all but words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Example {
    /// Lines of a model file: its tables take the place of those of [`BASE`], its other keys join them.
    Model(&'static str),
    /// A whole model file.
    File(&'static str),
    /// A mesh file of Gmsh.
    Gmsh(&'static str),
    /// An input deck.
    Deck(&'static str),
    /// Arguments of the program; `model.toml` is [`BASE`].
    Command(&'static str),
    /// Lines of a shell, with [`BASE`] as `model.toml`; the last calls the program.
    Shell(&'static str),
    /// When it comes, where no short input provokes it.
    Words(&'static str),
}

/// A sound model, which examples change.
pub const BASE: &str = r#"[run]
end = "10 us"

[material.steel]
law = "elastic"
density = "7800 kg/m^3"
young = "200 GPa"
poisson = 0.3

[[part]]
name = "block"
material = "steel"
velocity = ["10 m/s", 0]
rectangle = { corner = [0, 0], size = ["10 mm", "10 mm"], elements = [2, 2] }

[[part]]
name = "wall"
material = "steel"
rectangle = { corner = ["10.01 mm", "-5 mm"], size = ["10 mm", "20 mm"], elements = [2, 4] }

[[contact]]
name = "hit"
between = ["block.right", "wall.left"]

[output]
pictures = false
"#;

/// Areas by the first two digits of their codes.
pub const AREAS: &[(&str, &str)] = &[
    ("01", "Model file"),
    ("02", "Bodies and meshes"),
    ("03", "Materials"),
    ("04", "Contact and obstacles"),
    ("05", "Loads, joints and motion"),
    ("06", "Runs"),
    ("07", "Results"),
    ("08", "Command line"),
    ("09", "Import, sweeps and verification"),
];

/// Messages of one kind that are shown; the rest is counted.
pub const SHOWN: usize = 20;

impl Message {
    /// Whether it is a warning.
    #[must_use]
    pub fn is_warning(&self) -> bool {
        self.code.starts_with('W')
    }
}

/// What a message begins with: `error[E0123]`.
impl fmt::Display for Message {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}[{}]", if self.is_warning() { "warning" } else { "error" }, self.code)
    }
}
