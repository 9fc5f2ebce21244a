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
use zhuyi_core::{Across, Along, Body, Frenet, Road};
use zhuyi_estimator::phantom::{Hiders, View, ViewAlong};
use zhuyi_estimator::{Phantom, PhantomParams};
use zhuyi_perception::Eye;

/// [m] between two places.
const SPACING: f64 = 5.0;

/// [-] the share of a place that must be visible, but for rounding.
const WHOLE: f64 = 1.0 - 1e-9;

/// The places ahead of the ego, nearest first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Uncleared {
    places: Vec<Place>,
    begun: bool,
}

#[derive(Clone, Debug)]
struct Place {
    phantom: Phantom,
    cleared: bool,
    /// Of each camera that has it in sight, how many frames it had processed when it came into sight.
    since: Vec<Option<u64>>,
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
        self.places.retain(|place| place.phantom.s >= nearest);
        let mut index = self.places.last().map_or_else(
            || (nearest / SPACING).ceil(),
            |place| place.phantom.s / SPACING + 1.0,
        );
        while index * SPACING <= furthest {
            self.places.push(Place::new(index * SPACING, look));
            index += 1.0;
        }
        let hiders = Hiders::new(look.bodies);
        let mut views: Vec<_> = look.views.iter().copied().map(ViewAlong::new).collect();
        for place in &mut self.places {
            place.look(look, &mut views, &hiders, !self.begun);
        }
        self.begun = true;
    }

    /// The places that are not cleared, nearest first, as phantoms.
    pub fn phantoms(&self) -> impl Iterator<Item = &Phantom> {
        let uncleared = self.places.iter().filter(|place| !place.cleared);
        uncleared.map(|place| &place.phantom)
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
            cleared: false,
            since: vec![None; look.eyes.len()],
        }
    }

    fn look(
        &mut self,
        look: &Look<'_>,
        views: &mut [ViewAlong<'_>],
        hiders: &Hiders<'_>,
        at_start: bool,
    ) {
        if look.bodies.iter().any(|body| self.is_under(body, look)) {
            self.cleared = true;
            self.since.fill(None);
            return;
        }
        let (footprint, pose) = (look.params.footprint, self.phantom.pose);
        let (mut hidden, mut long_enough) = (true, at_start);
        let cameras = look.eyes.iter().zip(views).zip(look.processed);
        for (((eye, view), processed), since) in cameras.zip(&mut self.since) {
            let in_sight =
                view.concerns(footprint, pose) && view.view().shows(footprint, pose, hiders, WHOLE);
            if in_sight {
                hidden = false;
                let first = *since.get_or_insert(*processed);
                long_enough |= processed - first > u64::from(eye.confirm_frames);
            } else {
                *since = None;
            }
        }
        self.cleared = !hidden && (self.cleared || long_enough);
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
    use zhuyi_core::{Camera, Footprint, Pose};
    use zhuyi_perception::OwnErrors;

    const CAR: Footprint = Footprint {
        length: 4.0,
        width: 2.0,
    };

    fn car(s: f64, d: f64) -> Body {
        Body {
            footprint: CAR,
            road: Frenet { s, d },
            pose: Pose::new(s, d, 0.0),
            turn: 0.0,
            extent: CAR,
            speed: 10.0,
            accel: 0.0,
            s_rate: 10.0,
            d_rate: 0.0,
        }
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
            places.phantoms().map(|phantom| phantom.s).collect()
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
