//! The page of elements, laws and fields: made from the registries and from the models of the repository.

use embate_files::registries::{Entry, Registry, markdown, registries};
use std::fs;
use std::path::{Path, PathBuf};

fn project() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// A folder of examples or cases: its link from a page in `docs`, and the text of its files.
fn models() -> Vec<(String, String)> {
    let mut all = Vec::new();
    for above in ["examples", "verification"] {
        let mut folders: Vec<_> =
            fs::read_dir(project().join(above)).unwrap().map(|entry| entry.unwrap().path()).filter(|path| path.is_dir()).collect();
        folders.sort();
        for folder in folders {
            let mut files: Vec<_> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
            files.retain(|path| path.extension().is_some_and(|kind| kind == "toml"));
            files.sort();
            let name = folder.file_name().unwrap().to_str().unwrap();
            let text = files.iter().map(|path| fs::read_to_string(path).unwrap()).collect::<Vec<_>>().join("\n");
            all.push((format!("[{name}](../{above}/{name}/README.md)"), text));
        }
    }
    all
}

/// Whether a text has `key = "name"`, as in a model, or `key=name`, as in the overrides of a case.
fn names(text: &str, key: &str, name: &str) -> bool {
    text.match_indices(name).any(|(at, _)| {
        let before = text[..at].trim_end_matches(['"', '\\', '\'']).trim_end();
        let after = text[at + name.len()..].chars().next();
        let ends = after.is_none_or(|letter| !letter.is_alphanumeric() && letter != '_');
        let key_before = before.strip_suffix('=').map(|before| before.trim_end().ends_with(key));
        ends && key_before.unwrap_or(false)
    })
}

#[test]
fn the_page_of_elements_and_laws_is_the_one_that_the_registries_make() {
    let models = models();
    let uses = |registry: &Registry, entry: &Entry| {
        let named = |key: &str, text: &str| match registry.name {
            // A criterion is a key of its own.
            "failure" => text.lines().any(|line| line.contains("failure") && line.contains(&format!("{} =", entry.name))),
            _ => names(text, key.rsplit('.').next().unwrap(), entry.name),
        };
        models.iter().filter(|(_, text)| registry.keys.iter().any(|key| named(key, text))).map(|(link, _)| link.clone()).collect()
    };
    let path = project().join("docs/elements-and-laws.md");
    let made = markdown(&uses);
    if std::env::var_os("EMBATE_BLESS").is_some() {
        fs::write(&path, &made).unwrap();
    }
    let kept = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    assert!(
        kept == made,
        "docs/elements-and-laws.md is not what the registries make: run this test with EMBATE_BLESS=1 and commit the file"
    );
}

#[test]
fn names_are_found_as_models_write_them() {
    assert!(names("law = \"j2\", density", "law", "j2"));
    assert!(names("set = [\"part.bar.element=quad4\"]", "element", "quad4"));
    assert!(names("set = [\"part.bar.element=\\\"quad4\\\"\"]", "element", "quad4"));
    assert!(!names("law = \"j2_table\"", "law", "j2"));
    assert!(!names("name = \"j2\"", "law", "j2"));
}

#[test]
fn every_element_law_and_equation_is_used_by_a_model_of_the_repository() {
    let models = models();
    // What the default is need not be named.
    let unnamed: Vec<String> = registries()
        .iter()
        .filter(|registry| {
            ["elements", "stress-states", "materials", "equations-of-state", "formulations", "laws"].contains(&registry.name)
        })
        .flat_map(|registry| registry.entries.iter().filter(|entry| !entry.default).map(move |entry| (registry, entry)))
        .filter(|(registry, entry)| {
            !models.iter().any(|(_, text)| registry.keys.iter().any(|key| names(text, key.rsplit('.').next().unwrap(), entry.name)))
        })
        .map(|(registry, entry)| format!("{} {}", registry.title, entry.name))
        .collect();
    assert_eq!(unnamed, Vec::<String>::new(), "no example and no verification case uses them");
}
