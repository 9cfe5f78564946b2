//! Changes between two steps, by the program that drives the simulation: other velocities, forces besides
//! those of the model, and curves that continue in another way.
//!
//! At the end of step n velocities are known at n − ½ and n + ½. A change Δv at n is added to both: what is
//! shown at n is what was asked for, as if the steps until then had led to it. The ledger gets the change of
//! kinetic energy as work from outside, so that they close as without it (what friction and damping take in
//! the half step that follows is entered by the velocities before). Nodes are named by the user's numbers,
//! those of frames.

use super::Runs;
use super::run::Run;
use crate::error::{Fault, STEERING};
use crate::tensor::Dim;
use crate::vector::{dot, minus, plus, times};
use crate::vocabulary::suggestion;

impl<const D: usize> Run<D>
where
    Dim<D>: Runs<D>,
{
    /// Nodes of a part, a side or a group by the user's numbers, ascending; `None`: there is no such thing.
    pub(crate) fn nodes_of(&self, name: &str) -> Option<Vec<u32>> {
        let user = &self.system.mesh.user_nodes;
        let nodes = self.system.mesh.nodes(name)?;
        let mut numbers: Vec<u32> = nodes.iter().filter_map(|&node| user.get(node as usize).copied()).collect();
        numbers.sort_unstable();
        Some(numbers)
    }

    /// Gives nodes these velocities at the present time, m/s; those that are held keep what is prescribed.
    ///
    /// # Errors
    /// Nodes that are not there, or that something else leads; numbers that are none. Then nothing has
    /// changed.
    pub(crate) fn set_velocities(&mut self, nodes: &[u32], velocities: &[f64]) -> Result<(), Fault> {
        let given = self.vectors("velocity", nodes, velocities)?;
        let system = &mut self.system;
        for (&(node, _), user) in given.iter().zip(nodes) {
            let led = if system.bodies.of_node(node).is_some() { "of a rigid part" } else { "joined to others" };
            if system.bodies.of_node(node).is_some() || system.joins.of_node(node).is_some() {
                return Err(refused(format!("node {user} is {led}: its velocity can't be set"), "give it a force, or let it be free"));
            }
        }
        let (mut half, mut whole, mut ahead) = (0.0, 0.0, 0.0);
        for (number, wanted) in given {
            let node = number as usize;
            let change = minus(wanted, system.velocity(node));
            let old = system.velocities[node];
            let free = plus(old, change);
            let new = system.constraints.of(node).map_or(free, |held| held.apply(free));
            let change = minus(new, old);
            let (mass, before) = (system.mass[node], system.specific_kinetic(node));
            system.velocities[node] = new;
            system.velocities_old[node] = plus(system.velocities_old[node], change);
            // Where the velocity update leads what nothing holds; elsewhere it is written before it is read.
            system.positions_old[node] = plus(system.positions[node], times(system.time_step, new));
            half += 0.5 * mass * (dot(new, new) - dot(old, old));
            whole += mass * (system.specific_kinetic(node) - before);
            let load = system.forces.now().get(node).map_or(0.0, |&load| dot(load, change));
            let weight = system.body_forces.accelerations().get(node).map_or(0.0, |&g| mass * dot(g, change));
            ahead += 0.5 * system.time_step * (load + weight);
            system.speed = system.speed.max(dot(new, new).sqrt());
        }
        system.ledger.throw(half, whole, ahead);
        if let Some(subcycling) = &mut system.subcycling {
            subcycling.wake();
        }
        self.note_change();
        Ok(())
    }

    /// Lets these forces act on nodes from the next update on, N/m; zero ends what acted so.
    ///
    /// # Errors
    /// Nodes that are not there, numbers that are none. Then nothing has changed.
    pub(crate) fn set_forces(&mut self, nodes: &[u32], forces: &[f64]) -> Result<(), Fault> {
        let given = self.vectors("force", nodes, forces)?;
        self.system.forces.push(given);
        self.note_change();
        Ok(())
    }

    /// Lets a curve run, from the end of the coming step on, from its value there in a straight line to
    /// `value`, which it has from `end` (s) on; without `end` it jumps. Velocities of the coming step stand
    /// already. What follows the curve, and the works of that, are as of any other curve.
    ///
    /// # Errors
    /// A curve that the model does not have, a value or a time that is none. Then nothing has changed.
    pub(crate) fn set_curve(&mut self, name: &str, value: f64, end: Option<f64>) -> Result<(), Fault> {
        let system = &mut self.system;
        let Some(number) = system.curves.find(name) else {
            let known: Vec<&str> = system.curves.names().iter().map(String::as_str).collect();
            return Err(refused(format!("the model has no curve `{name}`"), &suggestion(name, &known)));
        };
        if !value.is_finite() {
            return Err(refused(format!("the value of the curve `{name}` is {value}"), "give a finite number"));
        }
        let now = system.time;
        if let Some(end) = end
            && !(end.is_finite() && end >= now)
        {
            let message = format!("the curve `{name}` is to have its value at {end} s, and the time is {now} s");
            return Err(refused(message, "give a time that is still to come"));
        }
        let step = system.time_step;
        system.curves.steer(number, [now + step, 0.5 * step, end.unwrap_or(now)], value);
        self.note_change();
        Ok(())
    }

    /// Momentum is no longer the bodies' own, and the model alone no longer says what the run is.
    fn note_change(&mut self) {
        self.momentum = None;
        self.is_steered = true;
    }

    /// Value of a curve from the end of the coming step on; `None`: the model has no such curve.
    pub(crate) fn curve(&self, name: &str) -> Option<f64> {
        let curves = &self.system.curves;
        curves.find(name).map(|number| curves.value(number, (self.system.time + self.system.time_step).next_up()))
    }

    /// The system's nodes with their vectors.
    fn vectors(&self, what: &str, nodes: &[u32], values: &[f64]) -> Result<Vec<(u32, [f64; D])>, Fault> {
        let user = &self.system.mesh.user_nodes;
        if values.len() != D * nodes.len() {
            let message = format!("{} numbers of {what} are given for {} nodes", values.len(), nodes.len());
            return Err(refused(message, &format!("a node has {D}")));
        }
        let mut numbers = vec![0; user.len()];
        (0..).zip(user).for_each(|(node, &user)| numbers[user as usize] = node);
        let of = |(&node, vector): (&u32, &[f64; D])| {
            let Some(&number) = numbers.get(node as usize) else {
                return Err(refused(format!("there is no node {node}"), &format!("nodes are numbered from 0 to {}", user.len() - 1)));
            };
            if vector.iter().all(|value| value.is_finite()) {
                return Ok((number, *vector));
            }
            Err(refused(format!("the {what} of node {node} is no finite number"), "give finite numbers"))
        };
        nodes.iter().zip(values.as_chunks::<D>().0).map(of).collect()
    }
}

fn refused(message: String, help: &str) -> Fault {
    Fault::new(&STEERING, "", message, help)
}
