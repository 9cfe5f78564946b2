//! How a run ended: status, command, warnings and error with what the catalogue says of them, its figures,
//! and how the report was made.

use super::Left;
use super::html::{escape, facts, section};
use crate::messages;
use crate::numbers::grouped;
use crate::post_mortem::shown;
use crate::program;
use crate::results::{Provenance, Stage};
use embate_solver::message::Message;
use serde::Deserialize;
use serde_json::Value;
use std::time::{SystemTime, UNIX_EPOCH};

/// Title, status and what is needed to run the model again.
pub(super) fn head(left: &Left) -> String {
    let (class, status) = match left.text("status") {
        Some("done") => ("good", "done".to_string()),
        Some("failed") => ("bad", "failed".to_string()),
        Some("stopped") => ("note", "stopped before its end time".to_string()),
        Some(other) => ("note", other.to_string()),
        None if left.summary.is_some() => ("note", "unknown: summary.json has no status".to_string()),
        None if left.grows() => ("note", "not at its end: the run continues, or was cut off".to_string()),
        None => ("note", "not known: there is no summary.json, which a run writes at its end".to_string()),
    };
    let mut text =
        format!("<header>\n<h1>{}</h1>\n<p>Status: <span class=\"status {class}\">{}</span></p>\n", escape(&left.title()), escape(&status));
    if left.summary.is_none() {
        text += "<p>There is no <code>summary.json</code> yet: what follows is what the run has left so far. After \
            it was cut off, <code>embate resume</code> continues from its newest checkpoint, if it kept any.</p>\n";
    }
    if let Some(command) = left.ran.as_ref().and_then(Provenance::command) {
        text += &format!("<p>To run it again:</p>\n<pre>{}</pre>\n", escape(&command));
        if let Some(hash) = left.text("state_hash") {
            text += &format!(
                "<p class=\"faint\">With the same version of embate and the same model it ends with the same bits, on any number of \
                 threads and on any machine: the state hash is <code>{}</code> again.</p>\n",
                escape(hash)
            );
        }
    }
    let mut rows = Vec::new();
    let mut add = |name: &str, value: Option<String>| rows.extend(value.map(|value| (name.to_string(), value)));
    add("model", Some(left.name()).filter(|name| *name != left.title()));
    add("embate", Some(format!("version {}", left.version())));
    add("ended", left.summary.as_ref().and(left.ended).map(date));
    add("state hash", left.text("state_hash").map(ToString::to_string));
    let threads = left.number("threads").map(|threads| format!("{threads:.0}"));
    add("threads, instruction set", threads.map(|threads| format!("{threads}, {}", left.text("simd").unwrap_or("unknown"))));
    if let (None, Some(time)) = (&left.summary, left.history.as_ref().and_then(|history| history.column("time")?.last())) {
        add("time reached by the history", Some(shown(*time, "s")));
    }
    text + &facts(&rows) + "</header>\n"
}

/// Day and time of UTC.
fn date(time: SystemTime) -> String {
    let seconds = time.duration_since(UNIX_EPOCH).map_or(0, |since| since.as_secs());
    let (days, of_day) = (seconds / 86_400, seconds % 86_400);
    // Days since 1 March of the year 0, in eras of 400 years: H. Hinnant, "chrono-compatible low-level date
    // algorithms".
    let shifted = days + 719_468;
    let (era, day) = (shifted / 146_097, shifted % 146_097);
    let year = (day - day / 1_460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let (day, month) = (day - (153 * month + 2) / 5 + 1, if month < 10 { month + 3 } else { month - 9 });
    let year = era * 400 + year + u64::from(month <= 2);
    format!("{year}-{month:02}-{day:02} {:02}:{:02} UTC", of_day / 3_600, of_day / 60 % 60)
}

/// The error of a failed run and its warnings.
pub(super) fn messages(left: &Left) -> String {
    let mut body = String::new();
    if let Some(error) = left.text("error") {
        body += &message(error, "message error");
        if let Some(page) = left.text("post_mortem") {
            body += &format!(
                "<p>The post-mortem, with the failure location and what to change, is beside the results: <code>{}</code>.</p>\n",
                escape(page)
            );
        }
    }
    let warnings = left.summary.as_ref().and_then(|summary| summary.get("warnings")?.as_array());
    for warning in warnings.into_iter().flatten().filter_map(Value::as_str) {
        body += &message(warning, "message");
    }
    if body.is_empty() && left.summary.is_some() {
        body = "<p>There are none.</p>\n".into();
    }
    section("Errors and warnings", &body)
}

/// A message and what the catalogue says of its code.
fn message(text: &str, class: &str) -> String {
    let known = entry(text).map_or(String::new(), |entry| {
        format!("<p class=\"faint\">{} (<code>embate explain {}</code>)</p>\n", escape(&line(entry)), entry.code)
    });
    format!("<div class=\"{class}\"><p>{}</p>\n{known}</div>\n", escape(text))
}

/// The entry of the first code in a text.
fn entry(text: &str) -> Option<&'static Message> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric()).filter(|word| word.len() == 5);
    let all = messages::all();
    words.into_iter().find_map(|word| all.iter().find(|entry| entry.code == word).copied())
}

fn line(entry: &Message) -> String {
    format!("{}: {} What to do: {}", entry.title, entry.cause, entry.remedy)
}

/// The figures of the summary.
pub(super) fn figures(left: &Left) -> String {
    let Some(summary) = &left.summary else { return String::new() };
    let mut rows: Vec<(String, String)> = Vec::new();
    let mut add = |name: &str, value: Option<String>| rows.extend(value.map(|value| (name.to_string(), value)));
    let number = |path: &str| summary.pointer(path).and_then(Value::as_f64);
    let si = |path: &str, si: &str| number(path).map(|value| shown(value, si));
    let count = |path: &str| number(path).map(|value| grouped(value as u64));
    let mass = if left.is_of_whole_bodies { "kg" } else { "kg/m" };
    add("time reached", si("/time_end", "s"));
    add("steps", count("/steps"));
    add("at rest", si("/rest", "s"));
    let stages = summary.get("stages").and_then(Value::as_array).into_iter().flatten();
    for stage in stages.filter_map(|stage| Stage::deserialize(stage).ok()) {
        let [name, when] = stage.row(|time| shown(time, "s"));
        add(&name, Some(when));
    }
    add("smallest step", si("/stable_time_step_min", "s"));
    add("which asked for it", left.text("stable_time_step_governor").filter(|text| !text.is_empty()).map(ToString::to_string));
    add("energy drift", number("/energy_drift").map(|drift| format!("{} %", shown(100.0 * drift, ""))));
    add("ledger residual", number("/ledger_residual").map(|value| format!("{value:.1e}")));
    let drift = |path: &str| number(path).map(|value| format!("{value:.1e}"));
    add("drift of linear momentum", drift("/momentum_drift/linear"));
    add("drift of angular momentum", drift("/momentum_drift/angular"));
    add("deepest penetration", si("/penetration_max", "m"));
    let pairs = number("/contact/pairs_swept").filter(|pairs| *pairs > 0.0);
    add(
        "contact certificate",
        pairs.and_then(|pairs| {
            let unverified = number("/contact/unverified")?;
            let verdict = if unverified == 0.0 {
                "none was missed".into()
            } else {
                format!("{unverified:.0} were inside a body without contact: see the warnings")
            };
            Some(format!(
                "{} pairs checked for crossing, {} crossings found; {verdict}",
                grouped(pairs as u64),
                grouped(number("/contact/crossings_found")? as u64)
            ))
        }),
    );
    add("mass added for longer steps", si("/mass_added", mass));
    add("elements made again", remeshed(summary));
    add("flow", flows(summary));
    add("eroded elements", eroded(summary));
    add("mass of loose nodes", si("/erosion/mass_loose", mass));
    add("wall time", si("/wall_seconds", "s"));
    add("speed", number("/element_steps_per_second").map(|speed| format!("{:.3} million elements × steps per second", 1e-6 * speed)));
    section("Figures of the run", &facts(&rows))
}

fn eroded(summary: &Value) -> Option<String> {
    let parts = summary.pointer("/erosion/elements")?.as_object()?;
    let reported: Vec<String> = parts.iter().map(|(part, count)| format!("{} of part \"{part}\"", count.as_u64().unwrap_or(0))).collect();
    Some(reported.join(", "))
}

/// How often elements were made again, and of which parts.
fn remeshed(summary: &Value) -> Option<String> {
    let events = summary.get("remeshings")?.as_array().filter(|events| !events.is_empty())?;
    let last = events.last()?;
    let time = shown(last.get("time")?.as_f64()?, "s");
    Some(format!("{} time(s), the last at {time}: {} elements", events.len(), last.pointer("/elements/1")?))
}

/// How far material has flowed through which parts, and since when this is steady.
fn flows(summary: &Value) -> Option<String> {
    let of = |flow: &Value| {
        let steady =
            flow.get("steady").and_then(Value::as_f64).map_or("not steady".into(), |time| format!("steady since {}", shown(time, "s")));
        Some(format!("part \"{}\" passed {:.2} time(s), {steady}", flow.get("part")?.as_str()?, flow.get("passages")?.as_f64()?))
    };
    let all: Vec<String> = summary.get("flows")?.as_array()?.iter().filter_map(of).collect();
    (!all.is_empty()).then(|| all.join("; "))
}

/// How the report was made.
pub(super) fn made(left: &Left) -> String {
    let body = format!(
        "<p class=\"faint\">Made by embate {} (<code>embate report</code>) from <code>{}</code>: summary.json, \
            run.json, history.csv and the pictures. Everything is in this one file; it loads nothing.</p>\n",
        program::named(program::VERSION, program::commit()),
        escape(&left.folder.to_string_lossy())
    );
    section("How this was made", &body)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn days_are_those_of_the_calendar() {
        let at = |seconds: u64| date(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01 00:00 UTC");
        assert_eq!(at(951_782_400), "2000-02-29 00:00 UTC");
        assert_eq!(at(1_735_689_599), "2024-12-31 23:59 UTC");
    }

    #[test]
    fn a_message_is_explained_by_its_code() {
        let reported = message("W0611: part \"<b>\": much", "message");
        assert!(reported.contains("part &quot;&lt;b&gt;&quot;") && reported.contains("embate explain W0611"), "{reported}");
        assert!(!message("W9999: unknown", "message").contains("explain"));
    }
}
