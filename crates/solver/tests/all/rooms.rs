//! Which room of the library imports which: one that stands above in `lib.rs` imports none that stands below
//! it, but for those that are listed here. And kernels without closures.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Rooms that still import one below them, and how many of their files do. The list only shrinks.
const UPWARD: &[(&str, &str, usize)] = &[
    // A shape is one file: its parameters are data of the model, its mesh is made beside them.
    ("model", "mesh", 1),
];

/// The modules of `lib.rs`, in their order.
fn rooms(source: &Path) -> Vec<String> {
    let library = fs::read_to_string(source.join("lib.rs")).unwrap();
    let declared = library.lines().filter_map(|line| line.trim_start_matches("pub ").strip_prefix("mod ")?.strip_suffix(';'));
    declared.map(String::from).collect()
}

/// The files of a folder and those below it.
fn files(folder: &Path, found: &mut Vec<PathBuf>) {
    for path in fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        if path.is_dir() {
            files(&path, found);
        } else {
            found.push(path);
        }
    }
}

/// What a text imports from the library by `crate::name` and `crate::{name, ...}`, without its comments and
/// its tests.
fn imports(text: &str) -> BTreeSet<String> {
    let text = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default();
    let lines: Vec<&str> = text.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let text = lines.join("\n");
    let word = |text: &str| text.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect::<String>();
    let mut found = BTreeSet::new();
    for after in text.split("crate::").skip(1) {
        let Some(list) = after.strip_prefix('{') else {
            found.insert(word(after));
            continue;
        };
        // Names at the first level of braces.
        let mut depth = 0;
        let mut names = String::new();
        for c in list.chars() {
            depth += i32::from(c == '{') - i32::from(c == '}');
            if depth < 0 {
                break;
            }
            if depth == 0 {
                names.push(c);
            }
        }
        found.extend(names.split(',').map(|name| word(name.trim())));
    }
    found
}

#[test]
fn rooms_import_what_stands_above_them() {
    assert_eq!(
        imports("use crate::{a, b::{c, d}, e::f}; // crate::no\nlet x = crate::g::h;\n#[cfg(test)]\nmod tests { use crate::no; }"),
        ["a", "b", "e", "g"].map(String::from).into()
    );
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let rooms = rooms(&source);
    let place = |room: &str| rooms.iter().position(|other| other == room);
    let mut all = Vec::new();
    files(&source, &mut all);
    let mut upward = BTreeMap::<(String, String), usize>::new();
    for path in all {
        let inside = path.strip_prefix(&source).unwrap();
        let first = inside.components().next().unwrap().as_os_str().to_str().unwrap();
        let name = path.file_name().unwrap().to_str().unwrap();
        let is_test = name.ends_with("tests.rs") || inside.components().any(|part| part.as_os_str() == "tests");
        let room = first.trim_end_matches(".rs");
        let Some(own) = place(room).filter(|_| !is_test) else { continue };
        for other in imports(&fs::read_to_string(&path).unwrap()) {
            if place(&other).is_some_and(|other| other > own) {
                *upward.entry((room.into(), other)).or_default() += 1;
            }
        }
    }
    let listed = UPWARD.iter().map(|(room, other, count)| ((room.to_string(), other.to_string()), *count)).collect::<BTreeMap<_, _>>();
    assert_eq!(upward, listed, "a room imports one that stands below it in lib.rs, or fewer do and the list here is too long");
}

/// Whether a line has a closure with parameters: a bar behind an opening parenthesis, a comma or an equals
/// sign, and another one. Operators stand behind values.
fn has_closure(line: &str) -> bool {
    let code = line.split("//").next().unwrap_or_default().replace("||", "");
    code.match_indices('|').any(|(at, _)| {
        let before = code[..at].trim_end_matches("move ").trim_end();
        before.ends_with(['(', ',', '=']) && code[at + 1..].contains('|')
    })
}

/// Functions of a text that are compiled for lanes and have closures, with their lines.
fn closures_of_lanes(text: &str) -> Vec<(usize, String)> {
    let lines: Vec<&str> = text.split("#[cfg(test)]\nmod tests {").next().unwrap_or_default().lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let indent = line.len() - line.trim_start().len();
        let is_inlined = lines[at.saturating_sub(3)..at].iter().any(|line| line.trim() == "#[inline(always)]");
        let Some((_, name)) = line.split_once("fn ").filter(|_| is_inlined) else { continue };
        let Some(head) = lines[at..].iter().position(|line| line.ends_with(['{', ';', '}'])) else { continue };
        if !lines[at..=at + head].concat().contains("L: Lane") || !lines[at + head].ends_with('{') {
            continue;
        }
        let end = format!("{}}}", " ".repeat(indent));
        let body = lines.iter().enumerate().skip(at + head + 1).take_while(|(_, line)| **line != end);
        let name: String = name.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
        found.extend(body.filter(|(_, line)| has_closure(line)).map(|(at, _)| (at + 1, name.clone())));
    }
    found
}

#[test]
fn kernels_have_no_closures() {
    assert!(has_closure("let own = |k: usize| a[k];") && has_closure("(0..D).for_each(|d| a[d] = b[d]);") && has_closure("f(move |x| x)"));
    assert!(!has_closure("let is_far = above | below | beside;") && !has_closure("if a || b {") && !has_closure("f(|| 1) // |x|"));
    let text = "#[inline(always)]\nfn f<L: Lane>(a: [L; 2]) -> [L; 2] {\n    a.map(|a| a + a)\n}\n";
    assert_eq!(closures_of_lanes(text), [(3, "f".to_string())]);
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut all = Vec::new();
    for room in ["block", "element", "material", "contact/springs"] {
        files(&source.join(room), &mut all);
    }
    // Those that handle springs one by one, and tests.
    let apart = ["contact/springs/sweep.rs: run", "contact/springs/friction/lanes.rs: run"];
    let mut found = Vec::new();
    for path in all {
        let name = path.strip_prefix(&source).unwrap().to_str().unwrap().replace('\\', "/");
        for (line, function) in closures_of_lanes(&fs::read_to_string(&path).unwrap()) {
            if !apart.contains(&format!("{name}: {function}").as_str()) {
                found.push(format!("{name}:{line}, {function}"));
            }
        }
    }
    assert!(
        found.is_empty(),
        "closures are compiled without the instruction set of the lanes around them, so each operation is a call; write a loop or a function: {found:?}"
    );
}
