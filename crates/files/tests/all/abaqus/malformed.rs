//! Malformed decks, made from a good one by one change each: every one gets its message at its line. And
//! damage at random: no panic.

use super::{FLAT, read};
use embate_files::abaqus::parse;
use proptest::prelude::*;
use std::path::Path;

/// What is changed to what, the line, and how message and remedy begin.
type Case = (&'static str, &'static str, u32, &'static str, &'static str);

#[rustfmt::skip]
const CASES: &[Case] = &[
    ("*HEADING\n", "", 1, "this is not an Abaqus or CalculiX deck", "the first line of a deck is a keyword"),
    ("** a comment", "*", 3, "a keyword line without a keyword", "a comment begins"),
    ("** a comment", "*INCLUDE", 3, "*INCLUDE names no file", "write *INCLUDE, INPUT=file.inp"),
    ("** a comment", "*INCLUDE, INPUT=nowhere.inp", 3, "the file \"nowhere.inp\" can't be read", "paths begin at"),
    ("** a comment", "*NGEN", 3, "*NGEN makes or moves nodes", "write the mesh with all its nodes"),
    ("** a comment", "*INSTANCE, NAME=a, PART=b\n*END INSTANCE", 3, "there is no part \"b\"", "name a *PART"),
    ("** a comment", "*PART, NAME=a\n*PART, NAME=b", 4, "*PART inside of a part", "end the one before"),
    ("** a comment", "*PART", 3, "*PART has no name", "add NAME"),
    ("*Node, NSET=all nodes", "*NODE, SYSTEM=C", 4, "coordinates that are not rectangular", "write x and y"),
    (" 4, 0, 1\n", " 3, 0, 1\n", 8, "a second node with the number 3", "remove one"),
    (" 4, 0, 1\n", " -4, 0, 1\n", 8, "the number of a node is \"-4\"", "numbers of nodes"),
    (" 4, 0, 1\n", " 0, 0, 1\n", 8, "the number of a node is \"0\"", "numbers of nodes"),
    (" 4, 0, 1\n", " four, 0, 1\n", 8, "the number of a node is \"four\"", "numbers of nodes"),
    (" 4, 0, 1\n", " 4, 0, one\n", 8, "y of a node is \"one\", not a number", "write numbers"),
    (" 4, 0, 1\n", " 4, 0, 1e999\n", 8, "y of a node is \"1e999\", not a number", "write numbers"),
    (" 4, 0, 1\n", " 4, 0, nan\n", 8, "y of a node is \"nan\", not a number", "write numbers"),
    (" 4, 0, 1\n", " 4, 0, 1, 0.5\n", 8, "node 4 is at z = 5e-1, off the plane", "bodies lie in the plane"),
    (" 4, 0, 1\n", " 99999999999999999999, 0, 1\n", 8, "the number of a node is \"99999999999999999999\"", "numbers of nodes"),
    ("type=cpe4r", "typ=cpe4r", 13, "*ELEMENT has no type", "add TYPE"),
    ("type=cpe4r", "type=S8R", 13, "element type S8R is of second order", "use elements with nodes at their corners"),
    ("type=cpe4r", "type=C3D27R", 13, "element type C3D27R is of second order", "use elements with nodes at their corners"),
    ("type=cpe4r", "type=R3D4", 13, "element type R3D4 is a continuum shell or a rigid surface", "take S4R"),
    ("type=cpe4r", "type=C3D4", 18, "element type CPE3 is one of 2D, beside bodies in 3D", "bodies are all in 2D"),
    ("type=cpe4r", "type=ABC", 13, "element type ABC is not known", "use elements"),
    (" 2, 2, 3, 6, 5\n", " 2, 2, 3, 6\n", 17, "an element CPE4R of 4 numbers", "look at the type"),
    (" 2, 2, 3, 6, 5\n", " 2, 2, 3, 6, 5, 1\n", 17, "an element CPE4R of 6 numbers", "look at the type"),
    (" 2, 2, 3, 6, 5\n", " 1, 2, 3, 6, 5\n", 17, "a second element with the number 1", "remove one"),
    (" 2, 2, 3, 6, 5\n", " 2, 2, 3, 6, 50\n", 17, "element 2 needs node 50, which is not there", "each part has its own"),
    (" 2, 2, 3, 6, 5\n", " 2, 2, 3, 6, 6\n", 17, "element 2 has node 6 twice", "a triangle is"),
    ("*elset, elset=everything", "*elset", 22, "*ELSET has no name", "add ELSET"),
    (" SQUARES, 3\n", " SQUARES, 4\n", 23, "there is no element 4", "look for the number"),
    (" SQUARES, 3\n", " RINGS, 3\n", 23, "there is no element set \"RINGS\"", "name a set that is defined above"),
    (" 1, 4,\n", " 1, 44,\n", 25, "there is no node 44", "look for the number"),
    (" 1, 4,\n", " right,\n", 25, "there is no node set \"right\"", "name a set"),
    (" 2, 6, 2\n", " 2\n", 29, "the last number is missing", "numbers of nodes"),
    (" SQUARES, S3\n", " SQUARES, S5\n", 32, "an element CPE4R has no edge \"S5\"", "its edges are S1 to S4"),
    (" SQUARES, S3\n", " SQUARES, E1\n", 32, "an element CPE4R has no edge \"E1\"", "its edges are S1 to S4"),
    ("NAME=outside", "NAME=Top", 33, "a second surface \"Top\"", "give it another name"),
    ("*SURFACE, NAME=outside", "*SURFACE", 33, "*SURFACE has no name", "add NAME"),
    (" LINE, 1., 0.\n", " LINE, 1.\n", 39, "a coordinate of a segment is missing", "give a number"),
];

#[test]
fn every_malformed_deck_gets_its_message_at_its_line() {
    let mut wrong = Vec::new();
    for (from, to, line, message, help) in CASES {
        assert_eq!(FLAT.matches(from).count(), 1, "{from:?}");
        match read(&FLAT.replace(from, to)) {
            Ok(_) => wrong.push(format!("{from:?} -> {to:?}: read without a fault")),
            Err(faults) => {
                let first = &faults[0];
                if first.path != format!("d.inp, line {line}") || !first.message.starts_with(message) || !first.help.starts_with(help) {
                    wrong.push(format!("{from:?} -> {to:?}\n    {first}\n    expected line {line}: {message} ({help}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn what_is_no_text_is_refused() {
    let faults = parse(b"\0\x01\x02", "d.inp", Path::new(""), 1.0).unwrap_err();
    assert!(faults[0].message.contains("not a text"), "{}", faults[0]);
    assert!(read("").is_err());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn damage_makes_faults_or_another_mesh_but_no_panic(changes in prop::collection::vec((0..FLAT.len(), any::<u8>()), 1..6), cut in 0..FLAT.len()) {
        let mut bytes = FLAT.as_bytes().to_vec();
        for (at, byte) in changes {
            bytes[at] = byte;
        }
        let _ = parse(&bytes, "d.inp", Path::new(""), 1.0);
        let _ = parse(&bytes[..cut], "d.inp", Path::new(""), 1.0);
    }

    #[test]
    fn words_of_decks_in_any_order_make_no_panic(words in prop::collection::vec(prop::sample::select(vec![
        "*NODE", "*ELEMENT", ", TYPE=CPE4", ", TYPE=CPE3", ", TYPE=C3D4", "*NSET", ", NSET=A", "*ELSET", ", ELSET=A", ", GENERATE", "*SURFACE", ", NAME=A", ", TYPE=NODE",
        "\n", "\n", "\n", "1", "2", "3", ", ", ", ", ", ", "A", "S1", "*PART", "*END PART", "*INSTANCE", ", PART=A", "*END INSTANCE", "\"", "=", "0.5", "A.1", "**",
    ]), 0..60)) {
        let _ = read(&words.concat());
    }
}
