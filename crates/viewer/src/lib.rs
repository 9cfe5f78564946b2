//! The page on which results and running simulations are looked at, and its server.
//!
//! [`Server`] shows result folders ([`embate_files::view`]) and, while a run continues, what a [`Live`] run
//! reports of it: a [`Tap`] between the simulation and its recorder takes a frame now and then and lets the
//! page pause, stop and keep the run. The page itself is in `page/` (TypeScript) and, built, in `bundle/`,
//! which is part of the program.

mod access;
mod bundle;
mod connections;
mod live;
mod model;
mod routes;
mod server;
mod socket;
mod tap;

pub use live::{Ended, Live};
pub use model::ShownModel;
pub use server::{Address, Content, Server, ViewerError};
pub use tap::Tap;
