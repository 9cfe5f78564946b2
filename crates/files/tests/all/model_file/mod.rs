//! The model file: what it reads, what it refuses and with which words, and that no text makes it panic.

mod contact;
mod described;
mod faults;
mod random;
mod reads;
mod shapes;
mod solids;
mod warnings;

use embate_files::model_file::{Diagnostic, Diagnostics, load_text};
use embate_solver::model::Model;
use std::path::Path;

/// A sound model that uses every section but those of [`MORE`]; tests replace or add lines.
pub(crate) const SOUND: &str = r#"title = "all sections"
[run]
end = "1 ms"
[material.steel]
law = "j2"
young = "200 GPa"
poisson = 0.3
density = "7800 kg/m^3"
yield = "100 MPa"
[[part]]
name = "tube"
material = "steel"
ring = { centre = [0, 0.1], inner = "94 mm", outer = "100 mm", from = "-90 deg", to = "90 deg", elements = [1, 40] }
[[part]]
name = "plate"
material = "steel"
rectangle = { corner = [0, "-3 mm"], size = ["600 mm", "3 mm"], elements = [120, 3] }
[[part]]
name = "ball"
material = "steel"
disk = { centre = [0, 0.1], radius = "9 mm", elements = 4 }
[[contact]]
between = ["tube", "plate"]
[[obstacle]]
parts = ["plate"]
plane = { normal = [1, 0] }
[[symmetry]]
normal = [1, 0]
[[constraint]]
on = "plate.left"
fixed = "x"
[[load]]
gravity = [0, "-9.81 m/s^2"]
[[probe]]
name = "A"
part = "tube"
point = [0, 0]
[output]
fields = 10
[curve.ramp]
time = [0, "1 ms"]
value = [0, "5 m/s"]
[[obstacle]]
circle = { centre = [0, 1], radius = "10 mm" }
[[obstacle]]
polyline = { points = [[0, -1], [1, -1]] }
"#;

/// The other sections.
pub(crate) const MORE: &str = r#"[[cut]]
name = "section"
point = [0, "-1 mm"]
normal = [0, 1]
parts = ["plate"]
[[channel]]
name = "height"
expression = "A.y - first(A.y)"
[[non_reflecting]]
on = "ball.outer"
[[join]]
between = ["tube.start", "tube.end"]
rotation = "180 deg"
centre = [0, 0.1]
[[weld]]
between = ["tube.start", "ball.outer"]
at = [[0, 0.1]]
normal_strength = "5 kN/m"
[[joint]]
between = ["tube.end", "ball.outer"]
kind = "revolute"
at = [0, 0.1]
[[spring]]
between = ["tube.start", "ball.outer"]
elongation = [0, "1 mm"]
force = [0, "5 N/m"]
[[cavity]]
name = "gas"
on = "tube.inner"
ambient = "100 kPa"
inflow = [{ rate = "0.5 kg/s/m", temperature = "600 K" }]
vents = [{ orifice = "1 mm" }]
[[point_mass]]
on = "ball"
mass = "2 kg/m"
"#;

/// Reads a text with all its lines numbered from 1.
pub(crate) fn read(text: &str) -> Result<Model, Diagnostics> {
    load_text("model.toml", text, Path::new("."), &[])
}

/// The faults of a text.
pub(crate) fn faults(text: &str) -> Vec<Diagnostic> {
    read(text).map_or_else(|diagnostics| diagnostics.entries, |_| Vec::new())
}

/// [`SOUND`] with `from` replaced by `to`.
pub(crate) fn changed(from: &str, to: &str) -> String {
    assert!(SOUND.contains(from), "{from}");
    SOUND.replacen(from, to, 1)
}
