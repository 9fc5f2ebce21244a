//! Places on the ego's path that nobody has cleared yet: what was hidden a moment ago and is in sight now is not known to
//! be empty before a car that stood there would have been confirmed (reading R16).
//!
//! ```text
//!            ┌── hidden again ──┐
//!            ▼                  │
//!  hidden ──▶ in sight ──▶ K + 1 frames of one camera processed, nobody confirmed there ──▶ cleared
//!            └───────────── somebody is believed there, or has driven over it ──────────▶ cleared
//! ```
//!
//! A phantom stands at the edge of what no camera sees. When whoever hides the road moves aside, all of it comes into
//! sight at once; a car that stood there would be confirmed K frames later, and until then it asks for as much as before.
//! Without this a demand with phantoms falls at first sight, just when the frames that confirm are to be taken. One frame
//! more than K counts, as one may have been exposed before the place came into sight. What is in sight at the start is
//! cleared: the stack has been running.
//!
//! A place is in sight when all of it is: who hides it is known only as well as it is tracked, and a place that is
//! believed to be half in sight may be hidden yet. Places are [`SPACING`] apart. Left out: what may have moved into a place that was cleared.

use zhuyi_core::approach::{gap, in_the_way};
use zhuyi_core::{Across, Along, Body, Footprint, Frenet, Road};
use zhuyi_estimator::phantom::{Hiders, Sight, View};
use zhuyi_estimator::{Phantom, PhantomParams};
use zhuyi_perception::Eye;

/// [m] between two places.
const SPACING: f64 = 5.0;

/// The places ahead of the ego, nearest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Uncleared {
    places: Vec<Place>,
    /// Of each camera, how it has each place.
    seen: Vec<Vec<Seen>>,
    begun: bool,
}

#[derive(Clone, Debug)]
struct Place {
    phantom: Phantom,
    /// Whether a body, as it stands, is where the phantom would be.
    taken: bool,
    /// By the camera that has had it in sight for longest.
    sighted: Sighted,
    cleared: bool,
}

/// How long a place has been in sight.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sighted {
    /// It is hidden.
    Not,
    Briefly,
    LongEnough,
}

/// How a camera has a place.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// Whether some of it is in view, hidden or not.
    in_view: bool,
    /// If it is in sight, how many frames the camera had processed when it came into sight.
    since: Option<u64>,
}

/// What the ego knows when it looks.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Look<'a> {
    pub road: &'a Road,
    pub eyes: &'a [Eye],
    /// The cameras at this instant.
    pub views: &'a [View<'a>],
    pub ego: &'a Body,
    /// The others as they are believed to be.
    pub bodies: &'a [Body],
    /// Frames that each camera has processed.
    pub processed: &'a [u64],
    pub params: &'a PhantomParams,
}

impl Uncleared {
    /// Looks at every place again, as far as cameras reach.
    pub fn look(&mut self, look: &Look<'_>) {
        let nearest = look.ego.front() + look.params.footprint.length / 2.0;
        let ranges = look.eyes.iter().map(|eye| eye.camera.range);
        let furthest = look.ego.road.s + ranges.fold(0.0, f64::max);
        self.seen.resize_with(look.eyes.len(), Vec::new);
        let passed = |place: &Place| place.phantom.s < nearest;
        let passed = self.places.partition_point(passed);
        self.places.drain(..passed);
        for seen in &mut self.seen {
            seen.drain(..passed);
        }
        let mut index = self.places.last().map_or_else(
            || (nearest / SPACING).ceil(),
            |place| place.phantom.s / SPACING + 1.0,
        );
        while index * SPACING <= furthest {
            self.places.push(Place::new(index * SPACING, look));
            index += 1.0;
        }
        for place in &mut self.places {
            place.taken = look.bodies.iter().any(|body| place.is_under(body, look));
            place.sighted = Sighted::Not;
        }
        let hiders = Hiders::new(look.bodies);
        let cameras = look.eyes.iter().zip(look.views).zip(look.processed);
        for (((eye, view), processed), seen) in cameras.zip(&mut self.seen) {
            seen.resize(self.places.len(), Seen::default());
            let mut sight = Sight::new(view, &hiders);
            for (place, seen) in self.places.iter_mut().zip(seen) {
                place.look(seen, &mut sight, look.params.footprint, *processed, eye);
            }
        }
        for place in &mut self.places {
            place.cleared = place.taken
                || match place.sighted {
                    Sighted::Not => false,
                    Sighted::Briefly => place.cleared || !self.begun,
                    Sighted::LongEnough => true,
                };
        }
        self.begun = true;
    }

    /// The nearest place in view of a camera that is not cleared: its index and its phantom.
    pub fn nearest(&self, camera: usize) -> Option<(usize, &Phantom)> {
        let mut places = self.places.iter().zip(self.seen.get(camera)?).enumerate();
        let nearest = places.find(|(_, (place, seen))| !place.cleared && seen.in_view);
        nearest.map(|(index, (place, _))| (index, &place.phantom))
    }
}

impl Place {
    fn new(s: f64, look: &Look<'_>) -> Self {
        let d = look.ego.road.d;
        Self {
            phantom: Phantom {
                s,
                pose: look.road.world_from_road(Frenet { s, d }),
                along: [Along::constant_accel(0.0, s, look.params.speed, 0.0)],
                across: [Across {
                    time: 0.0,
                    d,
                    d_rate: 0.0,
                }],
            },
            taken: false,
            sighted: Sighted::Not,
            cleared: false,
        }
    }

    /// Looks at it with one camera, which has processed so many frames.
    fn look(
        &mut self,
        seen: &mut Seen,
        sight: &mut Sight<'_>,
        footprint: Footprint,
        processed: u64,
        eye: &Eye,
    ) {
        let pose = self.phantom.pose;
        seen.in_view = sight.concerns(footprint, pose);
        if seen.in_view && !self.taken && sight.shows_all(footprint, pose) {
            let since = *seen.since.get_or_insert(processed);
            let long_enough = processed - since > u64::from(eye.confirm_frames);
            self.sighted = self.sighted.max(if long_enough {
                Sighted::LongEnough
            } else {
                Sighted::Briefly
            });
        } else {
            seen.since = None;
        }
    }

    /// Whether a body, as it stands, is where the phantom would be.
    fn is_under(&self, body: &Body, look: &Look<'_>) -> bool {
        let Frenet { s, d } = body.road;
        let (own, other) = (look.params.footprint, body.extent);
        gap((s - self.phantom.s).abs(), own, other) < 0.0
            && in_the_way(d - self.phantom.across[0].d, own, other, 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use zhuyi_core::Camera;
    use zhuyi_perception::OwnErrors;

    const CAR: Footprint = Footprint {
        length: 4.0,
        width: 2.0,
    };

    fn car(s: f64, d: f64) -> Body {
        Body::aligned(CAR, s, d, 10.0)
    }

    /// The places that are not cleared after each of these, `(lead's d, frames processed)`, with a lead 30 m ahead.
    fn uncleared(looks: &[(f64, u64)]) -> Vec<Vec<f64>> {
        let road = Road::straight(1000.0, 1, 3.5).unwrap();
        let eyes = [Eye {
            camera: Camera {
                name: "front".into(),
                forward: 2.0,
                left: 0.0,
                yaw: 0.0,
                fov: 2.0,
                range: 60.0,
                analysed: true,
            },
            latency: None,
            confirm_frames: 5,
            phase: None,
            own: OwnErrors::default(),
        }];
        let params = PhantomParams {
            footprint: CAR,
            ..PhantomParams::default()
        };
        let ego = car(0.0, 0.0);
        let mut places = Uncleared::default();
        let after = |(d, processed): &(f64, u64)| {
            places.look(&Look {
                road: &road,
                eyes: &eyes,
                views: &eyes.each_ref().map(|eye| View::new(&eye.camera, ego.pose)),
                ego: &ego,
                bodies: &[car(30.0, *d)],
                processed: &[*processed],
                params: &params,
            });
            let uncleared = places.places.iter().filter(|place| !place.cleared);
            uncleared.map(|place| place.phantom.s).collect()
        };
        looks.iter().map(after).collect()
    }

    #[test]
    fn hand_what_was_hidden_is_cleared_by_k_and_one_frames() {
        let found = uncleared(&[(0.0, 10), (3.0, 11), (3.0, 16), (3.0, 17)]);
        // Behind the lead the road is hidden; where it stands nobody else does. It is in sight when the lead has moved
        // aside at frame 11, and cleared by the sixth frame from then on.
        let behind = vec![35.0, 40.0, 45.0, 50.0, 55.0, 60.0];
        assert_eq!(found, [behind.clone(), behind.clone(), behind, vec![]]);
    }

    #[test]
    fn hand_what_is_hidden_again_begins_anew() {
        let found = uncleared(&[(0.0, 0), (3.0, 1), (0.0, 4), (3.0, 5), (3.0, 10), (3.0, 11)]);
        assert_eq!(found[4], found[0]);
        assert!(found[5].is_empty());
        // What was cleared does not stay so behind somebody who moves in front of it.
        assert_eq!(uncleared(&[(3.0, 0), (0.0, 20)])[1], found[0]);
    }

    #[test]
    fn hand_what_is_in_sight_at_the_start_is_cleared() {
        assert!(uncleared(&[(3.0, 0)])[0].is_empty());
    }
}
