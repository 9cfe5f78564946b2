//! A step takes no memory beyond what the steps before it took: the heap is asked for none.

use embate_solver::bench::slabs;
use embate_solver::model::{Contact, Friction, Interface, Partners};
use embate_solver::simulation::{Options, Simulation};

/// How often the heap is asked in each of some steps, once the contact of two slabs, shifted by a fraction of
/// an element, is closed.
fn allocations(partners: Partners, shift: f64, friction: f64) -> Vec<u64> {
    let mut model = slabs(12, 2.0, shift);
    let friction = Friction { coefficient: friction, dynamic: None, decay: 0.0, viscosity: 0.0, limit: f64::INFINITY };
    let interface = Interface { friction: (friction.coefficient > 0.0).then_some(friction), ..Interface::default() };
    model.contacts.push(Contact { name: "all".into(), partners, interface, ..Contact::default() });
    let mut simulation = Simulation::new(&model, &Options { threads: 1, simd: None }).unwrap();
    simulation.advance(f64::INFINITY, 30).unwrap();
    let count = |_| allocation_counter::measure(|| simulation.advance(f64::INFINITY, 1).unwrap()).count_total;
    (0..10).map(count).collect()
}

#[test]
fn a_pressed_step_asks_the_heap_for_nothing() {
    let slabs = || Partners::Between(["upper".into(), "lower".into()]);
    let all = [(slabs(), 0.3, 0.0), (slabs(), 0.0, 0.0), (slabs(), 0.3, 0.3), (Partners::Bodies(Vec::new()), 0.3, 0.0)];
    for (partners, shift, friction) in all {
        let name = format!("{partners:?}, shifted by {shift}, friction {friction}");
        let found = allocations(partners, shift, friction);
        // A look at the bodies as they are, one in ten steps here, makes its regions again.
        assert!(found.iter().filter(|count| **count > 0).count() <= 1, "{name}: {found:?}");
    }
}
