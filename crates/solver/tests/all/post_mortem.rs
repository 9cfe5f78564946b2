//! What a failed run knows of its failure: the failure location, and the way to the failure once more, which
//! changes nothing.

use crate::bodies::*;
use embate_solver::error::Error;
use embate_solver::model::{Friction, MassScaling, Model, Obstacle, ObstacleShape};
use embate_solver::output::Frame;
use embate_solver::post_mortem::{FailureEntity, FailureLocation, MassNeeded, Trace};
use embate_solver::simulation::{Control, Observer, ObserverError, Options, Progress, Simulation};

/// Listens to nothing.
struct Deaf;

impl Observer for Deaf {
    fn frame(&mut self, _: Frame) -> Result<(), ObserverError> {
        Ok(())
    }
    fn row(&mut self, _: &[f64]) -> Result<(), ObserverError> {
        Ok(())
    }
    fn progress(&mut self, _: &Progress<'_>) -> Control {
        Control::Continue
    }
}

/// A block on a floor, into which a round punch is driven at a tenth of the speed of its waves, until an
/// element has no volume left.
fn punched() -> Model {
    let (young, density) = (1e6, 1e3);
    let speed = 0.1 * f64::sqrt(young / density);
    let mut model = slender(0.2 / speed, young, density);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [6, 6]), [0.0, 0.0]);
    model.obstacles.push(Obstacle::wall("floor", [0.0, 0.0], [0.0, 1.0]));
    let mut punch = Obstacle::fixed("punch", ObstacleShape::Circle { centre: [0.05, 0.13, 0.0], radius: 0.03, hollow: false });
    punch.motion.velocity = [Some(0.0.into()), Some((-speed).into()), None];
    model.obstacles.push(punch);
    // Nothing else stops it before.
    (model.run.energy_limit, model.run.penetration_limit) = (10.0, Some(1.0));
    model
}

fn failed(model: &Model) -> (Simulation, Error) {
    let mut simulation = simulation(model);
    let error = simulation.run(&mut Deaf).unwrap_err();
    (simulation, error)
}

fn traced(model: &Model, failure_entity: &FailureEntity, failed: &Simulation, from: u64, threads: usize) -> (Simulation, Trace) {
    let mut again = Simulation::new(model, &Options { threads, simd: None }).unwrap();
    again.follow(failure_entity, failed, from);
    again.run(&mut Deaf).unwrap_err();
    let trace = again.take_trace().unwrap();
    (again, trace)
}

#[test]
fn a_failure_location_is_followed_to_its_failure_with_the_same_bits() {
    let model = punched();
    let (first, error) = failed(&model);
    let failure_entity = first.failure_entity(&error);
    let Error::Inverted { part, element, at, step, .. } = &error else { panic!("{error}") };
    assert_eq!(
        first.failure_location(&failure_entity),
        FailureLocation::Element { part: part.clone(), element: *element, at: [at[0], at[1], 0.0] }
    );
    assert!(*step > 10, "{error}");
    let (again, trace) = traced(&model, &failure_entity, &first, step - 5, 2);
    assert_eq!(again.summary().state_hash, first.summary().state_hash);
    assert_eq!(trace.moments.iter().map(|moment| moment.step).collect::<Vec<_>>(), (step - 5..=*step).collect::<Vec<_>>());
    let now = first.trace_now(&failure_entity, Some(&error));
    assert_eq!(format!("{:?}", trace.moments.last().unwrap()), format!("{:?}", now.moments[0]), "the step that failed is the same");
    // The last good state is that of a run that stops there.
    let mut shorter = model.clone();
    shorter.run.max_steps = Some(step - 1);
    let mut before = simulation(&shorter);
    before.run(&mut Deaf).unwrap();
    let (frame, good) = (before.frame(), &trace.moments[trace.moments.len() - 2]);
    assert!(trace.near.nodes.iter().zip(&good.positions).all(|(&node, x)| frame.place(node) == *x));
    assert!(good.row == before.history_row());
    let pressing = trace.contacts.iter().position(|(kind, name)| *kind == "obstacle" && name == "punch").unwrap();
    assert!(trace.moments.iter().any(|moment| moment.pressing[pressing] > 0.0));
}

#[test]
fn the_last_output_of_a_failed_run_shows_contacts_where_the_bodies_are() {
    let model = punched();
    for threads in [1, 2] {
        let mut simulation = Simulation::new(&model, &Options { threads, simd: None }).unwrap();
        assert!(matches!(simulation.run(&mut Deaf), Err(Error::Inverted { .. })));
        let frame = simulation.frame();
        let field = |name: &str| &frame.fields.iter().find(|field| field.kind.name == name).unwrap().values;
        let nodes = field("contact_gap").iter().zip(field("contact_status")).zip(frame.positions::<2>());
        let on_floor: Vec<(f64, f64)> =
            nodes.filter(|((_, status), x)| **status > 0.0 && x[1] < 0.02).map(|((gap, _), x)| (*gap, x[1])).collect();
        assert!(on_floor.len() > 2 && on_floor.iter().all(|(gap, y)| (gap - y).abs() < 1e-12), "{on_floor:?}");
    }
}

#[test]
fn a_run_that_fails_before_its_first_step_says_so() {
    for friction in [None, Some(0.3)] {
        let mut model = punched();
        let of = |coefficient| Friction { coefficient, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
        model.obstacles.iter_mut().for_each(|obstacle| obstacle.interface.friction = friction.map(of));
        model.run.step_limit = Some(0.5 * model.run.end);
        let failed = Simulation::new(&model, &Options { threads: 1, simd: None }).and_then(|mut simulation| simulation.run(&mut Deaf));
        assert!(matches!(failed, Err(Error::Collapsed { .. })), "{failed:?}");
    }
}

#[test]
fn three_rings_hang_together_with_the_failure_location() {
    let model = punched();
    let (simulation, error) = failed(&model);
    let near = simulation.neighbourhood(&simulation.failure_entity(&error));
    let own = &near.cells[near.element.unwrap()];
    assert_eq!(own.ring, Some(0));
    // On a grid of 6 by 6 the ring is the larger of the distances in both directions.
    let at = |element: usize| [(element % 6) as i64, (element / 6) as i64];
    let [i, j] = at(own.element);
    for cell in &near.cells {
        let [k, l] = at(cell.element);
        let distance = (i - k).abs().max((j - l).abs());
        assert!(cell.ring.map_or(distance > 3, |ring| i64::from(ring) == distance), "{cell:?}");
    }
}

#[test]
fn a_run_goes_to_its_failure_from_a_state_in_memory_and_states_change_nothing() {
    let mut model = slender(4.0, 1e7, 1e3);
    add(&mut model, "block", rectangle([0.0, 0.0], [0.1, 0.1], [2, 2]), [0.0, -1.0]);
    model.obstacles.push(Obstacle::wall("floor", [0.0, -0.01], [0.0, 1.0]));
    model.run.max_steps = Some(5000);
    let run = |room: usize| {
        let mut simulation = simulation(&model);
        simulation.keep_states_in(room);
        simulation.run(&mut Deaf).unwrap();
        simulation
    };
    let (with, without) = (run(1 << 20), run(0));
    assert_eq!(with.summary(), without.summary());
    assert!(without.states().is_empty() && with.states().len() == 2 && with.states()[0].step > with.states()[1].step);
    for state in with.states() {
        let mut resumed = Simulation::resumed(&model, &Options { threads: 1, simd: None }, &state.sections).unwrap();
        assert_eq!(resumed.steps(), state.step);
        resumed.run(&mut Deaf).unwrap();
        assert_eq!(resumed.summary().state_hash, with.summary().state_hash);
    }
}

#[test]
fn the_mass_for_a_step_and_the_longest_step_within_the_limit_are_those_of_the_closed_form() {
    // A bar whose right half has elements of a tenth of the length: they have an eleventh of the mass.
    let mut model = slender(1e-3, 1e9, 1e3);
    let mesh = mapped([20, 2], |u, v| [if u <= 0.5 { 0.2 * u } else { 0.1 + 0.02 * (u - 0.5) }, 0.02 * v]);
    add_mesh(&mut model, "bar", mesh, [0.0, 0.0]);
    assert!(MassNeeded::of(&model, &Options::default()).unwrap().is_none());
    let step = simulation(&model).time_step();
    model.run.mass_scaling = Some(MassScaling { time_step: 2.0 * step, limit: 0.2, in_run: false });
    let needed = MassNeeded::of(&model, &Options::default()).unwrap().unwrap();
    assert!((needed.share(2.0 * step) - 3.0 / 11.0).abs() < 1e-9, "{}", needed.share(2.0 * step));
    assert!((needed.longest() / (step * (1.0 + 0.2 * 11.0f64).sqrt()) - 1.0).abs() < 1e-9);
    let worst = &needed.heaviest[0];
    assert!(worst.part == "bar" && worst.at[0] > 0.1 && (worst.added / worst.mass - 3.0).abs() < 1e-9, "{worst:?}");
    assert_eq!((needed.parts[0].elements, needed.parts[0].light), (40, 20));
    // With as much mass the model begins.
    model.run.mass_scaling = Some(MassScaling { time_step: 0.999 * needed.longest(), limit: 0.2, in_run: false });
    simulation(&model);
}
