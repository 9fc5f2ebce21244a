//! What a camera can see: angular widths, and who hides whom.
//!
//! A body is visible when its share ([`zhuyi_core::occlusion`]) is positive and at least the one asked for, and the point
//! of its box nearest to the camera is within range (reading R17).

use zhuyi_core::occlusion::Outline;
use zhuyi_core::{ActorId, Axes, Camera, Footprint, Pose, Scene};

use crate::silhouette::{self, Field, Silhouette};

/// [-] the share of an actor that a camera sees of it, in range or not.
pub fn visible_share(camera: &Camera, scene: &Scene, actor: ActorId) -> f64 {
    let mut view = View::default();
    view.look(camera, scene);
    view.share(actor.index())
}

/// What lies before a camera. Kept and looked through again, it allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct View {
    eye: Axes,
    fov: f64,
    /// Sine and cosine of half of it.
    half_fov: (f64, f64),
    range: f64,
    field: Field,
    boxes: Vec<Option<(Footprint, Pose)>>,
    silhouettes: Vec<Silhouette>,
    /// Of the boxes that have been asked for, with their places.
    outlines: Vec<(usize, Outline)>,
    /// Of those that may hide the one asked for.
    hiders: Vec<Outline>,
}

impl View {
    /// A view with room for so many boxes.
    pub(crate) fn with_room(boxes: usize) -> Self {
        Self {
            boxes: Vec::with_capacity(boxes),
            silhouettes: Vec::with_capacity(boxes),
            outlines: Vec::with_capacity(boxes),
            hiders: Vec::with_capacity(boxes),
            ..Self::default()
        }
    }

    /// Looks through `camera` at the actors of `scene`, which keep their places.
    pub fn look(&mut self, camera: &Camera, scene: &Scene) {
        let boxes = scene.actors.iter().map(|body| (body.footprint, body.pose));
        self.look_at_boxes(camera, scene.ego.pose, boxes);
    }

    /// Looks through `camera` of an ego at `ego` at some boxes, which keep their places.
    pub fn look_at_boxes(
        &mut self,
        camera: &Camera,
        ego: Pose,
        boxes: impl IntoIterator<Item = (Footprint, Pose)>,
    ) {
        self.aim(camera, ego);
        self.find(boxes.into_iter().map(Some));
    }

    /// Aims `camera` of an ego at `ego`, at no boxes yet.
    pub(crate) fn aim(&mut self, camera: &Camera, ego: Pose) {
        if self.fov != camera.fov {
            self.fov = camera.fov;
            self.half_fov = libm::sincos(camera.fov / 2.0);
        }
        let pose = camera.pose(ego);
        // On a straight road the heading stays.
        self.eye = if pose.heading == self.eye.pose.heading {
            Axes { pose, ..self.eye }
        } else {
            Axes::new(pose)
        };
        self.range = camera.range;
        self.field = Field::new(&self.eye, self.half_fov);
    }

    /// Whether a box that nobody stands before is in range and at least `least_share` of it is visible from where it has
    /// been aimed.
    pub(crate) fn sees_alone(
        &mut self,
        footprint: Footprint,
        pose: Pose,
        least_share: f64,
    ) -> bool {
        let alone = self.field.silhouette(footprint, pose);
        if matches!(alone, Silhouette::OutOfView) {
            return false;
        }
        silhouette::sees(&[alone], 0, self.range, least_share).unwrap_or_else(|| {
            self.find([Some((footprint, pose))]);
            self.sees_by_angles(0, least_share)
        })
    }

    /// The field of view where it has been aimed.
    pub(crate) fn field(&self) -> Field {
        self.field
    }

    /// Puts these boxes, in their places, where it has been aimed; none stands for one that is out of view.
    pub(crate) fn find(&mut self, boxes: impl IntoIterator<Item = Option<(Footprint, Pose)>>) {
        self.boxes.clear();
        self.silhouettes.clear();
        self.outlines.clear();
        for placed in boxes {
            let silhouette = |(footprint, pose)| self.field.silhouette(footprint, pose);
            self.silhouettes
                .push(placed.map_or(Silhouette::OutOfView, silhouette));
            self.boxes.push(placed);
        }
    }

    /// Whether the box at this place is in range and at least `least_share` of it is visible; with a least share of 0,
    /// whether it is in range and view, hidden or not.
    #[inline]
    pub fn sees(&mut self, which: usize, least_share: f64) -> bool {
        if matches!(self.silhouettes[which], Silhouette::OutOfView) {
            return false;
        }
        silhouette::sees(&self.silhouettes, which, self.range, least_share)
            .unwrap_or_else(|| self.sees_by_angles(which, least_share))
    }

    fn sees_by_angles(&mut self, which: usize, least_share: f64) -> bool {
        let body = self.outline(which);
        if body.distance > self.range {
            return false;
        }
        if least_share > 0.0 {
            self.share(which) >= least_share
        } else {
            body.in_view(self.fov)
        }
    }

    fn outline(&mut self, which: usize) -> Outline {
        let known = self.outlines.iter().find(|(place, _)| *place == which);
        if let Some((_, outline)) = known {
            return *outline;
        }
        let Some((footprint, pose)) = self.boxes[which] else {
            unreachable!("nobody asks for the outline of a box out of view")
        };
        let outline = Outline::new(self.eye.pose, footprint, pose);
        self.outlines.push((which, outline));
        outline
    }

    /// [-] the visible share of the box at this place, in range or not.
    pub fn share(&mut self, which: usize) -> f64 {
        let body = self.outline(which);
        if !body.in_view(self.fov) {
            return 0.0; // who else is there does not matter
        }
        self.hiders.clear();
        for index in 0..self.boxes.len() {
            if index != which && !self.silhouettes[index].spares(&self.silhouettes[which]) {
                let other = self.outline(index);
                self.hiders.push(other);
            }
        }
        body.visible_share(self.fov, || self.hiders.iter().copied())
    }
}

#[cfg(test)]
mod tests {
    use super::{Silhouette, View};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use zhuyi_core::{Camera, Footprint, Pose};

    #[test]
    fn law_what_is_plain_at_a_look_is_what_the_angles_say() {
        let mut rng = ChaCha8Rng::seed_from_u64(17);
        let mut view = View::default();
        let (mut plain, mut open) = ([0_u32; 2], 0_u32);
        for case in 0..60_000 {
            let camera = Camera {
                name: String::new(),
                forward: rng.random_range(-2.0..2.0),
                left: rng.random_range(-1.0..1.0),
                yaw: rng.random_range(-4.0..4.0),
                fov: rng.random_range(0.1..4.0),
                range: rng.random_range(5.0..200.0),
                analysed: true,
            };
            let mut place = |spread: f64, turn: f64| {
                Pose::new(
                    rng.random_range(-spread..spread),
                    rng.random_range(-8.0..8.0),
                    rng.random_range(-turn..turn),
                )
            };
            let ego = place(2.0, 3.2);
            // Half of the scenes stand in lanes, so that boxes share edges and hide one another exactly.
            let boxes: Vec<_> = (0..5)
                .map(|_| {
                    let mut pose = place(90.0, 0.3);
                    if case % 2 == 0 {
                        (pose.x, pose.y, pose.heading) = (
                            pose.x.round(),
                            3.5 * (pose.y / 3.5).round(),
                            if case % 4 == 0 { 0.0 } else { ego.heading },
                        );
                    }
                    let (length, width) = (4.5, 1.8);
                    (Footprint { length, width }, pose)
                })
                .collect();
            view.look_at_boxes(&camera, ego, boxes);
            // All boxes told by their angles, whatever is plain.
            let mut plainly = view.clone();
            plainly.silhouettes.fill(Silhouette::Open);
            for which in 0..5 {
                assert_eq!(
                    view.share(which),
                    plainly.share(which),
                    "case {case}, box {which}"
                );
                for least in [0.0, 0.3, 0.5, 1.0 - 1e-9, 1.0] {
                    let quick =
                        crate::silhouette::sees(&view.silhouettes, which, view.range, least);
                    let exact = plainly.sees_by_angles(which, least);
                    match quick {
                        Some(seen) => plain[usize::from(seen)] += 1,
                        None => open += 1,
                    }
                    assert!(
                        quick.is_none_or(|seen| seen == exact),
                        "case {case}, box {which}, least {least}: {quick:?} {camera:?} {ego:?} {:?}",
                        view.boxes
                    );
                }
            }
        }
        assert!(plain[0] > 100_000 && plain[1] > 100_000, "{plain:?}");
        assert!(open > 10_000 && open < 600_000, "{open}");
    }
}
