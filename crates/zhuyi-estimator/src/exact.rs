//! The solver `exact`: the first t_n in continuous time (readings R5, R6, R8, R9), no stepping.
//!
//! It walks over the stretches of [t_r, horizon] in order. On each the first x that meets both constraints and the
//! first x of contact are roots of quadratics; whichever comes first decides. What a stretch asks for depends on
//! its zone:
//!
//! | zone | t_n may lie here if | contact ends the search |
//! |---|---|---|
//! | before the first conflict | Eq. 1 and 2 hold | no |
//! | conflict, not yet overlapping sideways | Eq. 1 and 2 hold | no |
//! | conflict, overlapping sideways | Eq. 1 and 2 hold | yes |
//! | after, outside the corridor | there is no contact in the whole of [0, horizon] | no |
//!
//! Law: with `a_b >= -a_0` (always so for C4 >= 1) an ego that reacts earlier is at no time further or faster, so a
//! latency below a tolerable one is tolerable, and the largest one can be found by bisection.

use crate::conflict::Zone;
use crate::ego_motion::EgoMotion;
use crate::encounter::{Encounter, overlap};
use crate::stretch::Outline;

/// What a stretch of conflict ends with.
enum Event {
    Met(f64),
    Contact,
}

/// [s] the first t_n for a reaction time; `None` if there is none.
pub(crate) fn first_time(encounter: &Encounter<'_>, reaction_time: f64) -> Option<f64> {
    let motion = encounter.reaction(reaction_time)?;
    let mut after = None;
    for span in encounter.spans.iter() {
        let Some((from, to)) = overlap(&span, reaction_time, encounter.horizon) else {
            continue;
        };
        if span.zone == Zone::After {
            after = after.or(Some(from));
            continue;
        }
        match first_event(encounter, &motion, span.zone, from, to) {
            None => {}
            Some(Event::Contact) => return None,
            Some(Event::Met(time)) => return Some(earliest(encounter, &motion, after, time)),
        }
    }
    // Nobody touched anybody in the whole horizon.
    after
}

fn first_event(
    encounter: &Encounter<'_>,
    motion: &EgoMotion,
    zone: Zone,
    from: f64,
    to: f64,
) -> Option<Event> {
    let margins = encounter.margins;
    let touching = zone == Zone::Overlap;
    let skip = |outline: &Outline| outline.is_unmet(margins) && (!touching || outline.is_clear());
    encounter.walk(motion, from, to, skip, |stretch| {
        let contact = if touching {
            stretch.first_contact()
        } else {
            None
        };
        match stretch.first_met(margins, contact.unwrap_or(stretch.length)) {
            Some(x) => Some(Event::Met(stretch.start + x)),
            None => contact.map(|_| Event::Contact),
        }
    })
}

/// Both constraints are met at `met`; a time outside the corridor before that counts if no contact comes later
/// either.
fn earliest(encounter: &Encounter<'_>, motion: &EgoMotion, after: Option<f64>, met: f64) -> f64 {
    match after {
        Some(time)
            if encounter
                .first_contact(motion, met, encounter.horizon)
                .is_none() =>
        {
            time
        }
        _ => met,
    }
}
