//! What `embate diff` says.

use crate::numbers::{grouped, table, with_unit};
use embate_files::comparison::{Again, Found, RunLeft, Window};
use embate_solver::divergence::{Divergence, NodeDivergence, PartDivergence, Value};
use embate_solver::error::Error;
use std::fmt::Write as _;

/// What the two runs are called.
pub(super) const NAMES: [&str; 2] = ["A", "B"];
/// Parts of which nodes are shown; the others are counted.
const SHOWN: usize = 4;
/// Values of contacts and bodies that are shown.
const OTHERS: usize = 10;

/// Which runs they are, and how their models differ.
pub(super) fn runs(runs: &[RunLeft; 2]) -> String {
    let mut text = String::new();
    for (run, name) in runs.iter().zip(NAMES) {
        let mut reported = Vec::new();
        match &run.end {
            Some(end) => {
                let threads = if end.threads == 1 { "1 thread".to_string() } else { format!("{} threads", end.threads) };
                reported.push(format!("{}, {} steps to {}", end.status, grouped(end.steps), with_unit(end.time_end, "s")));
                reported.push(format!("{threads}, {}", end.simd));
            }
            None => reported.push(format!("not ended, {} steps at least", grouped(run.last_step()))),
        }
        reported.extend(run.version.iter().map(|version| format!("embate {version}")));
        if let Some((origin, _)) = &run.model {
            let set: String = origin.set.iter().map(|key| format!(" --set {key}")).collect();
            reported.push(format!("{}{set}", origin.path.display()));
        }
        // Writing to a string can't fail.
        let _ = writeln!(text, "{name}  {}: {}", run.folder.display(), reported.join("; "));
    }
    match [&runs[0].model, &runs[1].model] {
        [Some((_, a)), Some((_, b))] => {
            let [acting, others] = a.apart(b);
            match (acting.is_empty(), others.is_empty()) {
                (true, true) => text.push_str("the models are the same\n"),
                (true, false) => text.push_str("the models are the same but for what changes no step:\n"),
                (false, _) => text.push_str("the models differ:\n"),
            }
            acting.iter().for_each(|line| push(&mut text, line));
            if !acting.is_empty() && !others.is_empty() {
                text.push_str("and in what changes no step:\n");
            }
            others.iter().for_each(|line| push(&mut text, line));
        }
        _ => text.push_str("whether the models differ is not known: not both left run.json or a checkpoint\n"),
    }
    text
}

fn push(text: &mut String, line: &str) {
    let _ = writeln!(text, "  {line}");
}

/// What is known from what they left alone.
pub(super) fn logs(runs: &[RunLeft; 2], window: Option<&Window>) -> String {
    let mut text = String::new();
    match window {
        Some(Window { compared, same, differs, what }) => {
            let at = |step: &u64| {
                let time = runs[0].hashes_at(*step).map_or(String::new(), |hashes| format!(" ({:.6e} s)", hashes.time));
                format!("step {}{time}", grouped(*step))
            };
            let lines = if *compared == 1 { "1 line".into() } else { format!("{} lines", grouped(*compared as u64)) };
            let _ = match (same, differs) {
                (Some(same), Some(differs)) => {
                    writeln!(text, "logs: the same at {}, not at {}: {}", at(same), at(differs), what.join(", "))
                }
                (None, Some(differs)) => writeln!(text, "logs: not the same from {} on: {}", at(differs), what.join(", ")),
                (Some(same), None) => writeln!(text, "logs: the same in all {lines} that both have, the last at {}", at(same)),
                (None, None) => Ok(()),
            };
        }
        None => text.push_str("logs: none that both have lines of the same step in (`output.hash_steps`), so only the ends are compared\n"),
    }
    if window.is_some_and(|window| window.differs.is_some()) {
        return text;
    }
    let ends = match [&runs[0].end, &runs[1].end] {
        [Some(a), Some(b)] if a.steps != b.steps => {
            format!("the runs are not equally long: A has {} steps, B {}", grouped(a.steps), grouped(b.steps))
        }
        [Some(a), Some(b)] if a.state_hash != b.state_hash => "the last states differ".into(),
        [Some(a), Some(_)] if window.is_none() => format!("the last states are the same, {}; more is not known", a.state_hash),
        [Some(a), Some(_)] => format!("the runs are the same; last state {}", a.state_hash),
        _ if runs[0].last_step() == runs[1].last_step() => "the runs are the same as far as they are known; not both have ended".into(),
        _ => {
            let [a, b] = [0, 1].map(|k| grouped(runs[k].last_step()));
            format!("the runs are not equally long: A is known until step {a}, B until step {b}")
        }
    };
    push_plain(&mut text, &ends);
    text
}

fn push_plain(text: &mut String, line: &str) {
    let _ = writeln!(text, "{line}");
}

/// That both are gone over once more.
pub(super) fn again(sides: &[Again; 2], [from, to]: [u64; 2], left_out: &[String]) -> String {
    let mut text = String::new();
    left_out.iter().for_each(|line| push_plain(&mut text, &format!("not compared: {line}")));
    let begun = |side: &Again| if side.begun == 0 { "the start".into() } else { format!("step {}", grouped(side.begun)) };
    let [a, b] = [0, 1].map(|k| begun(&sides[k]));
    let steps = if from == to { format!("step {}", grouped(to)) } else { format!("steps {} to {}", grouped(from), grouped(to)) };
    let _ = writeln!(text, "both are gone over once more for {steps}, A from {a}, B from {b}");
    text
}

/// That a run does not come to what its log says.
pub(super) fn not_repeated(k: usize, step: u64, failed: Option<String>) -> String {
    let name = NAMES[k];
    let how = failed.map_or(String::new(), |error| format!(" (it fails: {error})"));
    let step = grouped(step);
    format!(
        "gone over here, run {name} does not come to what its log says of step {step}{how}: it was run on another machine or by another version, or something disturbed it\n\
         run {name} with this program again; until then the logs are all that is known\n"
    )
}

/// What came of it.
pub(super) fn found(found: &Found, sides: &[Again; 2]) -> String {
    match found {
        Found::Divergence(found) => divergence(found),
        Found::Nothing(step) => format!("gone over here, both are the same until step {}\n", grouped(*step)),
        Found::Failure { step, errors } => {
            let reported = |error: &Option<Error>| error.as_ref().map(Error::with_code);
            let mut text = format!("until step {} both are the same\n", grouped(step - 1));
            match [reported(&errors[0]), reported(&errors[1])] {
                [Some(a), Some(b)] if a == b => push_plain(&mut text, &format!("in step {} both fail: {a}", grouped(*step))),
                reported => reported.into_iter().zip(NAMES).for_each(|(error, name)| {
                    let what = error.map_or("continues".to_string(), |error| format!("fails: {error}"));
                    push_plain(&mut text, &format!("in step {} run {name} {what}", grouped(*step)));
                }),
            }
            let [a, b] = sides;
            let _ = writeln!(text, "at {:.6e} s in A, {:.6e} s in B", a.simulation.time(), b.simulation.time());
            text
        }
    }
}

fn divergence(found: &Divergence) -> String {
    let Divergence { step, time, time_step, governors, parts, others } = found;
    let mut text = String::new();
    let when = if time.differs() { format!("{:e} s in A, {:e} s in B", time.0, time.1) } else { format!("{:e} s", time.0) };
    let _ = writeln!(text, "\nthe runs diverge at step {}, t = {when}", grouped(*step));
    if time_step.differs() {
        let _ = writeln!(
            text,
            "the time step that follows: A {:e} s, set by {}; B {:e} s, set by {} ({})",
            time_step.0,
            governors[0],
            time_step.1,
            governors[1],
            apart(*time_step)
        );
    }
    if parts.is_empty() && others.is_empty() {
        let _ = writeln!(text, "all nodes, elements and contacts are still the same");
    }
    for (index, part) in parts.iter().enumerate() {
        if index == SHOWN {
            let names: Vec<&str> = parts[SHOWN..].iter().map(|part| part.name.as_str()).collect();
            let _ = writeln!(text, "parts that differ as well: {}", names.join(", "));
            break;
        }
        report_part(&mut text, part);
    }
    let rows: Vec<Vec<String>> = others.iter().take(OTHERS).map(|(name, value)| row(name, *value)).collect();
    if !rows.is_empty() {
        text.push_str(&table(&headed("contacts and rigid bodies", rows), ""));
        if others.len() > OTHERS {
            let _ = writeln!(text, "and {} more", others.len() - OTHERS);
        }
    }
    text
}

fn report_part(text: &mut String, part: &PartDivergence) {
    let PartDivergence { name, nodes, differing, first, farthest, energies } = part;
    let count = match differing {
        0 => format!("of {} nodes none differs yet, but the energy of the elements does", grouped(*nodes as u64)),
        1 => format!("1 of {} nodes differs", grouped(*nodes as u64)),
        _ => format!("{} of {} nodes differ", grouped(*differing as u64), grouped(*nodes as u64)),
    };
    let _ = writeln!(text, "\npart \"{name}\": {count}");
    if let Some(first) = first {
        report_node(text, "the first", first);
    }
    if let Some(farthest) = farthest.as_ref().filter(|farthest| first.as_ref().is_none_or(|first| first.number != farthest.number)) {
        report_node(text, "the one whose velocities are farthest apart", farthest);
    }
    if first.is_none() {
        text.push_str(&table(&headed("", energies.iter().map(|(name, value)| row(name, *value)).collect()), "  "));
    }
}

fn report_node(text: &mut String, which: &str, node: &NodeDivergence) {
    let NodeDivergence { number, user, values } = node;
    let place = |k: usize| values.get(k).map_or(f64::NAN, |(_, value)| value.0);
    let _ = writeln!(text, "{which} is node {number} of the part (node {user} of the fields) at ({:.6e}, {:.6e}) m", place(0), place(1));
    text.push_str(&table(&headed("", values.iter().map(|(name, value)| row(name, *value)).collect()), "  "));
}

fn headed(title: &str, rows: Vec<Vec<String>>) -> Vec<Vec<String>> {
    let head = [title, NAMES[0], NAMES[1], "apart"].map(String::from).to_vec();
    [head].into_iter().chain(rows).collect()
}

fn row(name: &str, value: Value) -> Vec<String> {
    vec![name.to_string(), format!("{:e}", value.0), format!("{:e}", value.1), apart(value)]
}

/// How far two numbers are apart.
fn apart(value: Value) -> String {
    match value.ulps() {
        _ if !value.differs() => "same".into(),
        None => "not a number".into(),
        Some(0) => "sign of zero".into(),
        _ if value.0 == 0.0 || value.1 == 0.0 => "from zero".into(),
        _ if value.0.is_sign_negative() != value.1.is_sign_negative() => "other sign".into(),
        Some(ulps @ ..1_000_000) => format!("{} ulp", grouped(ulps)),
        Some(ulps) => format!("{:.1e} ulp", ulps as f64),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_counted_in_numbers_between() {
        let reported = |a: f64, b: f64| apart(Value(a, b));
        assert_eq!(reported(1.0, 1.0), "same");
        assert_eq!(reported(1.0, 1.0 + 3.0 * f64::EPSILON), "3 ulp");
        assert_eq!(reported(0.0, -0.0), "sign of zero");
        assert_eq!(reported(1.0, 2.0), "4.5e15 ulp");
        assert_eq!(reported(f64::NAN, 2.0), "not a number");
        assert_eq!([reported(0.0, 1e-300), reported(1e-3, -1e-3)], ["from zero", "other sign"]);
    }
}
