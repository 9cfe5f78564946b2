//! The stable step by the frequency of the assembled mesh: against true frequencies, found by differences of
//! forces and all eigenvalues, at the start and while bodies deform; stable in runs, with equal bits.

use crate::bodies::*;
use crate::long::samples;
use crate::nodal_bound::crooked;
use crate::patches::{Body, Patch, Spread, every_pair, frequency_squared, material, patch, room, stiffness};
use crate::{blocks, solids};
use embate_solver::block::{BlockInput, Blocks};
use embate_solver::element::{ELEMENTS, ELEMENTS_OF_SPACE, ElementKind};
use embate_solver::model::*;
use embate_solver::simulation::{Options, Simulation};
use embate_solver::stress_state::STRESS_STATES;
use embate_solver::tensor::Dim;
use std::sync::Arc;

/// A model of one free body of the patch.
fn body_of<const D: usize>(element: &ElementKind, material: Material, patch: &Patch<D>) -> Model {
    let positions = patch.positions.iter().map(|x| std::array::from_fn(|d| x.get(d).copied().unwrap_or(0.0))).collect();
    let cells = patch.connectivity.chunks(element.nodes()).map(<[u32]>::to_vec);
    let mesh = ImportedMesh { source: "test".into(), positions, groups: vec![group("body", D as u8, cells)], ..ImportedMesh::default() };
    // So far away that steps are not rounded to meet it.
    let mut model = model(1e6);
    model.materials.insert("m".into(), material);
    model.meshes.push(Arc::new(mesh));
    let mut part =
        Part { name: "body".into(), material: "m".into(), shape: Shape::Group { mesh: 0, group: "body".into() }, ..Part::default() };
    let key = if element.is_triangle() { &mut part.element_triangles } else { &mut part.element };
    *key = element.name.into();
    model.parts.push(part);
    (model.run.stable_step, model.run.safety) = (StableStep::Assembled, 1.0);
    model
}

fn start(model: &Model) -> Simulation {
    Simulation::new(model, &Options { threads: 1, simd: None }).unwrap()
}

/// Moves all nodes, those of the rim too.
fn shake<const D: usize>(patch: &mut Patch<D>, size: f64, numbers: &mut Spread) {
    patch.positions.iter_mut().flatten().for_each(|x| *x += size * numbers.between(-1.0, 1.0));
}

/// The first step over the true limit 2/ω, and the step by nodes over it.
fn first<const D: usize>(element: &ElementKind, state: &str, material: &Material, patch: &Patch<D>) -> [f64; 2]
where
    Dim<D>: Blocks<D>,
{
    let input = || BlockInput { stress_state: state, ..BlockInput::new(element.name, material, &patch.connectivity, &patch.positions) };
    let make_body = || Body::made(&input());
    let limit = 2.0 / frequency_squared(&stiffness(make_body), &make_body().masses()).sqrt();
    let mut model = body_of(element, material.clone(), patch);
    model.parts[0].stress_state = state.into();
    let assembled = start(&model).overview().stable_time_step;
    model.run.stable_step = StableStep::Nodes;
    [assembled / limit, start(&model).overview().stable_time_step / limit]
}

#[test]
fn the_first_step_is_stable_and_at_least_0_92_of_the_true_limit() {
    let check = |name: &str, ratios: Vec<[f64; 2]>| {
        let of = |k: usize| ratios.iter().map(move |ratio| ratio[k]);
        let (least, most) = (of(0).fold(f64::INFINITY, f64::min), of(0).fold(0.0, f64::max));
        let nodes = of(1).sum::<f64>() / ratios.len() as f64;
        println!("{name:<30} {least:.4} to {most:.4} of the limit, by nodes {nodes:.3} on the average");
        assert!(least > 0.92 && most < 1.0, "{name}: {least} {most}");
    };
    for kind in ELEMENTS {
        let mut numbers = Spread::new(31);
        let one = |round: usize| {
            let material = material("elastic", [-0.5, 0.0, 0.3, 0.45, 0.499][round % 5]);
            let mut patch = patch(kind.name, 4, 0.1);
            shake(&mut patch, [0.0, 0.18][round % 2] * room(kind.name), &mut numbers);
            first(kind, "", &material, &patch)
        };
        check(kind.name, (0..20).map(one).collect());
        for state in STRESS_STATES {
            let one = |round: usize| {
                let mut patch = patch(kind.name, 3, 0.15);
                patch.positions.iter_mut().for_each(|x| x[0] += [0.0, 0.3, 3.0][round % 3]);
                first(kind, state.name, &material("elastic", [0.0, 0.3, 0.49][round / 3]), &patch)
            };
            check(&format!("{} {}", kind.name, state.name), (0..9).map(one).collect());
        }
    }
    for kind in ELEMENTS_OF_SPACE {
        let mut numbers = Spread::new(32);
        let one = |round: usize| {
            let material = material("elastic", [-0.5, 0.0, 0.3, 0.45, 0.499][round % 5]);
            let mut patch = solids::patch(kind.name, 2, 0.05);
            shake(&mut patch, [0.0, 0.12][round % 2], &mut numbers);
            first(kind, "", &material, &patch)
        };
        check(kind.name, (0..10).map(one).collect());
    }
}

/// Frequency of a patch when its body is brought to those positions, 1/s.
fn frequency<const D: usize>(element: &str, material: &Material, patch: &Patch<D>, to: &[[f64; D]]) -> f64
where
    Dim<D>: Blocks<D>,
{
    let make_body = || {
        let mut body = Body::of(element, material, patch);
        body.move_to(to);
        body
    };
    frequency_squared(&stiffness(make_body), &make_body().masses()).sqrt()
}

/// The true frequency over its bound by the deformation, ω_r + max s_e, for bodies that are deformed from a
/// patch.
fn raised<const D: usize>(element: &str, material: &Material, patch: &Patch<D>, to: &[[f64; D]]) -> [f64; 2]
where
    Dim<D>: Blocks<D>,
{
    let reference = frequency(element, material, patch, &patch.positions);
    let now = frequency(element, material, patch, to);
    let body = Body::of(element, material, patch);
    let elastic = body.block.elastic().unwrap();
    let mut s: f64 = 0.0;
    elastic.deformations(&elastic.slopes(&patch.positions), [&patch.positions, to], &mut |e, [change, growth]| {
        let root = growth.sqrt();
        let own = f64::max(root - 1.0, 0.0) + root * change * elastic.spread().sqrt();
        s = s.max(own * 2.0 / body.block.time_step_squared(e).sqrt());
    });
    [now / (reference + s), now / reference]
}

#[test]
fn no_deformation_raises_the_frequency_by_more_than_its_bound() {
    let check = |name: &str, ratios: &[[f64; 2]]| {
        let worst = ratios.iter().fold([0.0; 2], |worst: [f64; 2], ratio| [worst[0].max(ratio[0]), worst[1].max(ratio[1])]);
        println!("{name:<30} ω/(ω_r + s) at most {:.4}, ω/ω_r {:.3}", worst[0], worst[1]);
        assert!(worst[0] < 1.0 + 1e-5, "{name}: {}", worst[0]);
        assert!(worst[1] > 1.01, "{name}: nothing was raised");
    };
    for kind in ELEMENTS {
        let mut numbers = Spread::new(33);
        let one = |round: usize| {
            let material = material("elastic", [0.0, 0.3, 0.499][round % 3]);
            let mut patch = patch(kind.name, 3, 0.1);
            shake(&mut patch, 0.1, &mut numbers);
            let (f, size) = (blocks::near_one(0.1, &mut numbers), numbers.between(0.0, 0.06));
            let to: Vec<_> = patch.positions.iter().map(|&x| blocks::apply(&f, x).map(|x| x + size * numbers.between(-1.0, 1.0))).collect();
            raised(kind.name, &material, &patch, &to)
        };
        check(kind.name, &(0..samples(60) as usize).map(one).collect::<Vec<_>>());
    }
    for kind in ELEMENTS_OF_SPACE {
        let mut numbers = Spread::new(34);
        let one = |round: usize| {
            let material = material("elastic", [0.0, 0.3, 0.499][round % 3]);
            let mut patch = solids::patch(kind.name, 2, 0.05);
            shake(&mut patch, 0.06, &mut numbers);
            let (f, size) = (solids::near_one(0.08, &mut numbers), numbers.between(0.0, 0.04));
            let to: Vec<_> = patch.positions.iter().map(|&x| solids::apply(&f, x).map(|x| x + size * numbers.between(-1.0, 1.0))).collect();
            raised(kind.name, &material, &patch, &to)
        };
        check(kind.name, &(0..12).map(one).collect::<Vec<_>>());
    }
}

#[test]
fn no_law_that_is_stiffest_at_rest_is_stiffer_than_its_elastic_body_after_it_was_strained() {
    let mut laws = 0;
    every_pair(|element, law| {
        let mut numbers = Spread::new(38);
        let own = material(law, 0.3);
        let mut patch = patch(element, 3, 0.1);
        shake(&mut patch, 0.05, &mut numbers);
        let body = Body::of(element, &own, &patch);
        if body.block.elastic().is_none() {
            return;
        }
        laws += 1;
        let [bulk, shear] = body.block.law().unwrap().stiffness();
        let mut body = material("elastic", 0.3);
        body.parameters.insert("young".into(), 9.0 * bulk * shear / (3.0 * bulk + shear));
        body.parameters.insert("poisson".into(), (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear));
        body.parameters.insert("density".into(), own.parameters["density"]);
        let f = blocks::near_one(0.02, &mut numbers);
        let to: Vec<_> = patch.positions.iter().map(|&x| blocks::apply(&f, x)).collect();
        let [is, was] = [&own, &body].map(|material| frequency(element, material, &patch, &to));
        assert!(is < was * (1.0 + 1e-6), "{element} {law}: {is} {was}");
    });
    assert!(laws > 15, "{laws}");
}

/// A block whose nodes all have another velocity, m/s, of an element whose waves have 1160 m/s.
fn vibrating<const D: usize>(kind: &ElementKind, mut patch: Patch<D>, speed: f64) -> (Model, Patch<D>, Vec<f64>) {
    let mut numbers = Spread::new(35);
    shake(&mut patch, 0.08, &mut numbers);
    let velocities = (0..D * patch.positions.len()).map(|_| speed * numbers.between(-1.0, 1.0)).collect();
    (body_of(kind, elastic(1e9, 1e3), &patch), patch, velocities)
}

/// Follows a body and compares its steps with the true limit of its present form; returns steps and the
/// largest ratio.
fn followed<const D: usize>(kind: &ElementKind, patch: Patch<D>, speed: f64, steps: u64) -> (u64, f64)
where
    Dim<D>: Blocks<D>,
{
    let (mut model, patch, velocities) = vibrating(kind, patch, speed);
    // The fastest motions have all the energy, and steps that follow their strains change it.
    model.run.energy_limit = 1e9;
    let mut run = start(&model);
    // Nodes in the order of the run.
    let placed = |x: &[f64]| patch.positions.iter().position(|own| own.iter().zip(x).all(|(a, b)| a == b)).unwrap();
    let order: Vec<usize> = run.coordinates().chunks(D).map(placed).collect();
    let nodes: Vec<u32> = (0..order.len() as u32).collect();
    run.set_velocities(&nodes, &velocities).unwrap();
    let mut most: f64 = 0.0;
    while run.steps() < steps {
        let ended = run.advance(f64::INFINITY, 17);
        let mut to = patch.positions.clone();
        run.coordinates().chunks(D).zip(&order).for_each(|(x, &k)| to[k] = std::array::from_fn(|d| x[d]));
        let limit = 2.0 / frequency(kind.name, &model.materials["m"], &patch, &to);
        most = most.max(run.time_step() / limit);
        ended.unwrap();
    }
    (run.steps(), most)
}

#[test]
fn steps_stay_below_the_true_limit_of_the_form_that_a_body_has() {
    for name in ["quad4", "quad4_reduced", "quad4_reduced_assumed_strain", "tri3", "tri3_anp"] {
        let kind = ELEMENTS.iter().find(|kind| kind.name == name).unwrap();
        for speed in [0.3, 3.0, 20.0] {
            let (steps, most) = followed(kind, patch(name, 3, 0.1), speed, 340);
            println!("{name:<30} {speed} m/s: {steps} steps, at most {most:.4} of the limit");
            assert!(most < 1.0, "{name}: {most}");
        }
    }
    for name in ["hex8", "hex8_reduced", "tet4"] {
        let kind = ELEMENTS_OF_SPACE.iter().find(|kind| kind.name == name).unwrap();
        for speed in [1.0, 10.0] {
            let (steps, most) = followed(kind, solids::patch(name, 2, 0.05), speed, 120);
            println!("{name:<30} {speed} m/s: {steps} steps, at most {most:.4} of the limit");
            assert!(most < 1.0, "{name}: {most}");
        }
    }
}

#[test]
fn a_free_body_keeps_its_energy_with_all_of_the_step_by_the_assembled_mesh_in_fewer_steps() {
    for element in ["quad4", "quad4_reduced", "quad4_reduced_assumed_strain"] {
        let with = |stable_step| {
            let mut model = crooked(0.05, stable_step);
            model.parts[0].element = element.into();
            let run = to_end(&model);
            (run.steps(), run.summary())
        };
        let ((many, by_nodes), (few, assembled)) = (with(StableStep::Nodes), with(StableStep::Assembled));
        println!(
            "{element}: {many} steps by nodes, {few} by the assembled mesh; drift {:e} {:e}",
            by_nodes.energy_drift, assembled.energy_drift
        );
        assert!(few < many * 8 / 10, "{element}: {many} {few}");
        assert!(assembled.energy_drift.abs() < 1e-3, "{element}: {}", assembled.energy_drift);
        let governor = &assembled.stable_time_step_governor;
        assert!(governor.starts_with("the assembled mesh, fastest at node "), "{governor}");
    }
}

#[test]
fn damped_bodies_are_stable_with_all_of_the_step_by_the_assembled_mesh() {
    for (element, viscosity, damping) in [
        ("quad4", [0.06, 1.2], 0.0),
        ("quad4_reduced_viscous", [0.0, 0.0], 0.0),
        ("quad4", [0.0, 0.0], 2e-6),
        ("quad4_reduced_viscous", [0.1, 1.5], 1e-6),
        ("tri3_anp", [0.06, 1.2], 0.0),
    ] {
        let with = |stable_step| {
            let mut model = crooked(if element.starts_with("tri") { 0.06 } else { 0.02 }, stable_step);
            let part = &mut model.parts[0];
            if element.starts_with("tri") {
                part.shape = mapped_rectangle();
                part.element_triangles = element.into();
            }
            part.element = if element.starts_with("tri") { "quad4".into() } else { element.into() };
            if damping > 0.0 {
                model.loads.push(Load::StiffnessDamping { parts: Vec::new(), time: damping });
            }
            model.run.bulk_viscosity = viscosity;
            let mut run = start(&model);
            let nodes: Vec<u32> = (0..run.coordinates().len() as u32 / 2).collect();
            let mut numbers = Spread::new(36);
            let velocities: Vec<f64> = (0..2 * nodes.len()).map(|_| numbers.between(-0.3, 0.3)).collect();
            run.set_velocities(&nodes, &velocities).unwrap();
            run.advance(f64::INFINITY, u64::MAX).unwrap();
            (run.steps(), run.summary())
        };
        let ((many, _), (few, summary)) = (with(StableStep::Nodes), with(StableStep::Assembled));
        println!("{element} {viscosity:?} {damping}: {many} steps by nodes, {few} by the assembled mesh, drift {:e}", summary.energy_drift);
        assert!(few < many * 9 / 10, "{element}: {many} {few}");
        assert!(summary.energy_drift.abs() < 1e-3, "{element}: {}", summary.energy_drift);
    }
}

#[test]
fn steps_by_the_assembled_mesh_have_the_same_bits_for_any_threads_and_instruction_set() {
    let model = crooked(0.02, StableStep::Assembled);
    let hash = hash_of_equal_bits(&model, &[1, 2, 3], "crooked");
    assert_ne!(hash, hash_of_equal_bits(&crooked(0.02, StableStep::Nodes), &[1], "by nodes"));
}

#[test]
fn what_elements_report_bounds_how_far_the_frequency_may_have_risen() {
    for kind in ELEMENTS {
        let mut numbers = Spread::new(37);
        let (material, patch) = (material("elastic", 0.3), patch(kind.name, 4, 0.2));
        let mut body = Body::made(&BlockInput::new(kind.name, &material, &patch.connectivity, &patch.positions));
        let (slopes, spread) = body.block.elastic().map(|elastic| (elastic.slopes(&patch.positions), elastic.spread().sqrt())).unwrap();
        body.block.weigh_motion(&|e| 1.2 * (spread + 0.5 * 2f64.sqrt()) * slopes[e]);
        let mut way = 0.0;
        for _ in 0..6 {
            let to: Vec<_> = body.positions.iter().map(|x| x.map(|x| x + 0.004 * numbers.between(-1.0, 1.0))).collect();
            body.move_to(&to);
            way += body.report.motion;
            let mut risen: f64 = 0.0;
            body.block.elastic().unwrap().deformations(&slopes, [&patch.positions, &to], &mut |_, [change, growth]| {
                risen = risen.max(f64::max(growth.sqrt() - 1.0, 0.0) + growth.sqrt() * change * spread);
            });
            assert!(risen > 0.0 && risen < way, "{}: {risen} {way}", kind.name);
        }
    }
}

/// Springs on bars, which are not in the assembled mesh whose frequency is found, beside a slow block that
/// is.
#[test]
fn springs_count_on_elements_that_are_beside_it_too() {
    const AREA: f64 = 0.01;
    for ratio in [0.2, 0.5, 1.0, 3.0] {
        let mut model = model(1e6);
        (model.run.stable_step, model.run.safety) = (StableStep::Assembled, 1.0);
        add(&mut model, "slow", rectangle([0.0, 10.0], [18.0, 18.0], [6, 6]), [0.0; 2]);
        for (name, x) in [("one", 0.0), ("two", 1.5)] {
            let shape = Shape::Truss(Truss { lines: vec![vec![[x, 0.0], [x + 1.0, 0.0]]], elements: 1 });
            let (element, area, material) = ("bar2".into(), Some(AREA), "soft".into());
            model.parts.push(Part { name: name.into(), material, element, area, shape, ..Part::default() });
        }
        // Young's modulus 1 GPa, 1000 kg/m³: half of each bar's mass at each of its nodes.
        let (bar, mass) = (1e9 * AREA, 0.5 * 1e3 * AREA);
        let between = ["one".into(), "two".into()];
        model.springs.push(Spring { between, stiffness: ratio * bar, ..Spring::default() });
        // Nodes in a row; both of the first bar have the first of the second for their nearest.
        let mut stiffness = vec![vec![0.0; 4]; 4];
        let links = [(0, 1, bar), (2, 3, bar), (1, 2, ratio * bar)];
        for (a, b, k) in links {
            (stiffness[a][a], stiffness[b][b]) = (stiffness[a][a] + k, stiffness[b][b] + k);
            (stiffness[a][b], stiffness[b][a]) = (stiffness[a][b] - k, stiffness[b][a] - k);
        }
        // Without the spring from the first node, whichever it goes to: less stiff than what is there.
        let limit = 2.0 / frequency_squared(&stiffness, &[mass; 4]).sqrt();
        let step = start(&model).overview().stable_time_step;
        println!("springs of {ratio}: {:.4} of the limit", step / limit);
        assert!(step < limit * (1.0 + 1e-9) && step > 0.3 * limit, "{ratio}: {step} {limit}");
    }
}

/// Failed elements take stiffness away; where dilatations are averaged over nodes what is left may be
/// stiffer, and the elements themselves bound the step.
#[test]
fn elements_may_fail_with_all_of_the_step_by_the_assembled_mesh() {
    fn torn<const D: usize>(kind: &ElementKind, patch: Patch<D>, steps: u64)
    where
        Dim<D>: Blocks<D>,
    {
        let (mut model, patch, velocities) = vibrating(kind, patch, 0.3);
        model.run.energy_limit = 1e9;
        model.materials.get_mut("m").unwrap().failure = [("principal_stress".to_string(), 4e5)].into();
        let mut run = start(&model);
        let nodes: Vec<u32> = (0..patch.positions.len() as u32).collect();
        run.set_velocities(&nodes, &velocities).unwrap();
        run.advance(f64::INFINITY, steps).unwrap();
        let summary = run.summary();
        let gone: usize = summary.erosion.as_ref().map_or(0, |erosion| erosion.elements.iter().map(|(_, count)| *count).sum());
        let governor = &summary.stable_time_step_governor;
        println!("{}: {gone} of {} elements gone, drift {:e}, {governor}", kind.name, summary.elements, summary.energy_drift);
        assert!(gone > summary.elements / 20 && gone < summary.elements, "{}: {gone}", kind.name);
        assert!(summary.energy_drift.abs() < 0.03, "{}: {}", kind.name, summary.energy_drift);
    }
    let of = |kinds: &'static [ElementKind], name| kinds.iter().find(|kind| kind.name == name).unwrap();
    for name in ["quad4", "quad4_reduced", "tri3_anp"] {
        torn(of(ELEMENTS, name), patch(name, 8, 0.2), 4_000);
    }
    for name in ["hex8", "tet4", "tet4_anp"] {
        torn(of(ELEMENTS_OF_SPACE, name), solids::patch(name, 4, 0.1), 2_000);
    }
}
