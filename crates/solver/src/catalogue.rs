//! All messages of the solver, from the lists of the modules that raise them.

use crate::message::Message;
use crate::{contact, error, load, material, mesh, model, monitor};

/// All entries of the solver.
#[must_use]
pub fn all() -> Vec<&'static Message> {
    let rooms = [
        model::messages::MESSAGES,
        mesh::messages::MESSAGES,
        material::messages::MESSAGES,
        contact::messages::MESSAGES,
        load::messages::MESSAGES,
        error::MESSAGES,
        monitor::MESSAGES,
    ];
    rooms.iter().copied().flatten().copied().chain(material::messages()).collect()
}
