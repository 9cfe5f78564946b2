//! What is built in 3D in a way of its own: rigid parts that turn about any axis.

use super::Builder;
use super::bodies::Bulk;
use crate::model::{Motion, Obstacle};
use crate::rigid::space::Turning;
use crate::rigid::{Body, Drive, Member};

impl Builder<'_, 3> {
    /// See [`crate::build::Builds::rigid_part`].
    pub(crate) fn rigid_part_in_3d(&self, index: usize, motion: &Motion, own: &[(u32, f64)]) -> Body<3> {
        let (part, positions) = (&self.model.parts[index], &self.mesh.positions);
        // The whole mass of the nodes: that of other parts at common nodes belongs to the body.
        let nodes: Vec<u32> = own.iter().map(|&(node, _)| node).collect();
        let faces = self.mesh.faces_of(&nodes);
        let whole: Vec<(u32, f64)> = own.iter().map(|&(node, _)| (node, self.mass[node as usize])).collect();
        let bulk = Bulk::of(&whole, positions);
        let drives = self.drives_in_3d(motion);
        let [u, v, w] = Bulk::of(own, positions).velocity(part, bulk.centre);
        let [around_x, around_y, around_z] = part.spin_vector();
        Body {
            centre: bulk.centre,
            velocity: [u, v, w, around_x, around_y, around_z],
            mass: std::array::from_fn(|k| if k < 3 && drives[k].is_none() { bulk.mass } else { 0.0 }),
            turning: Turning::of_masses(whole.iter().map(|&(node, mass)| (mass, bulk.arm(positions[node as usize])))),
            drives,
            of_elements: true,
            members: self.mesh.parts[index]
                .nodes
                .iter()
                .copied()
                .chain(faces)
                .map(|node| Member { node, arm: bulk.arm(positions[node as usize]) })
                .collect(),
            shared: own.iter().filter(|&&(node, share)| self.mass[node as usize] != share).map(|&(node, _)| node).collect(),
            ..Body::default()
        }
    }

    /// The rigid body of an obstacle with its reference point, m. The one rotation that a model names is that
    /// about z.
    pub(super) fn obstacle_body_in_3d(&self, obstacle: &Obstacle, reference: [f64; 3]) -> Body<3> {
        let drives = self.drives_in_3d(&obstacle.motion);
        let (mass, inertia) = (obstacle.mass.unwrap_or(0.0), obstacle.inertia.unwrap_or(0.0));
        let [u, v, w] = obstacle.velocity;
        Body {
            centre: reference,
            velocity: [u, v, w, 0.0, 0.0, obstacle.spin],
            mass: std::array::from_fn(|k| if k < 3 && drives[k].is_none() { mass } else { 0.0 }),
            // The same about all axes.
            turning: Turning { inertia: [inertia, 0.0, 0.0, inertia, 0.0, inertia], ..Turning::default() },
            drives,
            ..Body::default()
        }
    }

    /// What prescribes the velocities of a body. The one rotation that a model names is that about z; with it
    /// those about the other axes are none.
    fn drives_in_3d(&self, motion: &Motion) -> [Drive; 6] {
        let drive = |drive: &Option<crate::model::Drive>| drive.as_ref().and_then(|drive| self.curves.speed(drive));
        let around = |axis: usize| if axis == 2 { drive(&motion.spin) } else { motion.spin.as_ref().map(|_| Default::default()) };
        let [x, y, z] = motion.velocity.each_ref().map(drive);
        [x, y, z, around(0), around(1), around(2)]
    }
}
