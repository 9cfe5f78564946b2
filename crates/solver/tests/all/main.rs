//! Tests of the solver through its public face: contracts that every entry of a registry keeps, and closed forms.

#![allow(clippy::unwrap_used, unreachable_pub)] // a test that meets nothing where something must be shall end there

// What the tests share.
mod bodies;
mod patches;
mod solids;
mod point;

mod adding;
mod bars;
mod blocks;
mod certificate;
mod certificate_in_space;
mod chaboche;
mod conditions;
mod contact;
mod discrete;
mod discrete_in_space;
mod edge_edge;
mod elements;
mod ends;
mod erosion;
mod flush;
mod formulations;
mod extruded;
mod friction;
mod free_bodies;
mod hardening;
mod hourglass;
mod initial;
mod loads;
mod locking;
mod johnson_cook;
mod materials;
mod mixed;
mod models_in_space;
mod nodal_pressure;
mod obstacles;
mod orthotropy;
mod pressed;
mod prestress;
mod pinball_in_space;
mod plasticity;
mod post_mortem;
mod projectiles;
mod projection;
mod rayleigh;
mod restart;
mod revolution;
mod rigid;
mod rubbers;
mod run_control;
mod search;
mod self_contact;
mod shocks;
mod softening;
mod space;
mod steering;
mod stress_states;
mod symmetry_planes;
mod swept;
mod ties_in_space;
mod triangles;
mod trusses;
mod viscosity;
mod warnings;
