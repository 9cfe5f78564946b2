//! Random damage: whatever happens to a file's bytes, the reader answers with a mesh or with faults.

use super::bytes;
use embate_files::gmsh::parse;
use proptest::prelude::*;

const FILES: [&str; 14] = [
    "plate-v2-text",
    "plate-v2-binary",
    "plate-v2-binary-big",
    "plate-v4-text",
    "plate-v4-binary",
    "plate-v4-binary-big",
    "plate-parametric-v2-binary",
    "plate-parametric-v4-binary",
    "plate-partitioned-v4-text",
    "plate-partitioned-v4-binary",
    "plate-without-groups-v2-text",
    "plate-without-groups-v4-binary",
    "plate-order-2",
    "cube",
];

/// A mesh that came out of a damaged file still refers to its own nodes only; a file with faults has at most
/// twenty of a kind.
fn check(bytes: &[u8]) {
    match parse(bytes, "m.msh", 1.0) {
        Ok(mesh) => {
            let nodes = mesh.positions.len();
            assert!(mesh.groups.iter().flat_map(|group| &group.cells).flatten().all(|&node| (node as usize) < nodes));
            assert!(mesh.positions.iter().flatten().all(|x| x.is_finite()));
        }
        Err(faults) => assert!(!faults.is_empty() && faults.len() < 300),
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 400, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn flipped_bytes_never_panic(file in 0..FILES.len(), flips in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..6)) {
        let mut bytes = bytes(FILES[file]);
        for (place, value) in flips {
            let at = place.index(bytes.len());
            bytes[at] = value;
        }
        check(&bytes);
    }

    #[test]
    fn swapped_words_of_a_text_never_panic(file in 0..FILES.len(), from in any::<prop::sample::Index>(), to in any::<prop::sample::Index>()) {
        let bytes = bytes(FILES[file]);
        let mut words: Vec<&[u8]> = bytes.split_inclusive(u8::is_ascii_whitespace).collect();
        let (a, b) = (from.index(words.len()), to.index(words.len()));
        words.swap(a, b);
        check(&words.concat());
    }

    #[test]
    fn cut_files_never_panic(file in 0..FILES.len(), end in any::<prop::sample::Index>()) {
        let bytes = bytes(FILES[file]);
        check(&bytes[..end.index(bytes.len())]);
    }
}

#[test]
fn a_file_cut_anywhere_before_its_last_section_ends_is_a_fault() {
    for name in FILES {
        let whole = bytes(name);
        let mark = b"$EndElements";
        let end = whole.windows(mark.len()).position(|window| window == mark).unwrap();
        for length in (0..end + mark.len()).step_by(7) {
            assert!(parse(&whole[..length], "m.msh", 1.0).is_err(), "{name} cut after {length} bytes");
        }
    }
}
