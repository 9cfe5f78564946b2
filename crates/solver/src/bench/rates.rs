//! Rates of kernels and of whole steps, in element-steps per second, and what contact adds to a step.

use super::bodies::{Patch, material};
use crate::block::{BlockInput, Blocks, Motion, NodalForces, make};
use crate::error::{Error, Fault};
use crate::model::Model;
use crate::model::messages::UNKNOWN_NAME;
use crate::simulation::{Options, Simulation};
use crate::tensor::Dim;
use embate_lanes::{Level, Team};
use std::hint::black_box;
use std::time::Instant;

/// Steps before a kernel is measured: together some times the strain at which the metal of [`material`]
/// yields.
const WARM: usize = 20;
/// Rounds before those that count.
const LEAD: usize = 2;
/// Rounds of a measurement, at least.
const ROUNDS: usize = 3;
/// Element-steps of a round of a small body, about: a millisecond, so that some rounds are undisturbed by
/// what else the machine does.
const ROUND: usize = 20_000;

/// The best rate of rounds of `work`, which says how much it has done; after three rounds it ends when the
/// time is up.
pub fn best_rate(seconds: f64, mut work: impl FnMut() -> f64) -> f64 {
    let (begin, mut best, mut rounds) = (Instant::now(), 0.0_f64, 0);
    while rounds < ROUNDS || begin.elapsed().as_secs_f64() < seconds {
        let start = Instant::now();
        let done = work();
        best = best.max(done / start.elapsed().as_secs_f64().max(1e-9));
        rounds += 1;
    }
    best
}

/// The shortest of so many rounds of `work`, s.
pub fn shortest(rounds: usize, mut work: impl FnMut()) -> f64 {
    let time = |_| {
        let begin = Instant::now();
        work();
        begin.elapsed().as_secs_f64()
    };
    (0..rounds).map(time).fold(f64::INFINITY, f64::min)
}

/// Element-steps per second of the block alone, on one thread: from the motion of the nodes to the forces on
/// them.
///
/// # Errors
/// An element or law that is not in its registry.
pub fn kernel<const D: usize>(element: &str, law: &str, patch: &Patch<D>, level: Level, seconds: f64) -> Result<f64, Error>
where
    Dim<D>: Blocks<D>,
{
    advanced(element, law, patch, level, |advance| {
        let once = Instant::now();
        let elements = advance();
        let repeats = repeats(once.elapsed().as_secs_f64(), elements, seconds);
        best_rate(seconds, || (0..repeats).map(|_| advance()).sum::<usize>() as f64)
    })
}

/// Operations of the block alone per element and step, counted in the scalar lane.
///
/// # Errors
/// As [`kernel`].
#[cfg(feature = "count")]
pub fn operations<const D: usize>(element: &str, law: &str, patch: &Patch<D>) -> Result<[f64; 5], Error>
where
    Dim<D>: Blocks<D>,
{
    advanced(element, law, patch, Level::SCALAR, |advance| {
        embate_lanes::Operations::take();
        let elements = advance();
        let embate_lanes::Operations { additions, multiplications, divisions, roots, others } = embate_lanes::Operations::take();
        [additions, multiplications, divisions, roots, others].map(|count| count as f64 / elements as f64)
    })
}

/// Hands a block that has flown for some steps to `measure`, as what strains it once more and says how many
/// elements it has.
fn advanced<T, const D: usize>(
    element: &str,
    law: &str,
    patch: &Patch<D>,
    level: Level,
    measure: impl FnOnce(&mut dyn FnMut() -> usize) -> T,
) -> Result<T, Error>
where
    Dim<D>: Blocks<D>,
{
    let material = material(law);
    let input = BlockInput::new(element, &material, &patch.connectivity, &patch.positions);
    let unknown = || Error::Model(vec![Fault::new(&UNKNOWN_NAME, "", format!("there is no block of `{element}` with `{law}`"), "")]);
    let mut block = make(&input).ok_or_else(unknown)?;
    let (mut slots, mut team) = (vec![[0.0; D]; block.slots().len()], Team::alone());
    let motion = Motion::new(&patch.positions, &patch.velocities, 1e-7);
    // Long steps first, so that metals flow in every step that is measured.
    let first = Motion { time_step: 1e-5, ..motion };
    black_box(block.advance(&Motion { time_step: 0.0, ..motion }, level, NodalForces::new(&mut slots), &mut team));
    for _ in 0..WARM {
        black_box(block.advance(&first, level, NodalForces::new(&mut slots), &mut team));
    }
    Ok(measure(&mut || {
        black_box(block.advance(&motion, level, NodalForces::new(&mut slots), &mut team));
        block.elements()
    }))
}

/// How often a round does what takes so long once: so that all rounds fit into the time, and no round is
/// longer than it needs to be.
fn repeats(once: f64, elements: usize, seconds: f64) -> usize {
    ((seconds / ROUNDS as f64 / once.max(1e-9)) as usize).clamp(1, (ROUND / elements).max(1))
}

/// Element-steps per second of whole steps of a small model without contact and output, such as
/// [`super::spinning_block`], which fits into a cache: each round begins with a new body.
///
/// # Errors
/// A model that is not sound, as of an element or law that is not in its registry; a step that fails.
pub fn step(model: &Model, options: &Options, seconds: f64) -> Result<f64, Error> {
    let (begin, mut best, mut rounds) = (Instant::now(), 0.0_f64, 0);
    while rounds < ROUNDS || begin.elapsed().as_secs_f64() < seconds {
        let mut simulation = Simulation::new(model, options)?;
        let elements = simulation.summary().elements;
        let warm = Instant::now();
        simulation.advance(f64::INFINITY, 10)?;
        let steps = repeats(0.1 * warm.elapsed().as_secs_f64(), elements, seconds).max(10);
        let start = Instant::now();
        simulation.advance(f64::INFINITY, steps as u64)?;
        best = best.max((steps * elements) as f64 / start.elapsed().as_secs_f64().max(1e-9));
        rounds += 1;
    }
    Ok(best)
}

/// Element-steps per second of a simulation that continues, by rounds of a step.
///
/// # Errors
/// A step that fails.
pub fn steps_of(simulation: &mut Simulation, seconds: f64) -> Result<f64, Error> {
    let elements = simulation.summary().elements as f64;
    simulation.advance(f64::INFINITY, 2)?;
    let mut failed = None;
    let rate = best_rate(seconds, || {
        failed = failed.take().or(simulation.advance(f64::INFINITY, 1).err());
        elements
    });
    failed.map_or(Ok(rate), Err)
}

/// Shortest time of a step, s, of two models that take turns, so that what else the machine does meets both:
/// so many rounds of four steps, or until the time is up. The first two rounds do not count: contacts close
/// in them.
///
/// # Errors
/// A model that is not sound, a step that fails.
pub fn step_times(models: [&Model; 2], options: &Options, rounds: usize, seconds: f64) -> Result<([f64; 2], [Simulation; 2]), Error> {
    let [one, other] = models;
    let mut simulations = [Simulation::new(one, options)?, Simulation::new(other, options)?];
    let mut shortest = [f64::INFINITY; 2];
    let begin = Instant::now();
    for round in 0..LEAD + rounds {
        if round >= LEAD + ROUNDS && begin.elapsed().as_secs_f64() >= seconds {
            break;
        }
        for (simulation, shortest) in simulations.iter_mut().zip(&mut shortest) {
            simulation.advance(f64::INFINITY, 1)?;
            let start = Instant::now();
            simulation.advance(f64::INFINITY, 3)?;
            if round >= LEAD {
                *shortest = shortest.min(start.elapsed().as_secs_f64() / 3.0);
            }
        }
    }
    Ok((shortest, simulations))
}
