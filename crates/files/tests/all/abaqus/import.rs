//! Whole decks become models, and the report says what became of each keyword.

use embate_files::PathPolicy;
use embate_files::abaqus::import::{Imported, Outcome, Units, import, table_markdown};
use embate_files::model_file;
use embate_solver::error::Fault;
use embate_solver::mesh::Mesh;
use embate_solver::model::Model;
use embate_solver::simulation::{Options, Simulation};
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

fn here(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(file)
}

/// The import of a deck, written to a folder as the program does.
fn imported(name: &str, deck: &str, units: &str) -> Result<(Imported, PathBuf), Vec<Fault>> {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("import-{name}"));
    fs::create_dir_all(&folder).unwrap();
    fs::write(folder.join("deck.inp"), deck).unwrap();
    let imported = import(&folder.join("deck.inp"), &Units::parse(units).unwrap(), PathPolicy::Folder)?;
    fs::write(folder.join("mesh.inp"), &imported.mesh).unwrap();
    fs::write(folder.join("model.toml"), &imported.model).unwrap();
    Ok((imported, folder))
}

fn model(folder: &Path) -> Model {
    model_file::load(folder, &[]).unwrap_or_else(|diagnostics| panic!("{}", diagnostics.rendered))
}

/// Two squares, one above the other, with a gap; `more` follows.
fn deck(kind: &str, more: &str) -> String {
    let nodes = "*NODE\n1,0,0\n2,1,0\n3,1,1\n4,0,1\n5,0,1.5\n6,1,1.5\n7,1,2.5\n8,0,2.5\n";
    let elements = format!("*ELEMENT,TYPE={kind},ELSET=Low\n1,1,2,3,4\n*ELEMENT,TYPE={kind},ELSET=High\n2,5,6,7,8\n");
    let surfaces = "*SURFACE,NAME=top\nLow,S3\n*SURFACE,NAME=bottom\nHigh,S1\n*NSET,NSET=ground\n1,2\n";
    let material = "*MATERIAL,NAME=m\n*DENSITY\n1000.\n*ELASTIC\n1e9,0.3\n";
    let step = "*STEP\n*DYNAMIC,EXPLICIT\n,1e-3\n*BULK VISCOSITY\n0.,0.\n";
    let sections = "*SOLID SECTION,ELSET=Low,MATERIAL=M\n*SOLID SECTION,ELSET=HIGH,MATERIAL=m\n";
    format!("{nodes}{elements}{surfaces}{sections}{material}{step}{more}*END STEP\n")
}

#[test]
fn a_deck_becomes_a_model_and_a_report() {
    let text = fs::read_to_string(here("tests/abaqus/block.inp")).unwrap();
    let (imported, folder) = imported("block", &text, "mm,t,s").unwrap();
    for (name, made) in [("block.toml", &imported.model), ("block.txt", &imported.report.text())] {
        let path = here("tests/abaqus").join(name);
        if std::env::var_os("EMBATE_BLESS").is_some() {
            fs::write(&path, made).unwrap();
        }
        assert!(
            fs::read_to_string(&path).unwrap() == *made,
            "{name} is not what is made: run this test with EMBATE_BLESS=1 and look at it\n{made}"
        );
    }
    Simulation::new(&model(&folder), &Options::default()).unwrap();
    assert!(imported.report.has_ignored());
}

#[test]
fn every_keyword_stands_in_the_report() {
    let text = fs::read_to_string(here("tests/abaqus/block.inp")).unwrap();
    let (imported, _) = imported("all-keywords", &text, "mm,t,s").unwrap();
    for (number, line) in (1..).zip(text.lines()).filter(|(_, line)| line.starts_with('*') && !line.starts_with("**")) {
        let place = format!("deck.inp, line {number}");
        assert!(imported.report.entries.iter().any(|entry| entry.place == place), "{line} in line {number} is not told");
    }
}

#[test]
fn the_table_of_keywords_in_the_docs_is_the_one_of_the_program() {
    let page = here("../../docs/import.md");
    let text = fs::read_to_string(&page).unwrap();
    let made = table_markdown();
    if !text.contains(&made) && std::env::var_os("EMBATE_BLESS").is_some() {
        let start = text.find("| keyword |").unwrap();
        let end = text[start..].find("\n\n").map_or(text.len(), |end| start + end + 1);
        fs::write(&page, format!("{}{made}{}", &text[..start], &text[end..])).unwrap();
    }
    assert!(fs::read_to_string(&page).unwrap().contains(&made), "docs/import.md lacks the table: run this test with EMBATE_BLESS=1");
}

/// The example `two-bars` as a deck: its own nodes and elements, so that numbers agree to the last digit.
fn two_bars(example: &Model) -> String {
    let mesh = Mesh::<2>::new(example).unwrap();
    let mut nodes: Vec<(u32, [f64; 2])> = mesh.user_nodes.iter().copied().zip(mesh.positions.iter().copied()).collect();
    nodes.sort_by_key(|(user, _)| *user);
    let (mut deck, mut ends) = ("*NODE\n".to_string(), String::new());
    for (user, [x, y]) in nodes {
        writeln!(deck, "{}, {x:e}, {y:e}", user + 1).unwrap();
    }
    for (part, name) in ["left", "right"].iter().enumerate() {
        let mut cells: Vec<(u32, &[u32])> =
            mesh.groups_of(part).flat_map(|group| group.user_elements.iter().copied().zip(group.cells().map(|cell| cell.nodes))).collect();
        cells.sort_unstable();
        writeln!(deck, "*ELEMENT, TYPE=CPE4, ELSET={name}").unwrap();
        writeln!(ends, "*SURFACE, NAME=end of {name}").unwrap();
        for (user, cell) in cells {
            let meets = |corner: usize| mesh.positions[cell[corner % 4] as usize][0] == 0.0;
            if let Some(edge) = (0..4).find(|&edge| meets(edge) && meets(edge + 1)) {
                writeln!(ends, "{}, S{}", part as u32 * 400 + user + 1, edge + 1).unwrap();
            }
            let cell: Vec<String> = cell.iter().map(|node| (mesh.user_nodes[*node as usize] + 1).to_string()).collect();
            writeln!(deck, "{}, {}", part as u32 * 400 + user + 1, cell.join(", ")).unwrap();
        }
        writeln!(deck, "*NSET, NSET=all {name}, ELSET={name}\n*SOLID SECTION, ELSET={name}, MATERIAL=alloy").unwrap();
    }
    deck.push_str(&ends);
    deck.push_str(
        "*MATERIAL, NAME=alloy\n*DENSITY\n8000.\n*ELASTIC\n2.e11, 0.\n\
         *INITIAL CONDITIONS, TYPE=VELOCITY\nall left, 1, 4.\n\
         *STEP\n*DYNAMIC, EXPLICIT\n, 60e-6\n*BULK VISCOSITY\n0., 0.\n*CONTACT PAIR\nend of left, end of right\n*END STEP\n",
    );
    deck
}

#[test]
fn a_deck_of_two_bars_gives_what_the_model_written_by_hand_gives() {
    let example = model(&here("../../examples/two-bars"));
    let (imported, folder) = imported("two-bars", &two_bars(&example), "m,kg,s").unwrap();
    assert!(!imported.report.has_ignored(), "{}", imported.report.text());
    // Both number their nodes in their own ways: rows are distinguished by y, which hardly changes, and in a
    // row nodes keep their order.
    let row = |x: &[f64; 2]| (x[1] * 1e6).round() as i64;
    let [(steps, by_hand), (steps_imported, by_deck)] = [&example, &model(&folder)].map(|model| {
        let mut simulation = Simulation::new(model, &Options::default()).unwrap();
        simulation.advance(model.run.end, u64::MAX).unwrap();
        let mut positions = simulation.frame().positions::<2>().to_vec();
        positions.sort_by(|a, b| row(a).cmp(&row(b)).then(a[0].total_cmp(&b[0])));
        (simulation.steps(), positions)
    });
    assert_eq!(steps, steps_imported);
    assert_eq!(by_hand.len(), by_deck.len());
    let worst = by_hand.iter().zip(&by_deck).flat_map(|(a, b)| [(a[0] - b[0]).abs(), (a[1] - b[1]).abs()]).fold(0.0, f64::max);
    assert!(worst <= 1e-12 * 0.2, "{worst:e} m apart");
}

#[test]
fn contact_of_all_bodies_ties_and_pairs_become_contacts() {
    let interaction = "*SURFACE INTERACTION,NAME=i\n*FRICTION,TAUMAX=1e6\n0.3\n*SURFACE BEHAVIOR,PRESSURE-OVERCLOSURE=TABULAR\n0.,-1e-3\n1e6,0.\n4e6,1e-3\n";
    let all = format!("{interaction}*CONTACT\n*CONTACT INCLUSIONS,ALL EXTERIOR\n*CONTACT PROPERTY ASSIGNMENT\n,,i\n");
    let (made, folder) = imported("contact-all", &deck("CPE4", &all), "m,kg,s").unwrap();
    assert!(!made.report.has_ignored(), "{}", made.report.text());
    assert!(
        made.model.contains("bodies = \"all\"") && made.model.contains("gaps = [-0.001, 0, 0.001]\npressures = [4000000, 1000000, 0]"),
        "{}",
        made.model
    );
    model(&folder);
    let (made, folder) = imported("contact-pair", &deck("CPE4", "*CONTACT PAIR,TYPE=NODE TO SURFACE\nTOP,bottom\n"), "m,kg,s").unwrap();
    assert!(made.model.contains("between = [\"top\", \"bottom\"]") && made.model.contains("slave = \"top\""), "{}", made.model);
    model(&folder);
    let (made, folder) = imported("tie", &deck("CPE4", "*TIE,NAME=t\ntop,bottom\n"), "m,kg,s").unwrap();
    assert!(made.model.contains("tied = true"), "{}", made.model);
    model(&folder);
}

#[test]
fn conditions_and_loads_keep_their_sizes_and_units() {
    let more = "*AMPLITUDE,NAME=a,DEFINITION=SMOOTH STEP\n0.,0.,1e-3,2.\n*BOUNDARY\nground,PINNED\n*BOUNDARY,AMPLITUDE=A\n7,2,2,-3.\n*CLOAD\nground,1,5.\n";
    let (made, folder) = imported("conditions", &deck("CPS4", more), "mm,t,s").unwrap();
    assert!(!made.report.has_ignored(), "{}", made.report.text());
    for text in [
        "on = \"ground\"\nfixed = [\"x\", \"y\"]",
        "on = \"embate-node-7\"\ndisplacement = { y = \"a\" }",
        "value = [\"0 mm\", \"-6 mm\"]\nbetween = \"smooth_steps\"",
        "force = [\"10 N/mm\", \"0 N/mm\"]",
        "stress_state = \"plane_stress\"",
        "young = \"1e9 MPa\"",
        "scale = \"1 mm\"",
    ] {
        assert!(made.model.contains(text), "lacks {text}\n{}", made.model);
    }
    model(&folder);
    let (made, folder) = imported("round", &deck("CAX4", "*CLOAD\nground,2,5.\n"), "mm,t,s").unwrap();
    assert!(made.model.contains("force = [0, 10]"), "{}", made.model);
    model(&folder);
}

#[test]
fn tables_and_rubber_get_their_laws() {
    let with = |from: &str, to: &str| imported("laws", &deck("CPE4", "").replace(from, to), "m,kg,s").unwrap().0;
    let table = with("1e9,0.3\n", "1e9,0.3\n*PLASTIC\n1e6,0.\n2e6,0.1\n2.5e6,0.3\n");
    assert!(
        table.model.contains("law = \"j2_table\"")
            && table.model.contains("plastic_strain = [0, 0.1, 0.3]\nstress = [1000000, 2000000, 2500000]"),
        "{}",
        table.model
    );
    let line = with("1e9,0.3\n", "1e9,0.3\n*PLASTIC\n1e6,0.\n2e6,0.1\n");
    assert!(line.model.contains("yield = 1000000\nhardening = 1e7"), "{}", line.model);
    assert!(
        line.report
            .entries
            .iter()
            .any(|entry| entry.outcome == Outcome::Approximated && entry.text.contains("beyond the plastic strain 0.1"))
    );
    let mooney = with("*ELASTIC\n1e9,0.3\n", "*HYPERELASTIC,MOONEY-RIVLIN\n3e5,1e5,1e-7\n");
    assert!(mooney.model.contains("law = \"mooney_rivlin\"\nc10 = 300000\nc01 = 100000\nbulk = 2e7"), "{}", mooney.model);
    let neo = with("*ELASTIC\n1e9,0.3\n", "*HYPERELASTIC,NEO HOOKE\n5e5,0.\n");
    assert!(neo.model.contains("law = \"neo_hookean\"\nyoung = 2950819.67"), "{}", neo.model);
}

#[test]
fn what_would_make_another_model_is_refused_with_its_line() {
    for (more, message) in [
        ("*EQUATION\n2\n1,1,1.,2,1,-1.\n", "*EQUATION has no counterpart"),
        ("*MPC\nTIE,1,2\n", "*MPC has no counterpart"),
        ("*TRANSFORM,NSET=ground\n1,0,0,0,1,0\n", "*TRANSFORM has no counterpart"),
        ("*CONTACT PAIR\nside,bottom\n", "there is no surface \"side\""),
        ("*SOLID SECTION,ELSET=Low,MATERIAL=m\n", "element 1 has two sections"),
        ("*DLOAD\nLow,P9,1.\n", "an element CPE4 has no edge \"P9\""),
        ("*CLOAD\nnothing,1,1.\n", "there is no node set \"nothing\""),
    ] {
        let faults = imported("refused", &deck("CPE4", more), "m,kg,s").unwrap_err();
        assert!(faults[0].message.starts_with(message) && faults[0].path.contains("line") && !faults[0].help.is_empty(), "{}", faults[0]);
    }
    for (from, to, message) in [
        ("*DYNAMIC,EXPLICIT\n,1e-3\n", "*STATIC\n1.\n", "the deck has no *DYNAMIC step"),
        ("*DENSITY\n1000.\n", "", "material \"m\" has no density"),
        ("*ELASTIC\n1e9,0.3\n", "", "material \"m\" has neither"),
        ("MATERIAL=M", "MATERIAL=q", "there is no material \"Q\""),
    ] {
        let faults = imported("lacking", &deck("CPE4", "").replace(from, to), "m,kg,s").unwrap_err();
        assert!(faults[0].message.starts_with(message) && !faults[0].help.is_empty(), "{}", faults[0]);
    }
}

#[test]
fn what_does_not_act_is_reported() {
    for (more, text) in [
        ("*FOO,BAR=1\n2.\n", "embate has no counterpart of this keyword"),
        ("*BOUNDARY\n7,1,1,0.5\n", "a displacement that jumps at the start"),
        ("*BOUNDARY,TYPE=VELOCITY,AMPLITUDE=none\n7,1,1,0.5\n", "there is no amplitude NONE"),
        ("*CLOAD,FOLLOWER\n7,1,1.\n", "the parameter FOLLOWER is not read"),
        ("*INITIAL CONDITIONS,TYPE=VELOCITY\n1,1,3.\n", "its nodes don't begin with one velocity"),
        ("*DLOAD\nLow,CENTRIF,1.,0.,0.,0.,0.,0.,1.\n", "a load CENTRIF has no counterpart"),
        ("*CONTACT PAIR\ntop\n", "contact of one surface with itself"),
        ("*END STEP\n*STEP\n*DYNAMIC,EXPLICIT\n,1.\n", "a second step; the run ends with the first"),
        ("*ELEMENT,TYPE=SPRINGA,ELSET=s\n9,1,2\n", "1 elements of the set S of the type SPRINGA"),
        ("*ELEMENT,TYPE=CPE3,ELSET=s\n9,1,2,3\n", "1 elements have no section"),
        ("*MATERIAL,NAME=n\n", "no section has the material n"),
    ] {
        let (made, folder) = imported("ignored", &deck("CPE4", more), "m,kg,s").unwrap();
        let reported = made.report.entries.iter().any(|entry| entry.outcome == Outcome::Ignored && entry.text.contains(text));
        assert!(reported, "{more}: {}", made.report.text());
        model(&folder);
    }
}

#[test]
fn a_deck_as_preprocessors_write_it_is_imported_without_loss() {
    let deck = "*Heading
** Job name: t Model name: Model-1
*Preprint, echo=NO, model=NO, history=NO, contact=NO
*Part, name=\"Part 1\"
*Node
      1,           0.,           0.
      2,           1.,           0.
      3,           1.,           1.
      4,           0.,           1.
*Element, type=CPE4R
1, 1, 2, 3, 4
*Nset, nset=Set-1, generate
 1,  4,  1
*Elset, elset=Set-1
 1,
*Solid Section, elset=Set-1, controls=EC-1, material=Material-1
,
*End Part
*Assembly, name=Assembly
*Instance, name=\"Part 1-1\", part=\"Part 1\"
*End Instance
*Nset, nset=fix, instance=\"Part 1-1\"
 1, 2
*Elset, elset=_S_S3, internal, instance=\"Part 1-1\"
 1,
*Surface, type=ELEMENT, name=Surf
_S_S3, S3
*End Assembly
*Section Controls, name=EC-1, hourglass=ENHANCED
1., 1., 1.
*Material, name=Material-1
*Density
 7.8e-09,
*Elastic
210000., 0.3
*Surface Interaction, name=IntProp-1
*Friction
0.,
*Boundary
fix, ENCASTRE
*Step, name=Step-1, nlgeom=YES
*Dynamic, Explicit
, 0.001
*Bulk Viscosity
0.06, 1.2
*Dsload
Surf, P, 10.
*Contact, op=NEW
*Contact Inclusions, ALL EXTERIOR
*Contact Property Assignment
 ,  , IntProp-1
*Restart, write, number interval=1, time marks=NO
*Output, field, variable=PRESELECT
*Output, history, variable=PRESELECT
*End Step
";
    let (made, folder) = imported("preprocessor", deck, "mm,t,s").unwrap();
    assert!(!made.report.has_ignored(), "{}", made.report.text());
    assert!(made.model.contains("name = \"Part_1-1_Set-1\"") && made.model.contains("group = \"Part 1-1.Set-1\""), "{}", made.model);
    Simulation::new(&model(&folder), &Options::default()).unwrap();
}

#[test]
fn materials_say_in_which_units_a_deck_is() {
    let told = |name: &str, numbers: &str, units: &str| {
        let text = deck("CPE4R", "").replace("1000.\n*ELASTIC\n1e9", numbers);
        imported(name, &text, units).unwrap().0.report.text()
    };
    let steel = "7.85e-9\n*ELASTIC\n2.1e5";
    for (units, is_told) in [("m,kg,s", true), ("mm,t,s", false), ("s,mm,t", false), ("mm,kg,ms", true)] {
        let text = told("units", steel, units);
        assert_eq!(text.contains("in mm, t, s: a density of 7.85e-9") && text.contains("--units \"mm,t,s\""), is_told, "{units}: {text}");
    }
    let text = told("inches", "7.35e-4\n*ELASTIC\n3e7", "m,kg,s");
    assert!(text.contains("--units \"in,lbf s^2/in,s\""), "{text}");
    assert!(!told("inches", "7.35e-4\n*ELASTIC\n3e7", "in,lbf s^2/in,s").contains("--units"));
    assert!(told("si", "1000.\n*ELASTIC\n1e9", "mm,t,s").contains("--units \"m,kg,s\""));
    assert!(!told("si", "1000.\n*ELASTIC\n1e9", "m,kg,s").contains("materials"));
    assert!(told("none", "7850.\n*ELASTIC\n210.", "m,kg,s").contains("in no system of units"));
}

#[test]
fn values_behind_those_that_are_read_are_reported() {
    let text = deck("CPE4R", "*CLOAD\n3,2,10.,7\n*BOUNDARY\n1,1,2,0.,5\n").replace("1000.\n", "1000., 20.\n");
    let report = imported("behind", &text, "m,kg,s").unwrap().0.report;
    for keyword in ["CLOAD", "BOUNDARY", "DENSITY"] {
        let is_said = |entry: &&embate_files::abaqus::import::Entry| {
            entry.outcome == Outcome::Ignored && entry.text.contains("further values do not act")
        };
        assert_eq!(
            report.entries.iter().filter(|entry| entry.keyword == keyword).filter(is_said).count(),
            1,
            "{keyword}: {}",
            report.text()
        );
    }
    // An empty end is none.
    let text = deck("CPE4R", "").replace("1000.\n", "1000.,\n");
    assert!(!imported("behind", &text, "m,kg,s").unwrap().0.report.has_ignored());
}
