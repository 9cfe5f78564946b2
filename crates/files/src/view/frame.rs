//! A frame as a page gets it: places of the nodes that are seen, one scalar, contact forces, glyphs,
//! sections, obstacles. Taken piece by piece from what is shown, a file that was read or a simulation between
//! two steps; of a model in 3D no more than its skin is asked for, unless it is cut or averaged.

use super::bodies::{Bodies, Topology};
use super::container::Container;
use super::glyphs;
use super::request::{FrameRequest, SectionRequest};
use super::section::{Section, heights};
use super::values::{Colours, joined, range, taken};
use crate::outline::{LineReader, Surface, box_around};
use embate_solver::output::{Outline, Shown};
use serde_json::{Value, json};

/// What is shown on a topology that has its cells; `outlines`: the obstacles as they are drawn. A scalar that
/// is not shown has no values.
#[must_use]
pub fn frame(bodies: &Bodies, topology: &Topology, shown: &dyn Shown, outlines: &[Outline], frame_request: &FrameRequest) -> Container {
    let mut container = Container::default().with("topology", topology.id).with("time", shown.time());
    let places = taken(topology.nodes.iter().copied(), shown.dimension(), |range, room| shown.coordinates(range, room));
    let origin = bodies.origin;
    let place = |own: &[f64]| -> [f32; 3] { std::array::from_fn(|d| own.get(d).map_or(0.0, |x| (x - origin[d]) as f32)) };
    container.floats("positions", places.chunks_exact(shown.dimension().max(1)).flat_map(place).collect());

    let colours = Colours::of(bodies, topology, shown, frame_request);
    let values = colours.as_ref().map(|colours| colours.seen(topology, shown)).unwrap_or_default();
    let mut whole = range(values.iter().copied());
    container.floats("values", values);
    if let Some(section_request) = frame_request.section.as_ref().filter(|_| bodies.dimension == 3) {
        let (sections, inside) = add_sections(&mut container, bodies, topology, shown, colours.as_ref(), section_request);
        whole = joined(whole, inside);
        if let Some(name) = &frame_request.glyphs {
            glyphs::add_to_sections(&mut container, &sections, shown, name);
        }
    }
    if frame_request.arrows {
        add_arrows(&mut container, topology, shown);
    }
    if let Some(name) = &frame_request.glyphs {
        glyphs::add(&mut container, topology, shown, name);
    }
    add_obstacles(&mut container, outlines, origin);
    container
        .with("scalar", colours.as_ref().map(|colours| colours.name))
        .with("location", colours.as_ref().map(Colours::location))
        .with("range", whole.map_or(Value::Null, |range| json!(range)))
}

/// Contact forces, of the nodes that have one.
fn add_arrows(container: &mut Container, topology: &Topology, shown: &dyn Shown) {
    let kinds = shown.kinds();
    let Some(field) = kinds.iter().position(|kind| kind.name == "contact_force") else { return };
    let width = kinds[field].width();
    let forces = taken(topology.nodes.iter().copied(), width, |range, room| shown.values(field, range, room));
    let acting =
        (0..).zip(forces.chunks_exact(width)).filter(|(_, force)| force.iter().any(|f| *f != 0.0) && force.iter().all(|f| f.is_finite()));
    let (own, arrows): (Vec<u32>, Vec<[f32; 3]>) =
        acting.map(|(node, force)| (node, std::array::from_fn(|d| force.get(d).map_or(0.0, |f| *f as f32)))).unzip();
    container.indices("arrow_nodes", own);
    container.floats("arrows", arrows.into_flattened());
}

/// What planes cut of the bodies, one plane after the other; that, and the range of the values.
fn add_sections(
    container: &mut Container,
    bodies: &Bodies,
    topology: &Topology,
    shown: &dyn Shown,
    colours: Option<&Colours<'_>>,
    section_request: &SectionRequest,
) -> (Vec<Section>, Option<[f32; 2]>) {
    let mut coordinates = Vec::new();
    shown.coordinates(0..shown.nodes(), &mut coordinates);
    let scale = section_request.scale();
    let places: Vec<[f64; 3]> =
        (0..).zip(coordinates.as_chunks().0).map(|(node, now): (u32, &[f64; 3])| bodies.scaled(node, *now, scale)).collect();
    let origin = bodies.origin;
    let (mut heads, mut points, mut nodes, mut values) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    let (mut facets, mut cells, mut parts) = (Vec::new(), Vec::new(), Vec::new());
    let cut = |plane| Section::new(&bodies.cells, topology.gone(), &heights(plane, places.iter().copied()));
    let sections: Vec<Section> = section_request.planes.iter().map(cut).collect();
    for (plane, section) in section_request.planes.iter().zip(&sections) {
        let along = |k: usize| {
            let own = section.points.iter().map(|point| point.between(point.nodes.map(|node| places[node as usize][k] - origin[k])));
            section.with_middles(own.collect())
        };
        let [x, y, z] = [0, 1, 2].map(along);
        let first = (points.len() / 3) as u32;
        points.extend(x.iter().zip(&y).zip(&z).flat_map(|((x, y), z)| [*x as f32, *y as f32, *z as f32]));
        nodes.extend(section.points.iter().map(|point| point.nodes[usize::from(point.share > 0.5)]));
        nodes.extend(section.polygons.iter().map(|_| u32::MAX));
        let before = cells.len();
        for (corners, polygon) in section.triangles() {
            facets.extend(corners.map(|corner| first + corner));
            cells.push(polygon.cell);
            parts.push(polygon.part);
        }
        values.extend(colours.map(|colours| colours.cut(section, bodies, shown)).unwrap_or_default());
        heads.push(json!({ "normal": plane.normal(), "offset": plane.offset(), "facets": cells.len() - before }));
    }
    let inside = range(values.iter().copied());
    container.head("sections", heads);
    container.floats("section_points", points);
    container.indices("section_nodes", nodes);
    container.indices("section_facets", facets);
    container.indices("section_cells", cells);
    container.indices("section_parts", parts);
    container.floats("section_values", values);
    (sections, inside)
}

/// Cells that were eroded, ascending.
#[must_use]
pub fn gone(shown: &dyn Shown) -> Vec<u32> {
    let Some(field) = shown.kinds().iter().position(|kind| kind.name == "alive") else { return Vec::new() };
    let mut alive = Vec::new();
    shown.values(field, 0..shown.numbers(field), &mut alive);
    (0..).zip(alive).filter(|(_, alive)| *alive == 0.0).map(|(cell, _)| cell).collect()
}

/// The obstacles as they are drawn: of one without end the piece beside the bodies.
#[must_use]
pub fn outlines(shown: &dyn Shown) -> Vec<Outline> {
    let frame = shown.outlined();
    let near = box_around((0..frame.nodes()).map(|node| frame.place(node))).unwrap_or_default();
    let mut reader = LineReader::default();
    if shown.dimension() == 3 {
        let surfaces = reader.surfaces(&frame).into_iter().map(|surface| surface.piece(near));
        return surfaces.map(|Surface { points, facets, .. }| Outline { points, facets, ..Outline::default() }).collect();
    }
    let near = near.map(|[x, y, _]| [x, y]);
    reader.lines(&frame).iter().map(|line| Outline::line("", line.piece(near))).collect()
}

fn add_obstacles(container: &mut Container, outlines: &[Outline], origin: [f64; 3]) {
    let (mut points, mut lines, mut line_of, mut facets, mut facet_of) = (Vec::new(), Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for (number, outline) in (0u32..).zip(outlines) {
        let first = (points.len() / 3) as u32;
        points.extend(outline.points.iter().flat_map(|p| [0, 1, 2].map(|k| (p[k] - origin[k]) as f32)));
        if outline.facets.is_empty() {
            for k in 1..outline.points.len() as u32 {
                lines.extend([first + k - 1, first + k]);
                line_of.push(number);
            }
        }
        for facet in outline.facets.iter().filter(|facet| facet.iter().all(|&corner| (corner as usize) < outline.points.len())) {
            facets.extend(facet.map(|corner| first + corner));
            facet_of.push(number);
        }
    }
    container.floats("obstacle_points", points);
    container.indices("obstacle_lines", lines);
    container.indices("obstacle_line_of", line_of);
    container.indices("obstacle_facets", facets);
    container.indices("obstacle_facet_of", facet_of);
}

#[cfg(test)]
mod tests {
    use super::*;
    use embate_solver::output::{CellKind, Cells, Field, Frame, field_kind};

    /// Two triangles with a side in common, and a field each of nodes, of cells and of contact forces.
    fn shown() -> (Cells, Frame) {
        let cells = Cells {
            nodes: vec![0, 1, 2, 1, 3, 2],
            offsets: vec![0, 3, 6],
            kinds: vec![CellKind::Triangle; 2],
            parts: vec![0, 1],
            part_names: vec!["a".into(), "b".into()],
            revision: 0,
        };
        let field = |name: &str, values: &[f64]| Field { kind: field_kind(name).unwrap(), values: values.to_vec() };
        let fields = vec![
            field("velocity", &[3.0, 4.0, 0.0, 1.0, 0.0, 0.0, 6.0, 8.0]),
            field("contact_force", &[0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 1.0, 0.0]),
            field("von_mises", &[7.0, f64::NAN]),
        ];
        (cells, Frame { time: 0.5, fields, ..Frame::of(&[[0.0, 0.0], [2.0, 0.0], [0.0, 2.0], [2.0, 2.0]]) })
    }

    fn head(container: &Container) -> Value {
        let bytes = container.bytes();
        let length = u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
        serde_json::from_slice(&bytes[8..8 + length]).unwrap()
    }

    fn floats(container: &Container, name: &str) -> Vec<f32> {
        let (bytes, head) = (container.bytes(), head(container));
        let begin = 8 + u32::from_le_bytes(bytes[4..8].try_into().unwrap()) as usize;
        let number = |key: &str| head["arrays"][name][key].as_u64().unwrap() as usize;
        let own = &bytes[begin + number("offset")..][..4 * number("count")];
        own.chunks_exact(4).map(|b| f32::from_le_bytes(b.try_into().unwrap())).collect()
    }

    fn request(scalar: &str) -> FrameRequest {
        FrameRequest { scalar: Some(scalar.into()), arrows: true, ..FrameRequest::default() }
    }

    fn made(scalar: &str, gone: &[u32]) -> Container {
        let (cells, shown) = shown();
        let bodies = Bodies::new(cells, &shown);
        let outlines = [Outline::line("wall", [[0.0, -1.0], [1.0, -1.0], [2.0, -2.0]])];
        frame(&bodies, &bodies.without(gone), &shown, &outlines, &request(scalar))
    }

    #[test]
    fn positions_and_values_are_those_of_the_nodes_that_are_seen() {
        let container = made("velocity", &[0]);
        assert_eq!(floats(&container, "positions"), [1.0, -1.0, 0.0, -1.0, 1.0, 0.0, 1.0, 1.0, 0.0], "from the middle");
        assert_eq!(floats(&container, "values"), [1.0, 0.0, 10.0]);
        assert_eq!(head(&container)["range"], json!([0.0, 10.0]));
        assert_eq!(floats(&made("velocity.y", &[]), "values"), [4.0, 1.0, 0.0, 8.0]);
    }

    #[test]
    fn values_of_cells_are_those_of_facets_and_what_is_no_number_has_no_part_in_the_range() {
        let container = made("von_mises", &[]);
        assert!(floats(&container, "values")[0] == 7.0 && floats(&container, "values")[1].is_nan());
        assert_eq!(head(&container)["range"], json!([7.0, 7.0]));
        let nothing = made("damage", &[]);
        assert_eq!((head(&nothing)["scalar"].clone(), floats(&nothing, "values").len()), (Value::Null, 0));
    }

    #[test]
    fn arrows_are_those_of_nodes_with_a_force_and_obstacles_are_lines_from_point_to_point() {
        let container = made("velocity", &[]);
        assert_eq!(floats(&container, "arrows"), [0.0, -2.0, 0.0, 1.0, 0.0, 0.0]);
        let head = head(&container);
        assert_eq!((&head["arrays"]["obstacle_lines"]["count"], &head["arrays"]["obstacle_points"]["count"]), (&json!(4), &json!(9)));
    }
}
