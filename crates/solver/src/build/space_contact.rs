//! Contacts between surfaces in 3D: nodes against facets, made from the surfaces that a contact names and
//! from the stiffness of the elements behind them.

use super::contacts::{kind_of, search_of};
use super::outline::{self, Outline};
use super::space_start::Meeting;
use super::{Builder, law_of, manner, source_of, stiffness_of, terms_of, terms_of_ties};
use crate::contact::checked::Checked;
use crate::contact::formulation::Passes;
use crate::contact::initial;
use crate::contact::law::{self, Node};
use crate::contact::messages::{ON_SYMMETRY, TIE};
use crate::contact::missed_contacts::MissedContactCheck;
use crate::contact::node_facet::tied::{PendingTies, TiedFacet};
use crate::contact::node_facet::tracker::Tracker;
use crate::contact::node_facet::{NodeFacet, PassInput, Slave};
use crate::contact::obstacle::OutlineShape;
use crate::contact::obstacle::space::{NodeSolid, Outside, Solid, Vector};
use crate::contact::overlap::{Bodies, OverlapCheck, Walls};
use crate::contact::search::registry;
use crate::contact::{Formulation, Tributary};
use crate::error::Fault;
use crate::mesh::surface::SpaceSurface;
use crate::mesh::surface::tributary::{self, Depth};
use crate::model::messages::{NO_DIRECTION, NOT_IN_SPACE};
use crate::model::{self, InitialPenetration, Interface, Obstacle, ObstacleShape, Partners, Penalty, PenaltySource};
use crate::vector::{dot, minus, plus, times, unit};

/// What a contact in 2D may do and one in 3D may not (yet).
fn refused(contact: &model::Contact) -> Option<(&'static str, &'static str, &'static str)> {
    let name = contact.formulation.name();
    if !["double_pass", "single_pass", "pinball"].contains(&name) {
        return Some(("formulation", "there are no segments", "take `double_pass`, `single_pass` or `pinball`"));
    }
    None
}

/// Whether edges meet edges too: a single pass looks at the nodes of one surface alone.
pub(super) fn meets_edges(contact: &model::Contact, passes: Passes) -> bool {
    matches!(contact.partners, Partners::Bodies(_)) || passes.len() > 1
}

impl Builder<'_, 3> {
    /// The body of an obstacle, and what makes springs at it. Faults have paths relative to the obstacle.
    pub(super) fn obstacle_in_3d(&mut self, obstacle: &Obstacle) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        let outside = self.outside_met(obstacle)?;
        match &obstacle.shape {
            ObstacleShape::Triangles(surface) => self.triangles(obstacle, surface, outside),
            _ => self.node_solid(obstacle, &outside),
        }
    }

    /// The outside of the parts that an obstacle meets.
    pub(super) fn outside_met(&self, obstacle: &Obstacle) -> Result<SpaceSurface, Fault> {
        let outside = self.mesh.outside_without(&obstacle.parts, |facet| self.constraints.is_mirror(facet));
        outside.map_err(|fault| Fault { path: "parts".into(), ..fault })
    }

    /// Nodes of the outside (ascending) that an obstacle may press: what a symmetry plane keeps at its
    /// distance from a plane needs no spring.
    pub(super) fn nodes_pressed(&self, obstacle: &Obstacle, outside: &SpaceSurface) -> Vec<u32> {
        let along = if let ObstacleShape::Plane { normal, .. } = obstacle.shape { unit(normal) } else { None };
        let is_held = |node: u32| along.is_some_and(|n| self.constraints.mirror_normals(node).any(|m| dot(m, n).abs() > 1.0 - 1e-12));
        outside.nodes.iter().copied().filter(|&node| !is_held(node)).collect()
    }

    fn node_solid(&mut self, obstacle: &Obstacle, outside: &SpaceSurface) -> Result<(usize, Box<dyn Formulation<3>>), Fault> {
        let (reference, solid, (points, facets)) = self.solid(obstacle)?;
        let Sided { nodes: own, .. } = self.sided(outside, &obstacle.interface);
        let spacing = own.iter().map(|own| own.area.sqrt()).sum::<f64>() / own.len().max(1) as f64;
        let pressed = self.nodes_pressed(obstacle, outside);
        let slave = |(&node, &own): (&u32, &Tributary)| {
            let here = Node { own, other: own.stiffness, share: self.constraints.share(node) };
            let slave = Slave { stiffness: stiffness_of(&obstacle.interface, here, 1), area: own.area, of_mass: 0.0 };
            pressed.binary_search(&node).is_ok().then_some((node, slave))
        };
        let nodes: Vec<_> = outside.nodes.iter().zip(&own).filter_map(slave).collect();
        let body = match self.made.get(&obstacle.name) {
            Some(&body) => body,
            None => {
                let body = self.bodies.add(self.obstacle_body_in_3d(obstacle, reference));
                self.outlines.push(OutlineShape { name: obstacle.name.clone(), body, points, facets });
                body
            }
        };
        let walls = self.of_bodies(&self.bodies_of(outside), |bodies| Walls::new(bodies, &self.mesh.positions), None)?;
        let manner = manner(&obstacle.interface, spacing);
        let surface = Outside { nodes: &nodes, facets: &outside.facets, positions: &self.mesh.positions };
        Ok((body, Box::new(NodeSolid::new(solid, body, surface, manner, Box::new(walls)))))
    }

    /// The shape of an obstacle as its body sees it from a reference point (m), grown by the distance that it
    /// keeps; points and facets of its outline.
    pub(super) fn solid(&self, obstacle: &Obstacle) -> Result<(Vector, Solid, Outline), Fault> {
        let thickness = obstacle.interface.thickness;
        let far = 20.0 * initial::size(&self.mesh.positions);
        let grown = |radius: f64, hollow: bool| if hollow { radius - thickness } else { radius + thickness };
        let no_direction = |key: &'static str| Fault::new(&NO_DIRECTION, key, "it has no direction", "give a vector such as [0, 0, 1]");
        match obstacle.shape {
            ObstacleShape::Plane { length: Some(_), .. } => {
                Err(Fault::new(&NOT_IN_SPACE, "plane.length", "a plane in 3D has no end", "leave `length` out"))
            }
            ObstacleShape::Plane { point, normal, .. } => {
                let normal = unit(normal).ok_or_else(|| no_direction("plane.normal"))?;
                let reference = obstacle.reference.unwrap_or(point);
                let at = minus(point, reference);
                let solid = Solid::HalfSpace { point: plus(at, times(thickness, normal)), normal };
                Ok((reference, solid, outline::square(at, normal, far)))
            }
            ObstacleShape::Sphere { centre, radius, hollow } => {
                let reference = obstacle.reference.unwrap_or(centre);
                let at = minus(centre, reference);
                let ball = Solid::Ball { centre: at, radius: grown(radius, hollow), is_hollow: hollow };
                Ok((reference, ball, outline::sphere(at, radius, hollow)))
            }
            ObstacleShape::Cylinder { point, axis, radius, hollow } => {
                let axis = unit(axis).ok_or_else(|| no_direction("cylinder.axis"))?;
                let reference = obstacle.reference.unwrap_or(point);
                let at = minus(point, reference);
                let cylinder = Solid::Cylinder { point: at, axis, radius: grown(radius, hollow), is_hollow: hollow };
                Ok((reference, cylinder, outline::cylinder(at, axis, radius, hollow, initial::size(&self.mesh.positions))))
            }
            ObstacleShape::Circle { .. } => {
                Err(Fault::new(&NOT_IN_SPACE, "circle", "there are no circles in 3D", "take `sphere` or `cylinder`"))
            }
            // Made of facets.
            ObstacleShape::Polyline { .. } | ObstacleShape::Triangles(_) => Err(Fault::new(
                &NOT_IN_SPACE,
                "polyline",
                "there are no polylines in 3D",
                "take `plane`, `sphere`, `cylinder` or `stl`, or a rigid part",
            )),
        }
    }

    /// See [`crate::build::Builds::resolve_initial_penetration`].
    pub(crate) fn resolve_initial_penetration_in_3d(&mut self) -> Vec<String> {
        let tolerance = crate::mesh::tolerance(&self.mesh.positions);
        let (mut lines, mut pushed) = (Vec::new(), Vec::new());
        for (i, contact) in self.model.contacts.iter().enumerate() {
            let Interface { initial_penetration, active, .. } = contact.interface;
            // Ties hold what is there; who begins later can't know. Wrong surfaces are reported when contacts
            // are made.
            if refused(contact).is_some() || contact.tied.is_some() || active[0] > 0.0 {
                continue;
            }
            let found = self.look(contact, |look| look.penetrations(&self.mesh.positions, tolerance));
            match initial_penetration {
                InitialPenetration::Ignore => lines.extend(initial::lines(&contact.name, &found, super::start::IGNORED)),
                InitialPenetration::Error => self.faults.extend(initial::faults(&format!("contact[{i}]"), &contact.name, &found)),
                InitialPenetration::PushOut => {
                    lines.extend(initial::lines(&contact.name, &found, super::start::PUSHED));
                    pushed.push(Meeting::Contact(i));
                }
            }
        }
        let (reported, met) = self.obstacles_at_start(tolerance);
        lines.extend(reported);
        pushed.extend(met);
        self.push_out_in_3d(&pushed, tolerance);
        lines.extend(self.inside_triangles(tolerance));
        lines
    }

    /// What makes the springs of a contact, and the number of the terms that they follow. Faults have paths
    /// relative to the contact.
    pub(super) fn node_facet(&mut self, contact: &model::Contact) -> Result<(Box<dyn Formulation<3>>, usize), Vec<Fault>> {
        if let Some((key, message, help)) = refused(contact) {
            return Err(vec![Fault::new(&NOT_IN_SPACE, key, format!("in 3D {message}"), help)]);
        }
        if contact.formulation == model::Formulation::Pinball {
            return self.pinball_in_3d(contact);
        }
        let terms = self.add_terms(terms_of(&contact.interface));
        let (tracker, passes) = self.tracker_in_3d(contact)?;
        let sides: Vec<Sided> = tracker.surfaces().iter().map(|surface| self.sided(surface, &contact.interface)).collect();
        let own = if meets_edges(contact, passes) { 2 } else { 1 };
        let inputs: Vec<PassInput> =
            passes.iter().map(|&(slave, target)| sides[slave].against(&sides[target], &contact.interface, own)).collect();
        let tied = contact.tied.map(|strength| {
            // The element that a node is bound to counts, not the softest of its part.
            let &(_, target) = &passes[0];
            (strength, PassInput { moduli: sides[target].facets.clone(), ..inputs[0].clone() })
        });
        let mirrors = self.mirrors_of(contact, &tracker.surfaces()[0].nodes, &sides[0].nodes);
        let reach = law_of(&contact.interface).reach();
        let with_edges = contact.tied.is_none() && meets_edges(contact, passes);
        let proof = MissedContactCheck::new(
            tracker.surfaces(),
            passes,
            &self.body_of_node,
            &self.mesh.positions,
            with_edges,
            registry::<3>()[0].make,
        );
        let overlap_check = self.overlap_check(tracker.surfaces(), contact)?;
        let inputs = with_thickness(inputs, &overlap_check, tracker.surfaces(), passes);
        let overlap_check =
            if with_edges { moduli(overlap_check, tracker.surfaces(), passes, &inputs) } else { overlap_check.without_nets() };
        let made = NodeFacet::new(tracker, inputs, &contact.interface, reach, &self.mesh.positions).with_proof(proof);
        let Some((strength, input)) = tied else {
            let made = made.with_check(overlap_check);
            let made = if with_edges { made.with_edges((search_of(contact)?.make)()) } else { made };
            return Ok((self.with_images(Box::new(made), mirrors, contact), terms));
        };
        let unborn = PendingTies { search: (search_of(contact)?.make)(), input, thickness: contact.interface.thickness };
        let tie_terms = self.add_terms(terms_of_ties(&contact.interface));
        let mut made = TiedFacet::new(made, unborn, strength, tie_terms);
        if contact.interface.active[0] <= 0.0 && !self.rebuild {
            made.bind(&self.mesh.positions);
            if made.ties().is_none_or(|ties| ties.nodes.is_empty()) {
                let (first, second) = if passes[0].0 == 0 { ("first", "second") } else { ("second", "first") };
                let message = format!("it binds nothing: no node of the {first} surface is within 5 % of a facet's width of the {second}");
                return Err(vec![Fault::new(&TIE, "tied", message, "let the surfaces touch, raise `thickness`, or leave `tied` out")]);
            }
        }
        // What weighs forces has to see those of the ties.
        Ok((Box::new(Checked::new(Box::new(made), overlap_check)), terms))
    }

    /// What looks at the overlaps of the bodies whose surfaces meet.
    pub(super) fn overlap_check(&self, surfaces: &[SpaceSurface], contact: &model::Contact) -> Result<OverlapCheck, Vec<Fault>> {
        let sides: Vec<Vec<u32>> = surfaces.iter().map(|surface| self.bodies_of(surface)).collect();
        let mut all = sides.concat();
        all.sort_unstable();
        all.dedup();
        // A body on both sides meets itself.
        let are_two = sides.len() == 2 && !sides[0].iter().any(|body| sides[1].binary_search(body).is_ok());
        let side_of = |body: u32| u32::from(sides[sides.len() - 1].binary_search(&body).is_ok());
        let ignores_start = initial::is_ignored(&contact.interface) || contact.tied.is_some();
        let make = |bodies: &Bodies<'_>| OverlapCheck::new(bodies, &self.mesh.positions, ignores_start);
        self.of_bodies(&all, make, if are_two { Some(&side_of) } else { None }).map_err(|fault| vec![fault])
    }

    /// Bodies that a surface belongs to, ascending.
    pub(super) fn bodies_of(&self, surface: &SpaceSurface) -> Vec<u32> {
        let mut all: Vec<u32> = surface.facets.iter().map(|facet| self.body_of_node[facet[0] as usize]).collect();
        all.sort_unstable();
        all.dedup();
        all
    }

    /// What is made of the whole outside of some bodies (ascending), of one or two sides.
    pub(super) fn of_bodies<T>(
        &self,
        all: &[u32],
        make: impl Fn(&Bodies<'_>) -> T,
        side_of: Option<&dyn Fn(u32) -> u32>,
    ) -> Result<T, Fault> {
        let body_of = |node: u32| self.body_of_node[node as usize];
        let is_met = |body: u32| all.binary_search(&body).is_ok();
        let parts = self.mesh.parts.iter().filter(|part| part.nodes.iter().any(|&node| is_met(body_of(node))));
        let parts: Vec<String> = parts.map(|part| part.name.clone()).collect();
        let outside = self.mesh.outside_without(&parts, |facet| !is_met(body_of(facet[0])))?;
        let is_mirror = |facet| self.constraints.is_mirror(facet);
        Ok(make(&Bodies { outside: &outside, is_mirror: &is_mirror, body_of: &body_of, side_of }))
    }

    /// What follows the nodes of a contact, and its passes.
    pub(super) fn tracker_in_3d(&self, contact: &model::Contact) -> Result<(Tracker, Passes), Vec<Fault>> {
        let (search, kind) = (search_of(contact)?, kind_of(contact)?);
        let passes = (kind.passes)(contact);
        let surfaces = self.surfaces_in_3d(contact)?;
        Ok((Tracker::new(surfaces, passes, &self.body_of_node, (search.make)(), &self.mesh.positions), passes))
    }

    /// The surfaces of a contact: two, or one that meets itself.
    pub(super) fn surfaces_in_3d(&self, contact: &model::Contact) -> Result<Vec<SpaceSurface>, Vec<Fault>> {
        let is_mirror = |facet: [u32; 4]| self.constraints.is_mirror(facet);
        let whole = |surface: Result<SpaceSurface, Fault>, path: String, what: String| match surface {
            Ok(surface) if surface.facets.is_empty() => {
                Err(Fault::new(&ON_SYMMETRY, path, format!("{what} lies on a symmetry plane altogether"), "name another surface"))
            }
            Ok(surface) => {
                Ok(surface.with_mirrors(|edge| self.constraints.common_mirrors(&edge).collect::<Vec<_>>(), &self.mesh.positions))
            }
            Err(fault) => Err(Fault { path, ..fault }),
        };
        let made: Vec<Result<SpaceSurface, Fault>> = match &contact.partners {
            Partners::Between(between) => (0..)
                .zip(between)
                .map(|(side, name)| whole(self.mesh.surface(name, is_mirror), format!("between[{side}]"), format!("surface \"{name}\"")))
                .collect(),
            Partners::Bodies(parts) => {
                vec![whole(self.mesh.outside_without(parts, is_mirror), "bodies".into(), "the outside of the bodies".into())]
            }
        };
        let (good, faulty): (Vec<_>, Vec<_>) = made.into_iter().partition(Result::is_ok);
        if faulty.is_empty() { Ok(good.into_iter().flatten().collect()) } else { Err(faulty.into_iter().filter_map(Result::err).collect()) }
    }

    /// What a surface has behind it.
    pub(super) fn sided(&self, surface: &SpaceSurface, interface: &Interface) -> Sided {
        let source = source_of(interface);
        let mut softest: Vec<f64> = vec![f64::INFINITY; self.mesh.parts.len()];
        let (mut behind, mut facets) = (Vec::with_capacity(surface.facets.len()), Vec::with_capacity(surface.facets.len()));
        let mut nodes = vec![Tributary::default(); surface.nodes.len()];
        for &facet in &surface.facets {
            let (modulus, part) = self.under(facet).map_or((0.0, 0), |under| {
                let modulus = self.moduli[under.group][usize::from(source == PenaltySource::BulkModulus)] * under.flatness;
                (modulus, self.mesh.groups[under.group].part)
            });
            softest[part] = softest[part].min(modulus);
            behind.push(part);
            facets.push(modulus);
            for (node, area) in tributary::shares::<3>(Depth::Plane, facet, &self.mesh.positions) {
                if let Ok(at) = surface.nodes.binary_search(&node) {
                    nodes[at].area += area;
                    nodes[at].stiffness += area * modulus;
                }
            }
        }
        for (&node, own) in surface.nodes.iter().zip(&mut nodes) {
            own.stiffness /= own.area;
            own.length = own.area;
            own.of_mass = self.of_mass(node, own.area);
            if source == PenaltySource::TimeStep {
                own.stiffness = own.of_mass;
            }
        }
        let mut moduli: Vec<f64> = behind.into_iter().map(|part| softest[part]).collect();
        if source == PenaltySource::TimeStep {
            let of = |node: &u32| surface.nodes.binary_search(node).map_or(f64::INFINITY, |at| nodes[at].stiffness);
            moduli = surface.facets.iter().map(|facet| facet.iter().map(of).fold(f64::INFINITY, f64::min)).collect();
            facets.clone_from(&moduli);
        }
        let lightest = |node: &u32| surface.nodes.binary_search(node).map_or(0.0, |at| nodes[at].of_mass);
        let of_mass = surface.facets.iter().map(|facet| facet.iter().map(lightest).fold(f64::INFINITY, f64::min)).collect();
        let shares = surface.nodes.iter().map(|&node| self.constraints.share(node)).collect();
        Sided { of_mass, nodes, shares, moduli, facets }
    }
}

/// The same with the local thickness of the bodies that an overlap check looks at.
pub(super) fn with_thickness(
    mut inputs: Vec<PassInput>,
    overlap_check: &OverlapCheck,
    surfaces: &[SpaceSurface],
    passes: Passes,
) -> Vec<PassInput> {
    let thickness: Vec<Vec<f64>> = surfaces.iter().map(|surface| overlap_check.thickness_at(&surface.nodes)).collect();
    for (input, &(slave, target)) in inputs.iter_mut().zip(passes) {
        let surface = &surfaces[target];
        let at = |node: &u32| surface.nodes.binary_search(node).map_or(f64::INFINITY, |rank| thickness[target][rank]);
        let facets = surface.facets.iter().map(|facet| facet.iter().map(at).fold(f64::INFINITY, f64::min));
        input.thickness = [thickness[slave].clone(), facets.collect()];
    }
    inputs
}

/// The same overlap check with the pressure stiffness of slaves, Pa/m.
pub(super) fn moduli(mut overlap_check: OverlapCheck, surfaces: &[SpaceSurface], passes: Passes, inputs: &[PassInput]) -> OverlapCheck {
    for (&(slave, _), input) in passes.iter().zip(inputs) {
        for (&node, own) in surfaces[slave].nodes.iter().zip(&input.slaves) {
            let [stiffness, of_mass] = [own.stiffness, own.of_mass].map(|sum| if own.area > 0.0 { sum / own.area } else { 0.0 });
            overlap_check.set_modulus(node, stiffness, of_mass);
        }
    }
    overlap_check
}

/// A surface, and what contact needs of the elements behind it.
pub(super) struct Sided {
    /// What each node stands for.
    pub(super) nodes: Vec<Tributary>,
    /// Part of each that belongs to the model, and not to its images in symmetry planes.
    pub(super) shares: Vec<f64>,
    /// Pressure stiffness κ behind each facet, Pa/m: the softest of its part.
    pub(super) moduli: Vec<f64>,
    /// The same of the element itself.
    pub(super) facets: Vec<f64>,
    /// α m / (dt² A) of the lightest node of each facet, Pa/m.
    pub(super) of_mass: Vec<f64>,
}

impl Sided {
    /// Its nodes as slaves against another surface, in one of so many `passes` that carry the pressure
    /// together.
    pub(super) fn against(&self, target: &Self, interface: &Interface, passes: usize) -> PassInput {
        let penalty = law::penalty::penalty_of(interface);
        let slave = |(&own, &share): (&Tributary, &f64)| {
            let node = Node { own, other: f64::INFINITY, share };
            Slave {
                stiffness: law::penalty::stiffness(penalty, node, passes),
                area: own.area / passes as f64,
                of_mass: law::penalty::share_of_mass(penalty) * own.of_mass * own.area / passes as f64,
            }
        };
        let per_modulus = match penalty {
            Penalty::Automatic { scale, .. } => self.nodes.iter().map(|own| scale * own.area / passes as f64).collect(),
            Penalty::PerNode(_) | Penalty::Pressure(_) => Vec::new(),
        };
        let slaves = self.nodes.iter().zip(&self.shares).map(slave).collect();
        let share = law::penalty::share_of_mass(penalty);
        let of_mass = target.of_mass.iter().map(|of_mass| share * of_mass).collect();
        PassInput { slaves, per_modulus, moduli: target.moduli.clone(), of_mass, ..PassInput::default() }
    }
}
