//! `embate fit`: values that a closed form knows are found again, and what can't be is reported.

use crate::{Answer, FLIGHT, embate, fresh};
use std::fs;
use std::path::{Path, PathBuf};

fn fit(name: &str, arguments: &[&str]) -> (Answer, PathBuf) {
    let folder = fresh(name);
    fs::write(folder.join("flight.toml"), FLIGHT).unwrap();
    (again(&folder, arguments), folder)
}

fn again(folder: &Path, arguments: &[&str]) -> Answer {
    embate(folder, ["fit", "flight.toml", "--out", "out", "--quiet"].iter().chain(arguments))
}

/// The value that was found for a key, from the line that runs the model with it.
fn found(answer: &Answer, key: &str) -> f64 {
    let text = answer.out.split(&format!("--set {key}=")).nth(1).unwrap_or_else(|| panic!("{}{}", answer.out, answer.err));
    text.split_whitespace().next().unwrap().parse().unwrap()
}

fn rows(folder: &Path) -> Vec<String> {
    fs::read_to_string(folder.join("out/fit.csv")).unwrap().lines().map(ToString::to_string).collect()
}

#[test]
fn values_of_the_closed_form_are_found_again() {
    // A block of 1e-4 m² flies for 100 µs: x = 5 mm + v t, kinetic energy ½ ρ v² per area.
    let arguments = [
        "--vary",
        "part.block.velocity[0]=1m/s:9 m/s",
        "--vary",
        "material.steel.density=500:5000",
        "--measured",
        "last(P.x)=5.37 mm",
        "--measured",
        "last(energy.kinetic)=1.2321 J/m",
        "--tolerance",
        "1e-8",
    ];
    let (answer, folder) = fit("fit-flight", &arguments);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let (speed, density) = (found(&answer, "part.block.velocity[0]"), found(&answer, "material.steel.density"));
    assert!((speed - 3.7).abs() < 1e-5 && (density - 1800.0).abs() < 1e-1, "{}", answer.out);
    let rows = rows(&folder);
    assert_eq!(rows[0], "run,part.block.velocity[0] [m/s],material.steel.density,residual,error");
    // Begins in the middle; both derivatives, then four tries.
    assert!(rows[1].starts_with("1,5,2750,") && rows.len() >= 8 && rows.len() < 80, "{rows:?}");
    // The same for any number of runs at a time, and nothing is replaced unasked.
    let (other, _) = fit("fit-flight-jobs", &[&arguments[..], &["--jobs", "1"]].concat());
    assert_eq!(other.out, answer.out);
    let answer = again(&folder, &arguments);
    assert_eq!(answer.code, Some(1));
    assert!(answer.err.contains("already holds results (fit.csv)"), "{}", answer.err);
    assert_eq!(again(&folder, &[&arguments[..], &["--force"]].concat()).code, Some(0));
}

#[test]
fn a_curve_over_time_is_followed_and_errors_are_those_of_its_noise() {
    let folder = fresh("fit-curve");
    fs::write(folder.join("flight.toml"), FLIGHT).unwrap();
    // 4 m/s, with 1 µm up and down by turns: the slope's standard error is σ / √Σ (t − t̄)².
    let noise = |k: i32| if k % 2 == 0 { 1e-3 } else { -1e-3 };
    let points: String = (0..=10).map(|k| format!("{},{}\n", 10 * k, 5.0 + 4e-3 * f64::from(10 * k) + noise(k))).collect();
    fs::write(folder.join("path.csv"), format!("time [us],x [mm]\n{points}")).unwrap();
    let answer = again(&folder, &["--vary", "part.block.velocity[0]=1:2:9", "--measured", "P.x=path.csv", "--tolerance", "1e-8"]);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    // Through the fixed point at time zero: v = Σ t (x − x₀) / Σ t².
    let times: Vec<f64> = (0..=10).map(|k| 1e-5 * f64::from(k)).collect();
    let squares: f64 = times.iter().map(|t| t * t).sum();
    let excess = |k: i32| 1e-3 * noise(k);
    let expected = 4.0 + times.iter().zip(0..).map(|(t, k)| t * excess(k)).sum::<f64>() / squares;
    let speed = found(&answer, "part.block.velocity[0]");
    assert!((speed - expected).abs() < 1e-6 * expected, "{speed} {expected}");
    let rest = |k: i32, t: f64| excess(k) - (expected - 4.0) * t;
    let variance = times.iter().zip(0..).map(|(&t, k)| rest(k, t).powi(2)).sum::<f64>() / 10.0;
    let error = (variance / squares).sqrt();
    let shown: f64 = answer.out.split('±').nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap();
    let scale = if answer.out.contains("mm/s") { 1e-3 } else { 1.0 };
    assert!((shown * scale - error).abs() < 1e-2 * error, "{} {error}", answer.out);
}

/// A bar of 100 mm and 1 cm² that is pulled by 2 mm and let back by 0.2 mm; `E`, `σ_y` and `H` are 200 GPa,
/// 300 MPa and 2 GPa.
const TENSILE: &str = r#"
[run]
end = "20 ms"
[material.steel]
law = "j2"
density = 7800
young = "200 GPa"
poisson = 0.3
yield = "250 MPa"
hardening = "1 GPa"
[[part]]
name = "bar"
material = "steel"
element = "bar2"
area = "1e-4 m"
truss = { lines = [[[0, 0], ["100 mm", 0]]] }
[[constraint]]
on = "bar.point0"
fixed = ["x", "y"]
[[constraint]]
on = "bar.point1"
fixed = ["y"]
displacement = { x = "pull" }
[curve.pull]
time = ["0 ms", "16 ms", "17 ms", "20 ms"]
value = ["0 mm", "2 mm", "2 mm", "1.8 mm"]
[[cut]]
name = "middle"
point = ["50 mm", 0]
normal = [1, 0]
[[probe]]
name = "P"
set = "bar.point1"
[[channel]]
name = "elongation"
expression = "P.x - 0.1"
[output]
history = 400
forces = "sample"
pictures = false
"#;

/// The force (N) of the bar at an elongation (m), drawn out further than ever or let back from `farthest`, in
/// closed form: with ε = ln(l/l₀), σ = σ_y + E H/(E + H) (ε − σ_y/E) beyond the yield, elastic on the way
/// back, and the area A₀ exp(2 ε_t) with ε_t = −ν σ/E − ½ (ε − σ/E).
fn force_at(elongation: f64, farthest: f64) -> f64 {
    let (young, poisson, yields, hardening) = (200e9, 0.3, 300e6, 2e9);
    let strain = |elongation: f64| (1.0 + elongation / 0.1).ln();
    let drawn = |strain: f64| {
        let beyond = strain - yields / young;
        if beyond < 0.0 { young * strain } else { yields + young * hardening / (young + hardening) * beyond }
    };
    let here = strain(elongation);
    let stress = if elongation < farthest { drawn(strain(farthest)) - young * (strain(farthest) - here) } else { drawn(here) };
    let across = -poisson * stress / young - 0.5 * (here - stress / young);
    stress * 1e-4 * (2.0 * across).exp()
}

#[test]
fn force_over_displacement_gives_yield_and_hardening() {
    let folder = fresh("fit-tensile");
    fs::write(folder.join("flight.toml"), TENSILE).unwrap();
    // But for the yield point: between the rows of a run a kink is a straight line.
    let pulled = (1..=40).filter(|k| *k != 3).map(|k| 0.05e-3 * f64::from(k)).map(|x| (x, force_at(x, x)));
    // The same elongations on the way back, at other forces.
    let back = [1.95e-3, 1.9e-3, 1.85e-3].map(|x| (x, force_at(x, 2e-3)));
    let rows: String = pulled.chain(back).map(|(x, force)| format!("{},{}\n", 1e3 * x, 1e-3 * force)).collect();
    fs::write(folder.join("tensile.csv"), format!("elongation [mm],force [kN/m]\n{rows}")).unwrap();
    let vary = ["--vary", "material.steel.yield=100MPa:600MPa", "--vary", "material.steel.hardening=0.2GPa:10GPa", "--tolerance", "1e-8"];
    let answer = again(&folder, &[&vary[..], &["--measured", "cut.normal_force[middle] over elongation=tensile.csv"]].concat());
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    let (yields, hardening) = (found(&answer, "material.steel.yield"), found(&answer, "material.steel.hardening"));
    assert!((yields / 300e6 - 1.0).abs() < 2e-4 && (hardening / 2e9 - 1.0).abs() < 2e-3, "{}", answer.out);
    // What the run never comes to is refused: further out, and further back.
    for (rows, word) in [("1,30\n2.5,32\n", "point 2 of far.csv: the run does not come to 2.5"), ("1,30\n0.5,28\n", "point 2")] {
        fs::write(folder.join("far.csv"), format!("elongation [mm],force [kN/m]\n{rows}")).unwrap();
        let answer = again(&folder, &[&vary[..], &["--measured", "cut.normal_force[middle] over elongation=far.csv", "--force"]].concat());
        assert_eq!(answer.code, Some(1), "{}", answer.out);
        assert!(answer.err.contains("E0909") && answer.err.contains(word), "{}", answer.err);
    }
    let answer = again(&folder, &[&vary[..], &["--measured", "cut.normal_force[middle] over elongations=tensile.csv", "--force"]].concat());
    assert!(answer.code == Some(2) && answer.err.contains("E0902") && answer.err.contains("elongation"), "{}", answer.err);
}

#[test]
fn what_nothing_depends_on_or_a_bound_holds_is_reported() {
    let arguments = [
        "--vary",
        "part.block.velocity[0]=1:3",
        "--vary",
        "run.energy_limit=0.1:0.4",
        "--measured",
        "last(P.x)=5.37mm",
        "--measured",
        "last(P.y)=5mm",
    ];
    let (answer, _) = fit("fit-blind", &arguments);
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    assert!(answer.out.contains("what was measured does not say it") && answer.out.contains("at its bound"), "{}", answer.out);
}

#[test]
fn what_can_not_be_is_reported_before_anything_runs() {
    let vary = ["--vary", "part.block.velocity[0]=1:9"];
    let measured = ["--measured", "last(P.x)=5.37mm"];
    for (arguments, code, word) in [
        (vec!["--vary", "part.block.velocity[0]=9:1", measured[0], measured[1]], 2, "E0907"),
        (vec![vary[0], vary[1], "--measured", "P.x=nowhere.csv"], 2, "E0908"),
        (vec![vary[0], vary[1], "--measured", "last(Q.x)=1"], 2, "E0902"),
        (vec![vary[0], vary[1], "--measured", "P.x over P.y=5mm"], 2, "more than one place"),
        (vec!["--vary", "part.block.velosity[0]=1:9", measured[0], measured[1]], 2, "velosity"),
        (vec!["--vary", "material.steel.density=-5:5", measured[0], measured[1]], 2, "must be"),
        (vec![vary[0], vary[1], measured[0], measured[1], "--step", "0"], 2, "--step is 0"),
        (vec!["--vary", "run.energy_limit=1e-300:2e-300", measured[0], measured[1], "--set", "part.block.velocity=[7, 3]"], 1, "E0909"),
    ] {
        let (answer, folder) = fit("fit-refused", &arguments);
        assert_eq!(answer.code, Some(code), "{arguments:?}: {}", answer.err);
        assert!(answer.err.contains(word), "{arguments:?}: {}", answer.err);
        assert_eq!(folder.join("out").exists(), code == 1, "{arguments:?}");
    }
}
