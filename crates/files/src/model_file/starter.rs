//! The model that `embate new` writes: short, commented, runs in a second.

/// A commented starter model: two small elastic blocks collide. `name` becomes its title.
#[must_use]
pub fn starter(name: &str) -> String {
    let plain: String = name.chars().map(|c| if c.is_control() || matches!(c, '"' | '\\') { '_' } else { c }).collect();
    include_str!("starter.toml").replace("NAME OF THE MODEL", &plain)
}
