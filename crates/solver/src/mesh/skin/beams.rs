//! Faces of beams: the outline of the cross-section at each node, and the cells that it sweeps along each
//! element.
//!
//! Where one beam continues another, both have the outline in the plane between them (a mitre), so that their
//! faces meet. Where three and more meet, at sharp angles and where the section changes, each ends with its
//! own outline across it: there they are within each other. All nodes that are as near to such a joint as
//! beams overlap there get one label, so that they don't touch each other; so do the nodes of shells and
//! solids around a beam that is fixed to them. Beams along elements of shells or solids have no faces.

use super::MITRE;
use super::outline::Outline;
use crate::forest::{join, root};
use crate::mesh::cell::CellKind;
use crate::mesh::surface::NONE;
use crate::mesh::{ElementGroup, Mesh, Pieces, sorted, tolerance};
use crate::model::{Image, Model, beam_axes};
use crate::rows::Rows;
use crate::vector::{dot, length, minus, plus, times, unit};
use std::collections::BTreeMap;

type Vector = [f64; 3];

/// Two sections are the same when their corners are no farther apart than this part of the radius: a
/// polygon of a circle may be turned by half a side.
const TWISTED: f64 = 0.3;
/// A mitre goes no farther along an element than this part of its length.
const ALONG: f64 = 0.45;
/// Cosine of the angle between two beams of which one continues the other, from which they make no joint.
const STRAIGHT: f64 = 0.7;
/// Beams are within each other around a joint as far as they overlap there, and a little farther; least sine
/// of half the angle between them, and how far those are that a shell or solid holds, in radii.
const BEYOND: f64 = 1.1;
const SHARP: f64 = 0.05;
const AROUND: f64 = 2.0;

/// An element of beams.
struct Stick {
    nodes: [u32; 2],
    /// Unit vectors along it, and along y and z of its section.
    along: Vector,
    across: [Vector; 2],
    length: f64,
    /// Number of its outline; `None`: it has no faces.
    outline: Option<usize>,
    /// Distance of the farthest corner from the middle, m.
    radius: f64,
}

impl Stick {
    /// Direction away from one of its ends.
    fn away(&self, end: usize) -> Vector {
        if end == 0 { self.along } else { times(-1.0, self.along) }
    }

    /// The corners of its outline as arms from its middle, m.
    fn arms(&self, outline: &Outline) -> Vec<Vector> {
        let arm = |&[y, z]: &[f64; 2]| plus(times(y, self.across[0]), times(z, self.across[1]));
        outline.corners.iter().map(arm).collect()
    }
}

/// The beams of a model.
struct Beams {
    sticks: Vec<Stick>,
    outlines: Vec<Outline>,
    /// Elements at each node, and which of their ends.
    at: Rows<(u32, u8)>,
}

/// What a node of the middle has around it.
enum Around {
    /// One outline for both elements: arms, and number of each corner of the second element among those of
    /// the first.
    Shared(Vec<Vector>, Vec<usize>),
    /// The end of one element on a symmetry plane.
    Mirrored(Vec<Vector>),
    /// Each element has its own.
    Own,
}

/// An arm that is moved along its beam into the plane with a normal.
fn mitred(arm: Vector, along: Vector, normal: Vector) -> Vector {
    minus(arm, times(dot(arm, normal) / dot(along, normal), along))
}

impl Mesh<3> {
    /// Gives beams their faces, and what must not touch around their joints its labels.
    pub(in crate::mesh) fn add_skins_of_beams(&mut self, model: &Model) {
        let is_beam = |group: &ElementGroup| group.kind == CellKind::Line && model.parts[group.part].is_of_beams();
        if !self.groups.iter().any(is_beam) {
            return;
        }
        let first = self.positions.len();
        let middles = self.first_skin_node();
        let held = self.held_by_bodies(middles);
        let beams = self.beams(model, is_beam, &held);
        let planes = self.symmetry_normals(model);
        let mut rings: Vec<[Vec<u32>; 2]> = vec![[Vec::new(), Vec::new()]; beams.sticks.len()];
        let mut joints: Vec<u32> = Vec::new();
        for node in 0..middles as u32 {
            let ends = beams.at.of(node as usize);
            if ends.is_empty() {
                continue;
            }
            let around = beams.around(ends, planes.get(&node).map_or(&[], |planes| planes));
            let is_bent = |[a, b]: [&Stick; 2], [m, n]: [u8; 2]| -dot(a.away(m.into()), b.away(n.into())) < STRAIGHT;
            let bends = match ends {
                &[(a, m), (b, n)] => is_bent([&beams.sticks[a as usize], &beams.sticks[b as usize]], [m, n]),
                _ => ends.len() > 2,
            };
            if bends || held[node as usize] || (ends.len() == 2 && matches!(around, Around::Own)) {
                joints.push(node);
            }
            self.put_rings(&beams, node, ends, around, &mut rings);
        }
        self.put_cells(&beams, &rings, is_beam);
        self.label(model, &beams, &joints, &held, [middles, first]);
    }

    /// Whether each node of the middle is one of shells or solids, too.
    fn held_by_bodies(&self, middles: usize) -> Vec<bool> {
        let mut held = vec![false; middles];
        let cells = self.groups.iter().filter(|group| group.kind.dimension() > 1).flat_map(ElementGroup::cells);
        cells.flat_map(|cell| cell.nodes).for_each(|&node| held[node as usize] = true);
        held
    }

    fn beams(&self, model: &Model, is_beam: impl Fn(&ElementGroup) -> bool, held: &[bool]) -> Beams {
        let (mut sticks, mut outlines) = (Vec::new(), Vec::new());
        for group in self.groups.iter().filter(|group| is_beam(group)) {
            let profile = model.parts[group.part].profile.as_ref();
            let outline = profile.and_then(Outline::of);
            let own = outlines.iter().position(|other| Some(other) == outline.as_ref()).unwrap_or(outlines.len());
            let radius = outline.as_ref().map_or(0.0, Outline::radius);
            let has_faces = outline.is_some();
            if own == outlines.len() {
                outlines.extend(outline);
            }
            for nodes in group.connectivity.as_chunks::<2>().0 {
                let [a, b] = nodes.map(|node| self.positions[node as usize]);
                let along = unit(minus(b, a)).unwrap_or([1.0, 0.0, 0.0]);
                let axes = beam_axes(along, profile.and_then(|profile| profile.up)).or_else(|| beam_axes(along, None));
                let [_, y, z] = axes.unwrap_or_default();
                let is_inside = nodes.iter().all(|&node| held[node as usize]);
                let outline = Some(own).filter(|_| has_faces && !is_inside);
                let length = length(minus(b, a));
                sticks.push(Stick { nodes: *nodes, along, across: [y, z], length, outline, radius });
            }
        }
        let ends = sticks.iter().zip(0..).flat_map(|(stick, k)| [(stick.nodes[0], (k, 0)), (stick.nodes[1], (k, 1))]);
        let at = Rows::new(self.positions.len(), ends.collect::<Vec<_>>().into_iter());
        Beams { sticks, outlines, at }
    }

    /// Adds the nodes of the outlines around a node.
    fn put_rings(&mut self, beams: &Beams, node: u32, ends: &[(u32, u8)], around: Around, rings: &mut [[Vec<u32>; 2]]) {
        let mut ring = |arms: &[Vector], has_middle: bool| -> Vec<u32> {
            let middle = has_middle.then_some([0.0; 3]);
            arms.iter().copied().chain(middle).map(|arm| self.add_skin_node(node, arm)).collect()
        };
        match around {
            Around::Shared(arms, numbers) => {
                let [(one, m), (other, n)] = [ends[0], ends[1]];
                let outline = beams.outline(one);
                let own = ring(&arms, outline.has_middle);
                let mut turned: Vec<u32> = numbers.iter().map(|&k| own[k]).collect();
                turned.extend(own[arms.len()..].iter());
                rings[one as usize][usize::from(m)] = own;
                rings[other as usize][usize::from(n)] = turned;
            }
            Around::Mirrored(arms) => {
                let (one, m) = ends[0];
                rings[one as usize][usize::from(m)] = ring(&arms, beams.outline(one).has_middle);
            }
            Around::Own => {
                for &(stick, end) in ends.iter().filter(|(stick, _)| beams.sticks[*stick as usize].outline.is_some()) {
                    let outline = beams.outline(stick);
                    rings[stick as usize][usize::from(end)] = ring(&beams.sticks[stick as usize].arms(outline), outline.has_middle);
                }
            }
        }
    }

    /// Gives elements their cells, and parts their nodes on faces.
    fn put_cells(&mut self, beams: &Beams, rings: &[[Vec<u32>; 2]], is_beam: impl Fn(&ElementGroup) -> bool) {
        let mut at = 0;
        for group in self.groups.iter_mut().filter(|group| is_beam(group)) {
            let own = &beams.sticks[at..at + group.elements()];
            let outline = own.iter().find_map(|stick| stick.outline).map(|number| &beams.outlines[number]);
            let has_middle = outline.is_some_and(|outline| outline.has_middle);
            let (corners, kind) = if has_middle { (3, CellKind::Wedge) } else { (4, CellKind::Hexahedron) };
            let (mut outer, mut firsts) = (Vec::new(), vec![0]);
            for (stick, ends) in own.iter().zip(&rings[at..]) {
                let pieces = stick.outline.and(outline).map_or(&[][..], |outline| &outline.pieces);
                for piece in pieces {
                    ends.iter().for_each(|ring| outer.extend(piece[..corners].iter().map(|&k| ring[k])));
                }
                firsts.push(firsts[firsts.len() - 1] + pieces.len() as u32);
            }
            at += group.elements();
            (group.outer, group.pieces) = (outer, Pieces { kind, firsts });
        }
        for index in 0..self.parts.len() {
            let groups = self.groups.iter().filter(|group| group.part == index && is_beam(group));
            let faces = sorted(groups.flat_map(|group| &group.outer).copied());
            if !faces.is_empty() {
                self.parts[index].faces = faces;
            }
        }
    }

    /// Labels what must not touch; `held`: which nodes are those of shells or solids, too; numbers of the
    /// first node of a face, and of the first one of a face of beams.
    fn label(&mut self, model: &Model, beams: &Beams, joints: &[u32], held: &[bool], [middles, first]: [usize; 2]) {
        let mut sets: Vec<u32> = (0..middles as u32).collect();
        let mut is_near = vec![false; middles];
        for &node in joints {
            let spokes: Vec<(&Stick, Vector)> = beams
                .at
                .of(node as usize)
                .iter()
                .map(|&(stick, end)| (&beams.sticks[stick as usize], end))
                .map(|(stick, end)| (stick, stick.away(end.into())))
                .collect();
            let mut reach =
                if held[node as usize] { AROUND * spokes.iter().map(|(stick, _)| stick.radius).fold(0.0, f64::max) } else { 0.0 };
            for (k, (one, a)) in spokes.iter().enumerate() {
                for (other, b) in &spokes[..k] {
                    let half = (0.5 * (1.0 - dot(*a, *b))).max(0.0).sqrt().max(SHARP);
                    reach = reach.max(BEYOND * 0.5 * (one.radius + other.radius) / half);
                }
            }
            beams.label_around(node, reach, &mut sets);
            if held[node as usize] {
                self.label_bodies(node, reach, held, &mut sets, &mut is_near);
            }
        }
        self.label_joined(model, beams, &mut sets, &mut is_near);
        self.kin = vec![NONE; self.positions.len()];
        for (node, label) in self.kin.iter_mut().enumerate() {
            let own = node.checked_sub(middles);
            let owner = own.map_or(node, |own| self.skins[own].owner as usize);
            if node >= first || is_near[owner] {
                *label = root(&mut sets, owner as u32);
            }
        }
    }

    /// Labels the nodes of shells and solids that are near a node.
    fn label_bodies(&self, node: u32, reach: f64, held: &[bool], sets: &mut [u32], is_near: &mut [bool]) {
        let from = self.positions[node as usize];
        for other in (0..held.len()).filter(|&other| held[other] && length(minus(self.positions[other], from)) <= reach) {
            join(sets, node, other as u32);
            is_near[other] = true;
        }
    }

    /// The same where beams are joined to others whose nodes are in the same place.
    fn label_joined(&self, model: &Model, beams: &Beams, sets: &mut [u32], is_near: &mut [bool]) {
        let near = 1e3 * tolerance(&self.positions);
        for it in model.joins.iter().filter(|it| it.image == Image::Same) {
            let near = it.tolerance.unwrap_or(near);
            let [Some(ones), Some(others)] = it.between.each_ref().map(|name| self.nodes(name)) else { continue };
            let spokes = |node: u32| beams.at.of(node as usize);
            let radius = |node: u32| spokes(node).iter().map(|&(stick, _)| beams.sticks[stick as usize].radius).fold(0.0, f64::max);
            for &one in &ones {
                for &other in others.iter().filter(|&&other| other != one && !(spokes(one).is_empty() && spokes(other).is_empty())) {
                    let [a, b] = [one, other].map(|node| self.positions[node as usize]);
                    if length(minus(a, b)) > near {
                        continue;
                    }
                    join(sets, one, other);
                    let reach = AROUND * radius(one).max(radius(other));
                    for (node, place) in [(one, a), (other, b)] {
                        beams.label_around(node, reach, sets);
                        if !spokes(node).is_empty() {
                            continue;
                        }
                        // All of the other body that is near.
                        for near in (0..sets.len() as u32).filter(|&k| spokes(k).is_empty()) {
                            if length(minus(self.positions[near as usize], place)) <= reach {
                                join(sets, node, near);
                                is_near[near as usize] = true;
                            }
                        }
                    }
                }
            }
        }
    }
}

impl Beams {
    /// The outline of an element that has one.
    fn outline(&self, stick: u32) -> &Outline {
        &self.outlines[self.sticks[stick as usize].outline.unwrap_or(0)]
    }

    /// What is around a node at these ends of elements, on symmetry planes with these normals.
    fn around(&self, ends: &[(u32, u8)], planes: &[Vector]) -> Around {
        match *ends {
            [one, other] if planes.is_empty() => self.shared(one, other).unwrap_or(Around::Own),
            [(one, end)] if planes.len() == 1 => {
                let stick = &self.sticks[one as usize];
                let cosine = dot(stick.along, planes[0]);
                if stick.outline.is_none() || cosine.abs() * MITRE < 1.0 {
                    return Around::Own;
                }
                let arms = stick.arms(self.outline(one)).into_iter();
                Around::Mirrored(self.narrowed(
                    arms.map(|arm| mitred(arm, stick.away(end.into()), planes[0])).collect(),
                    [stick; 1],
                    planes[0],
                ))
            }
            _ => Around::Own,
        }
    }

    /// The common outline of two elements of which one continues the other.
    fn shared(&self, (one, m): (u32, u8), (other, n): (u32, u8)) -> Option<Around> {
        let [a, b] = [one, other].map(|stick| &self.sticks[stick as usize]);
        let outline = &self.outlines[a.outline.filter(|_| a.outline == b.outline)?];
        let (to, from) = (times(-1.0, a.away(m.into())), b.away(n.into()));
        let normal = unit(plus(to, from))?;
        if dot(to, normal) * MITRE < 1.0 {
            return None;
        }
        let whole: Vec<Vector> = a.arms(outline).into_iter().map(|arm| mitred(arm, to, normal)).collect();
        // As the other element sees them: across it.
        let seen: Vec<Vector> = whole.iter().map(|&arm| minus(arm, times(dot(arm, from), from))).collect();
        let corners = b.arms(outline);
        // The axes of both run the same way round, or not.
        let runs_with = m != n;
        let count = corners.len();
        let number = |k: usize, shift: usize| if runs_with { (k + shift) % count } else { (count + shift - k) % count };
        let off = |shift: usize| (0..count).map(|k| length(minus(seen[number(k, shift)], corners[k]))).fold(0.0, f64::max);
        let shift = (0..count).reduce(|best, shift| if off(shift) < off(best) { shift } else { best })?;
        (off(shift) <= TWISTED * a.radius)
            .then(|| Around::Shared(self.narrowed(whole, [a, b], normal), (0..count).map(|k| number(k, shift)).collect()))
    }

    /// Arms in a plane, made narrower where they go too far along short elements.
    fn narrowed<const N: usize>(&self, arms: Vec<Vector>, sticks: [&Stick; N], normal: Vector) -> Vec<Vector> {
        let bend = unit(minus(sticks[0].along, times(dot(sticks[0].along, normal), normal)));
        let Some(bend) = bend else { return arms };
        let part = |stick: &&Stick| {
            let farthest = arms.iter().map(|arm| dot(*arm, stick.along).abs()).fold(0.0, f64::max);
            if farthest > ALONG * stick.length { ALONG * stick.length / farthest } else { 1.0 }
        };
        let least = sticks.iter().map(part).fold(1.0, f64::min);
        if least == 1.0 { arms } else { arms.iter().map(|arm| minus(*arm, times((1.0 - least) * dot(*arm, bend), bend))).collect() }
    }

    /// Labels the nodes along beams within a way (m) from one of theirs.
    fn label_around(&self, node: u32, reach: f64, sets: &mut [u32]) {
        let mut ways: BTreeMap<u32, f64> = BTreeMap::from([(node, 0.0)]);
        let mut next = vec![node];
        while let Some(from) = next.pop() {
            let way = ways[&from];
            for &(stick, end) in self.at.of(from as usize) {
                let stick = &self.sticks[stick as usize];
                let (to, there) = (stick.nodes[1 - usize::from(end)], way + stick.length);
                if there < reach && ways.get(&to).is_none_or(|known| there < *known) {
                    ways.insert(to, there);
                    next.push(to);
                    join(sets, node, to);
                }
            }
        }
    }
}
