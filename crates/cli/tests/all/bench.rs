//! `embate bench`: that its figures are figures, and that it keeps to its time. How fast the machine is, no
//! test says.

use crate::{embate, fresh};
use serde_json::Value;
use std::fs;
use std::time::Instant;

fn positive(value: &Value) -> f64 {
    let number = value.as_f64().unwrap_or_else(|| panic!("{value} is no number"));
    assert!(number.is_finite() && number > 0.0, "{number}");
    number
}

#[test]
fn a_short_measurement_has_finite_positive_figures_and_says_what_it_left_out() {
    let folder = fresh("bench");
    let begin = Instant::now();
    let answer = embate(&folder, ["bench", "--seconds", "0.5", "--json", "bench.json"]);
    let seconds = begin.elapsed().as_secs_f64();
    assert_eq!(answer.code, Some(0), "{}", answer.err);
    for word in [
        "triad",
        "Gflop/s",
        "quad4_reduced",
        "neo_hookean",
        "hex8_reduced",
        "tet4",
        "j2, bulk viscosity",
        "left out: large bodies",
        "million element-steps",
    ] {
        assert!(answer.out.contains(word), "{word} in\n{}", answer.out);
    }
    let json: Value = serde_json::from_str(&fs::read_to_string(folder.join("bench.json")).unwrap()).unwrap();
    assert!(positive(&json["machine"]["processors"]) >= 1.0);
    let rows = |name: &str| json[name].as_array().unwrap().clone();
    assert!(!rows("kernels").is_empty() && !rows("steps").is_empty() && !rows("left_out").is_empty());
    for row in rows("kernels").iter().chain(&rows("steps")) {
        positive(&row["element_steps_per_second"]);
        positive(&row["operations_at_ceiling"]);
    }
    for row in json["ceilings"]["triad"].as_array().unwrap() {
        positive(&row["bytes_per_second"]);
    }
    let arithmetic = json["ceilings"]["multiply_add"].as_array().unwrap();
    assert_eq!(arithmetic.len(), json["machine"]["levels"].as_array().unwrap().len());
    for row in arithmetic {
        positive(&row["operations_per_second"]);
    }
    assert!(json["contact"].as_array().unwrap().is_empty(), "not in so short a time");
    // Each figure takes three rounds even where there is no time for them: much more than half a second, much
    // less than a minute.
    assert!(positive(&json["wall_seconds"]) <= seconds && seconds < 60.0, "{seconds} s");
}

#[test]
fn times_that_are_none_are_refused() {
    for seconds in ["-1", "soon", "1e9", "nan"] {
        let answer = embate(std::path::Path::new("."), ["bench", "--seconds", seconds]);
        assert_eq!(answer.code, Some(2), "{seconds}: {}", answer.err);
    }
    assert_eq!(embate(std::path::Path::new("."), ["bench", "--quiet"]).code, Some(2), "nothing would be left to see");
}
