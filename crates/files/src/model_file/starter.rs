//! The models that `embate new` writes: short, commented, run in seconds.

/// A model to start from.
#[derive(Clone, Copy, Debug)]
pub struct Starter {
    /// Name of the template.
    pub name: &'static str,
    /// What it is.
    pub doc: &'static str,
    text: &'static str,
}

/// Name of the schema's file beside a new model.
pub const SCHEMA_NAME: &str = "embate.schema.json";

/// All templates; the first is that of `embate new` without a template.
pub const STARTERS: &[Starter] = &[
    Starter { name: "2d", doc: "two small blocks collide", text: include_str!("starter/2d.toml") },
    Starter { name: "3d", doc: "a ball dents a plate of solids", text: include_str!("starter/3d.toml") },
    Starter { name: "axisymmetric", doc: "a rod hits a wall", text: include_str!("starter/axisymmetric.toml") },
    Starter { name: "shell", doc: "a thin-walled tube is crushed", text: include_str!("starter/shell.toml") },
    Starter { name: "drop-test", doc: "a housing with a heavy core falls on the floor", text: include_str!("starter/drop-test.toml") },
];

impl Starter {
    /// That of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        STARTERS.iter().find(|starter| starter.name == name)
    }

    /// The commented model; `name` becomes its title.
    #[must_use]
    pub fn model(&self, name: &str) -> String {
        let plain: String = name.chars().map(|c| if c.is_control() || matches!(c, '"' | '\\') { '_' } else { c }).collect();
        self.text.replace("NAME OF THE MODEL", &plain).replacen("SCHEMA", &format!("./{SCHEMA_NAME}"), 1)
    }
}
