//! Who covers whom, row after row.

use zhuyi_core::camera::Sector;
use zhuyi_core::{ActorId, Axes, Footprint, Point, Pose};
use zhuyi_estimator::Watch;

use crate::trace::Row;

/// What the cameras cover at one row after the other. While an actor has gone less far in the frame of the ego than would
/// surely change that, nothing is looked at anew.
pub(super) struct Covered {
    /// As the cameras are mounted, in the frame of the ego.
    sectors: Vec<Sector>,
    actors: Vec<Seen>,
    /// Actor by actor, of each camera.
    views: Vec<Covers>,
}

/// An actor in the frame of the ego.
#[derive(Clone, Copy)]
struct Seen {
    centre: Point,
    /// [m] how far it has gone there, or more.
    gone: f64,
    /// [m] how far it may go until a camera is to be asked anew.
    until: f64,
}

/// Whether a camera covers an actor, surely until that has gone so far [m].
#[derive(Clone, Copy)]
struct Covers {
    holds: bool,
    until: f64,
}

impl Covered {
    /// As nobody has looked yet.
    pub fn by(rig: &[Watch<'_>], actors: usize) -> Self {
        let ego = Axes::new(Pose::default());
        let sector = |watch: &Watch<'_>| Sector::new(watch.camera, watch.camera.pose_on(&ego));
        let unseen = Seen {
            centre: Point::default(),
            gone: 0.0,
            until: f64::NEG_INFINITY,
        };
        let nothing = Covers {
            holds: false,
            until: f64::NEG_INFINITY,
        };
        Self {
            sectors: rig.iter().map(sector).collect(),
            actors: vec![unseen; actors],
            views: vec![nothing; rig.len() * actors],
        }
    }

    /// Looks at a row of the run. Returns whether a camera covers what it did not at the row before, or the other way round.
    pub fn look(&mut self, rig: &[Watch<'_>], row: &Row<'_>) -> bool {
        let mut changed = false;
        let ego = Axes::new(row.ego.pose);
        for (place, (body, seen)) in row.actors.iter().zip(&mut self.actors).enumerate() {
            let (x, y) = ego.local(body.pose.point());
            seen.gone += (x - seen.centre.x).abs() + (y - seen.centre.y).abs();
            seen.centre = Point::new(x, y);
            if seen.gone < seen.until {
                continue;
            }
            let Footprint { length, width } = body.footprint;
            let views = &mut self.views[place * rig.len()..][..rig.len()];
            seen.until = f64::INFINITY;
            for ((sector, watch), view) in self.sectors.iter().zip(rig).zip(views) {
                if seen.gone >= view.until {
                    let plain = sector.holds_plainly(seen.centre, 0.5 * (length + width));
                    let (holds, further) = plain.unwrap_or_else(|| {
                        let looked = watch.camera.covers_body(ego.pose, body);
                        (looked, f64::NEG_INFINITY)
                    });
                    let until = seen.gone + further;
                    changed |= holds != view.holds;
                    *view = Covers { holds, until };
                }
                seen.until = seen.until.min(view.until);
            }
        }
        changed
    }

    /// As [`Camera::covers_body`] of the camera at this place.
    pub fn holds(&self, place: usize, actor: ActorId) -> bool {
        self.views[actor.index() * self.sectors.len() + place].holds
    }
}
