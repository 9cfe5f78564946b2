//! The library of materials: its data, the page that shows it, the figures of the laws, and `from` in models.

use embate_files::model_file::{LibraryMaterial, library, load_text, load_text_with_places};
use embate_files::registries::{law_curves, library_markdown};
use embate_solver::material::{self, Parameters};
use embate_solver::model::{Material, Model};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A block of a material, with lines that stand in its table.
fn text(lines: &str) -> String {
    format!(
        "[run]\nend = \"1 us\"\n\n[material.it]\n{lines}\n\n[[part]]\nname = \"block\"\nmaterial = \"it\"\n\
         rectangle = {{ corner = [0, 0], size = [\"1 mm\", \"1 mm\"], elements = [2, 2] }}\n"
    )
}

fn model(lines: &str) -> Model {
    load_text("model.toml", &text(lines), Path::new("."), &[]).unwrap_or_else(|faults| panic!("{lines}\n{faults}"))
}

fn faults(lines: &str) -> String {
    load_text("model.toml", &text(lines), Path::new("."), &[]).unwrap_err().rendered
}

fn of(entry: &LibraryMaterial) -> Material {
    model(&format!("from = \"{}\"", entry.name)).materials["it"].clone()
}

#[test]
fn every_material_is_sound_and_plausible_and_each_value_has_its_source() {
    let names: BTreeSet<&str> = library().iter().map(|entry| entry.name.as_str()).collect();
    assert_eq!(names.len(), library().len(), "a name is there twice");
    assert!(names.len() >= 40, "{}", names.len());
    for entry in library() {
        let it = of(entry);
        let name = &entry.name;
        assert_eq!((it.from.as_str(), it.law.as_str(), it.eos.as_str()), (name.as_str(), entry.law.as_str(), entry.eos.as_str()));
        assert!(!entry.group.is_empty() && !entry.about.is_empty() && !entry.about.ends_with('.'), "{name}");
        let mut count = 0;
        for value in entry.values() {
            count += 1;
            assert!(value.source.len() > 8 && !value.source.contains(['{', '}']), "{name}: {} has no source", value.key);
            assert!(it.parameters.contains_key(&value.key) || it.lists.contains_key(&value.key), "{name}: {}", value.key);
        }
        assert!(count >= it.lists.len() + 2, "{name}");
        // What the fastest wave does: ρ c² = K + 4µ/3.
        let kind = material::registry().into_iter().find(|kind| kind.name == it.law).unwrap();
        let parameters = Parameters::new(kind.parameters, &it.parameters, &it.lists);
        let density = it.parameters["density"];
        assert!((0.5..25_000.0).contains(&density), "{name}: {density}");
        if it.law != "null" {
            let [bulk, shear] = material::stiffness(&it.law, &parameters).unwrap();
            let speed = ((bulk + 4.0 / 3.0 * shear) / density).sqrt();
            assert!((50.0..14_500.0).contains(&speed), "{name}: {speed} m/s");
            let strengths = ["yield", "cohesion"].iter().filter_map(|key| it.parameters.get(*key));
            let first = it.lists.get("stress").and_then(|stress| stress.first());
            for strength in strengths.chain(first) {
                assert!(*strength < 0.1 * it.parameters["young"], "{name}: {strength}");
            }
        }
        if let Some(c0) = it.parameters.get("c0") {
            assert!((1000.0..6000.0).contains(c0), "{name}: {c0} m/s");
        }
    }
}

#[test]
fn where_law_and_equation_of_state_both_know_the_bulk_modulus_they_agree() {
    let both: Vec<&LibraryMaterial> = library().iter().filter(|entry| entry.eos == "mie_gruneisen" && entry.law != "null").collect();
    assert!(both.len() >= 4);
    for entry in both {
        let it = of(entry);
        let [young, poisson, density, c0] = ["young", "poisson", "density", "c0"].map(|key| it.parameters[key]);
        let ratio = density * c0 * c0 / (young / (3.0 * (1.0 - 2.0 * poisson)));
        // Polymers are stiffer in sound than in slow tests.
        assert!((0.85..1.4).contains(&ratio), "{}: {ratio}", entry.name);
    }
}

#[test]
fn explosives_detonate_as_fast_as_they_say() {
    let explosives: Vec<&LibraryMaterial> = library().iter().filter(|entry| entry.eos == "jwl").collect();
    assert!(explosives.len() >= 6);
    for entry in explosives {
        let it = of(entry);
        let get = |key: &str| it.parameters[key];
        let [density, a, b] = ["density", "pressure_a", "pressure_b"].map(get);
        let [r1, r2, omega, energy] = ["r1", "r2", "omega", "energy_initial"].map(get);
        // Chapman and Jouguet: the slowest wave from the gases' Hugoniot, p = f(v) + ω/v (E + p (1 − v)/2).
        let speed = |v: f64| {
            let cold = a * (1.0 - omega / (r1 * v)) * (-r1 * v).exp() + b * (1.0 - omega / (r2 * v)) * (-r2 * v).exp();
            let pressure = (cold + omega / v * energy) / (1.0 - 0.5 * omega / v * (1.0 - v));
            (pressure / (density * (1.0 - v))).sqrt()
        };
        let slowest = (600..950).map(|v| speed(f64::from(v) * 1e-3)).fold(f64::INFINITY, f64::min);
        let stated: f64 = entry.about.rsplit("velocity ").next().unwrap().trim_end_matches(" m/s").parse().unwrap();
        assert!((slowest / stated - 1.0).abs() < 0.004, "{}: {slowest} for {stated} m/s", entry.name);
    }
}

#[test]
fn curves_that_come_from_formulas_agree_with_them() {
    // DNV-RP-C208: σ = K (ε + (σ₂/K)^(1/n) − ε₂)^n from the end of the plateau on.
    for (name, [end, strength, exponent]) in [
        ("steel S235", [0.02, 520e6, 0.166]),
        ("steel S275", [0.017, 620e6, 0.166]),
        ("steel S355", [0.015, 740e6, 0.166]),
        ("steel S420", [0.012, 738e6, 0.14]),
        ("steel S460", [0.01, 772e6, 0.12]),
    ] {
        let it = model(&format!("from = \"{name}\"")).materials["it"].clone();
        let (strains, stresses) = (&it.lists["plastic_strain"], &it.lists["stress"]);
        assert_eq!((strains[1], strains[2]), (0.004, end));
        let offset = (stresses[2] / strength).powf(1.0 / exponent) - end;
        for (strain, stress) in strains.iter().zip(stresses).skip(3) {
            assert!((stress / (strength * (strain + offset).powf(exponent)) - 1.0).abs() < 3e-4, "{name} at {strain}");
        }
    }
    // Considère: the engineering stress is largest where σ = dσ/dε.
    let it = model("from = \"steel DP600\"").materials["it"].clone();
    let [strength, offset, exponent] = ["strength", "strain_offset", "hardening_exponent"].map(|key| it.parameters[key]);
    let largest = strength * exponent.powf(exponent) * (offset - exponent).exp();
    assert!((largest / 590e6 - 1.0).abs() < 1e-3 && (strength * offset.powf(exponent) / 330e6 - 1.0).abs() < 1e-3, "{largest}");
    let it = model("from = \"steel 304\"").materials["it"].clone();
    let [first, modulus] = ["yield", "hardening"].map(|key| it.parameters[key]);
    assert!((modulus * (first / modulus - 1.0).exp() / 520e6 - 1.0).abs() < 1e-3);
}

#[test]
fn keys_beside_from_take_the_place_of_its_own() {
    let plain = model("from = \"steel DP600\"").materials["it"].clone();
    let changed = model("from = \"steel DP600\"\nstrength = \"1 GPa\"\nfailure = { plastic_strain = 0.4 }").materials["it"].clone();
    assert_eq!(changed.parameters["strength"], 1e9);
    assert_eq!(changed.failure, BTreeMap::from([("plastic_strain".to_string(), 0.4)]));
    let others =
        |it: &Material| it.parameters.iter().filter(|(key, _)| *key != "strength").map(|(k, v)| (k.clone(), *v)).collect::<Vec<_>>();
    assert_eq!(others(&plain), others(&changed));
    // The same law may be named.
    assert_eq!(model("from = \"steel DP600\"\nlaw = \"j2_swift\"").materials["it"], plain);
    // Lists are replaced whole; another equation of state has its own keys.
    let table = model("from = \"steel S355\"\nplastic_strain = [0, 1]\nstress = [\"355 MPa\", \"700 MPa\"]").materials["it"].clone();
    assert_eq!(table.lists["stress"], [355e6, 700e6]);
    let other = model("from = \"copper OFHC shock\"\neos = \"linear\"\nbulk_modulus = \"140 GPa\"").materials["it"].clone();
    assert!(other.eos == "linear" && !other.parameters.contains_key("c0") && other.parameters["yield"] == 90e6, "{other:?}");
    let more = model("from = \"copper OFHC\"\neos = \"linear\"\nbulk_modulus = \"140 GPa\"").materials["it"].clone();
    assert_eq!(more.parameters["bulk_modulus"], 140e9);
}

#[test]
fn overrides_and_sweeps_reach_the_keys_of_the_library() {
    let set = ["material.it.young=200 GPa".to_string(), "material.it.from=steel S355".to_string()];
    let it = load_text("model.toml", &text("from = \"steel S235\""), Path::new("."), &set).unwrap().materials["it"].clone();
    assert_eq!((it.from.as_str(), it.parameters["young"], it.lists["stress"][0]), ("steel S355", 200e9, 320e6));
}

#[test]
fn what_is_wrong_with_from_is_said_once_and_at_its_line() {
    for (lines, expected) in [
        ("from = \"steel DP60\"", "the library has no material \"steel DP60\""),
        ("from = \"steel DP60\"", "did you mean `steel DP600`?"),
        ("from = \"dp600\"", "did you mean `steel DP600`?"),
        ("from = \"aluminum 6082\"", "did you mean `aluminium 6082-T6`?"),
        ("from = \"6082 T6 aluminum\"", "did you mean `aluminium 6082-T6`?"),
        ("from = \"copper\"", "did you mean `copper OFHC` or `copper OFHC shock`?"),
        ("from = \"unobtainium\"", "`embate list materials --library` shows all"),
        ("from = \"\"", "`embate list materials --library` shows all"),
        ("from = 7", "`from` must be a text"),
        ("from = \"steel DP600\"\nlaw = \"j2\"", "has the law `j2_swift`, but here it is \"j2\""),
        ("from = \"steel DP600\"\nyield = \"400 MPa\"", "has no key `yield`"),
        ("from = \"steel\"\nyoung = \"-1 Pa\"", "`young` must be greater than 0"),
        ("young = \"210 GPa\"", "[material.it] needs `law` or `from`"),
    ] {
        let found = faults(lines);
        assert!(found.contains(expected), "{lines}: {found}");
        assert!(found.contains("1 fault:"), "{lines}: {found}");
    }
    // What is wrong with values of the library in this model points to the line of `from`.
    let found = faults("from = \"air\"\npressure_initial = \"-1 Pa\"");
    assert!(found.contains("model.toml:6"), "{found}");
    let found = faults("from = \"steel S355\"\nstress = [\"355 MPa\"]");
    assert!(found.contains("1 fault:") && found.contains("model.toml:"), "{found}");
}

#[test]
fn a_key_of_the_library_is_not_in_the_file() {
    let loaded = load_text_with_places("model.toml", &text("from = \"steel S355\"\nyoung = \"200 GPa\""), Path::new("."), &[]).unwrap();
    assert_eq!(loaded.key("material.it.young").written.as_deref(), Some("\"200 GPa\""));
    assert_eq!(loaded.key("material.it.from").written.as_deref(), Some("\"steel S355\""));
    assert_eq!(loaded.key("material.it.poisson").written, None);
}

/// A file of the book that the program makes.
fn held(path: &Path, made: &str) {
    if std::env::var_os("EMBATE_BLESS").is_some() {
        fs::write(path, made).unwrap();
    }
    let kept = fs::read_to_string(path).unwrap_or_default().replace("\r\n", "\n");
    assert!(kept == made, "{} is not what the program makes: run this test with EMBATE_BLESS=1 and commit the file", path.display());
}

#[test]
fn the_page_of_the_library_is_the_one_that_the_data_makes() {
    held(&project().join("docs/materials.md"), &library_markdown());
}

#[test]
fn the_page_of_the_laws_has_the_curves_that_the_laws_make() {
    let curves = law_curves();
    for law in material::registry() {
        let is_shown = curves.iter().any(|(name, _)| *name == law.name);
        // A straight line, and what has no curve of one strain.
        let is_plain = ["elastic", "orthotropic_elastic", "drucker_prager", "null"].contains(&law.name);
        assert!(is_shown != is_plain, "{}", law.name);
    }
    for (law, svg) in curves {
        assert!(svg.contains("stroke-linejoin") && !svg.contains("NaN"), "{law} has no curve");
        held(&project().join(format!("docs/images/law-{law}.svg")), &svg);
    }
}
