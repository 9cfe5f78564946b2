//! What is tied is left out of contacts of bodies: the tie alone holds it.
//!
//! Left out is a spring whose ends on one side are all nodes that a tie holds of one of its surfaces, and
//! whose ends on the other side are all nodes that it holds of the other one. It stays in the list, opened,
//! so that nodes are followed and checked on as ever. Where the tie breaks, springs of nodes begin as those
//! of surfaces that meet: without energy, at the gap 0. Those of segments, facets and pinballs have no such
//! beginning; what was tied once they leave to the ordinary contact of the tie itself.
//!
//! A tie that does not act all the time leaves nothing out: when it ends, what is pressed together there
//! would meet with an energy that nothing has put in.

use super::Held;
use crate::contact::Contact;
use crate::contact::springs::{Spring, Springs, TangentSpace};
use crate::tensor::Dim;

/// How springs of a formulation end at what a tie holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Beside {
    /// At its nodes; they can begin again.
    Nodes,
    /// At the nodes of its segments or facets.
    Surfaces,
    /// At nodes of elements, some of which it holds.
    Elements,
}

/// Opens the springs of contacts of bodies between what other contacts tie, after all have found theirs.
pub(crate) fn leave_out_tied<const D: usize>(contacts: &[Contact<D>], springs: &mut Springs<D>)
where
    Dim<D>: TangentSpace<D>,
{
    for tie in contacts {
        let Some(held) = tie.held_all_the_time() else { continue };
        for contact in contacts {
            let Some((range, beside)) = contact.beside_ties() else { continue };
            springs.open_where(range, |springs, spring| held.has(springs, spring, beside));
        }
    }
}

impl Held {
    /// Whether a spring is between what the ties hold of both surfaces.
    fn has<const D: usize>(&self, springs: &Springs<D>, spring: &Spring<D>, beside: Beside) -> bool
    where
        Dim<D>: TangentSpace<D>,
    {
        let sides = if beside == Beside::Nodes { &self.now } else { &self.first };
        // Of the ends with positive shares and of the others: how many there are, and how many each side has.
        let mut counts = [[0; 3]; 2];
        for end in springs.ends(spring).filter(|end| end.share != 0.0) {
            let count = &mut counts[usize::from(end.share < 0.0)];
            count[0] += 1;
            (0..2).for_each(|side| count[1 + side] += usize::from(sides[side].binary_search(&end.at).is_ok()));
        }
        let is_on = |end: usize, side: usize| {
            let [all, held] = [counts[end][0], counts[end][1 + side]];
            if beside == Beside::Elements { held > 0 } else { held == all && all > 0 }
        };
        is_on(0, 0) && is_on(1, 1) || is_on(0, 1) && is_on(1, 0)
    }
}
