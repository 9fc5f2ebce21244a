//! What one step proves of the steps behind it: that the first latency which has a t_n stays, without looking for it again.
//!
//! Two candidates decide an answer, the first that is tolerable and the one before it, which is refused. At the step of the proof
//! both are tried under a handicap each: the first reacts `later` and counts as `h` further on, the one before reacts `sooner` and
//! counts as `h` further back. If they still are what they were, then so are the real ones at a later step whose motion keeps
//! within the two (index 0: the step of the proof; u: how much faster the ego is than it was to be, w: how much further on):
//!
//! ```text
//!  u_0 = v - (v_0 + a_0 Δ)       u_r = u_0 + (a - a_0) r       w = f - (f_0 + v_0 Δ + a_0 Δ²/2)
//!
//!  still tolerable:   Δ <= later      u_r <= (a_0 + b) (later - Δ)      w + (r + later) max(0, u_0, u_r) <= h
//!  still refused:     Δ <= t_c, r - sooner      u_q >= -(a + b) (sooner + Δ)      h + w - (r + Δ) max(0, -u_0, -u_q) >= (1 - C1) (f - f_0)
//!                     with u_q = u_0 + (a - a_0) (r - sooner - Δ)
//! ```
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | Δ | time since the proof | s |
//! | f | the ego's place and half of both lengths, as far as the actor's does not change: where its front counts | m |
//! | v, a, b | the ego's speed, acceleration and braking | m/s, m/s2, m/s2 |
//! | r | reaction time of the candidate, the same at every step | s |
//! | t_c | when the refused one, handicapped, comes into contact; infinite where it and the actor come to stand without | s |
//!
//! The conditions on u_r and u_q keep the speeds in order from the reaction on. Where the handicapped motion stands by then without
//! having braked, others take their place: the real one stands by then too (tolerable), none (refused).
//!
//! Derivation. While both hold their accelerations the difference of two motions in speed is linear in time, so its largest value
//! lies at an end, and standing does not add to it; between their reactions it changes by the acceleration of the one plus the
//! braking of the other; from then on both brake alike, and it cannot change its sign any more. The first line then keeps the real
//! motion behind the handicapped one up to that one's t_n, and at t_n no faster: what held there holds. The second keeps it ahead,
//! and from the reaction on no slower: it comes into contact no later, and where it met the constraints before, the handicapped one
//! would have; Eq. 1 counts from the ego's place at t_0, which moves on, hence the last term.
//!
//! Who touches nobody in the whole horizon before an actor that leaves for ever is tolerable too, and stays so in the same way. A
//! refused one that comes to stand behind an actor that stands for ever gets no t_n any more.
//!
//! A proof is for an ego that brakes by the same b, keeps its offset and does not go back, and for an actor with one stay in the corridor: one that
//! overlaps sideways with the ego now, up to where it ceases to, or one that is still to enter, up to then and as long as the stay
//! counts (reading R8). Everything else is asked step by step.

use zhuyi_core::Along;

use super::conflict::Zone;
use super::encounter::{Delay, Encounter};
use super::exact;
use super::lines::Lines;
use super::recording::OnlyStay;
use crate::constraints::TOLERANCE;
use crate::ego_motion::{Start, braking_decel};
use crate::{Criterion, Params};

/// The handicaps that are tried, the longest-lived first: a share [-] of the time between the reactions of the two candidates, by
/// which the first reacts later, and h [m].
const LATER: [(f64, f64); 2] = [(0.3, 0.1), (0.12, 0.06)];

/// The same where there is no candidate before, in seconds: mostly there is much room.
const LATER_ALONE: [(f64, f64); 2] = [(4.0, 2.0), (0.5, 0.15)];

/// The handicaps of the one before, which reacts sooner.
const SOONER: [(f64, f64); 2] = [(0.05, 0.15), (0.02, 0.03)];

/// [m, m/s] what rounding may take of any margin, and more.
const GUARD: f64 = 1e-6;

/// That an answer stays while the ego's motion keeps within limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Proof {
    /// The place of the answer among the candidates.
    pub index: usize,
    /// [s] l_0.
    current_latency: f64,
    /// [s] t_0 of the proof.
    now: f64,
    /// [m] f then.
    front: f64,
    held: Start,
    decel: f64,
    stay: Stay,
    tolerable: Tolerable,
    /// None where there is no candidate before.
    refused: Option<Refused>,
}

/// The one stay of the actor in the corridor.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Stay {
    lines: Lines,
    /// [s] on the clock of the recording: when it begins, or when the bodies cease to overlap.
    until: f64,
    /// [m] of one that is to begin: `s` of the actor's front then, as far as the lines do not count it. It counts if the rear of an
    /// ego that holds its acceleration is behind.
    limit: Option<f64>,
}

/// The candidate that is tolerable though it reacts later and counts as further on.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Tolerable {
    reaction_time: f64,
    later: f64,
    handicap: f64,
}

/// The candidate that comes into contact, or never gets a t_n, though it reacts sooner and counts as further back.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Refused {
    reaction_time: f64,
    sooner: f64,
    handicap: f64,
    contact: f64,
}

impl Proof {
    /// That candidate `index` is the answer, and stays it for a while; none where it is not, or will not surely.
    pub fn new(
        encounter: &Encounter<'_>,
        params: &Params,
        index: usize,
        delay: impl Fn(usize) -> Delay,
        current_latency: f64,
    ) -> Option<Self> {
        let (corridor, held) = (encounter.corridor, encounter.corridor.held);
        let provable = params.criterion == Criterion::Paper
            && params.c1 <= 1.0
            && encounter.earlier_is_better();
        if !provable {
            return None;
        }
        let stay = Stay::of(encounter)?;
        // Before an actor that stands for ever, an ego that stands and has no t_n gets none later.
        let all_stand = |before: &Delay| {
            let stands = |piece: &Along| {
                let moves = [piece.s_rate, piece.s_half_accel, piece.v, piece.v_rate];
                moves == [0.0; 4] && piece.time < encounter.datum.now + corridor.horizon
            };
            let motion = encounter.candidate(*before).motion;
            stay.is_for_ever()
                && corridor.swing.is_none_or(|swing| {
                    swing
                        .rests_from()
                        .is_some_and(|time| time < encounter.datum.now + corridor.horizon)
                })
                && corridor.view.future.along.last().is_some_and(stands)
                && motion.stands_from() <= corridor.horizon
        };
        // The t_n or the contact of a candidate under a handicap.
        let tried = |Delay {
                         reaction_time,
                         head_start,
                     },
                     later: f64,
                     further: f64| {
            let delay = Delay {
                reaction_time: reaction_time + later,
                head_start: head_start + further,
            };
            exact::first_tolerable(encounter, Criterion::Paper, 0..1, |_| {
                encounter.candidate(delay)
            })
        };
        let answer = delay(index);
        let before = index.checked_sub(1).map(&delay);
        let (between, handicaps) = match before {
            Some(before) => (before.reaction_time - answer.reaction_time, LATER),
            None => (1.0, LATER_ALONE),
        };
        let refused = match before {
            None => None,
            Some(before) => Some(SOONER.iter().find_map(|(share, handicap)| {
                let sooner = share * between;
                let found = tried(before, -sooner, -handicap);
                let touches = found.unmet_until < corridor.horizon;
                let refused = found.index == 1 && (touches || all_stand(&before));
                refused.then_some(Refused {
                    reaction_time: before.reaction_time,
                    sooner,
                    handicap: *handicap,
                    contact: if touches {
                        found.unmet_until
                    } else {
                        f64::INFINITY
                    },
                })
            })?),
        };
        let tolerable = handicaps.iter().find_map(|(share, handicap)| {
            let later = share * between;
            let holds = tried(answer, later, *handicap).index == 0;
            holds.then_some(Tolerable {
                reaction_time: answer.reaction_time,
                later,
                handicap: *handicap,
            })
        })?;
        Some(Self {
            index,
            current_latency,
            now: encounter.datum.now,
            front: corridor.ego + corridor.lines.reach,
            held,
            decel: encounter.decel,
            stay,
            tolerable,
            refused,
        })
    }

    /// Whether it holds, with the runs of pieces across that it was made with, for an ego that is at `s` [m] and in this motion at
    /// `now`, asked at this l_0.
    #[inline]
    pub fn holds(
        &self,
        params: &Params,
        lines: Lines,
        s: f64,
        held: Start,
        now: f64,
        current_latency: f64,
    ) -> bool {
        let (since, before) = (now - self.now, self.held);
        let front = s + lines.reach;
        let Start { speed, accel } = held;
        let strayed = Strayed {
            since,
            held,
            faster: speed - (before.speed + before.accel * since),
            further: front - (self.front + since * (before.speed + since * (before.accel / 2.0))),
            change: accel - before.accel,
        };
        since >= 0.0
            && front >= self.front
            && before.speed + before.accel * since >= 0.0
            && current_latency == self.current_latency
            && braking_decel(accel, params.c3, params.c4) == self.decel
            && self.decel >= -accel
            && self.stay.holds(lines, s, held, now)
            && self.tolerable.holds(self, &strayed)
            && self.refused.is_none_or(|refused| {
                let needed = (1.0 - params.c1) * (front - self.front);
                refused.holds(self, &strayed, needed)
            })
    }
}

/// How the ego has strayed from the motion that it was to keep.
struct Strayed {
    /// [s] Δ.
    since: f64,
    held: Start,
    /// [m/s] u_0.
    faster: f64,
    /// [m] w.
    further: f64,
    /// [m/s2] a - a_0.
    change: f64,
}

impl Stay {
    fn of(encounter: &Encounter<'_>) -> Option<Self> {
        let corridor = encounter.corridor;
        match corridor.view.only_stay(&corridor.lines)? {
            OnlyStay::UnderWay(until) => Some(Self {
                lines: corridor.lines,
                until,
                limit: None,
            }),
            OnlyStay::ToCome => {
                let entry = encounter.spans().find(|span| span.zone != Zone::Before)?;
                let counts = matches!(entry.zone, Zone::Close | Zone::Overlap);
                counts.then(|| Self {
                    lines: corridor.lines,
                    until: encounter.datum.now + entry.start,
                    limit: Some({
                        let half = corridor.half_along(entry.start);
                        corridor.actor_at(entry.start) + half
                    }),
                })
            }
        }
    }

    /// Whether it is as it was: still under way, or still to come and sure to count.
    #[inline]
    fn holds(&self, lines: Lines, s: f64, held: Start, now: f64) -> bool {
        let left = self.until - now;
        let rear = s - lines.reach;
        let counts = |limit| rear + held.distance(left) + GUARD < limit;
        // When an actor enters or leaves depends on the very lines.
        let same = self.is_for_ever() || self.lines == lines;
        same && left > 0.0 && self.limit.is_none_or(counts)
    }

    /// Whether it does not end.
    fn is_for_ever(&self) -> bool {
        self.until == f64::INFINITY
    }
}

impl Tolerable {
    #[inline]
    fn holds(&self, proof: &Proof, strayed: &Strayed) -> bool {
        let left = self.later - strayed.since;
        let reacting = strayed.faster + strayed.change * self.reaction_time;
        let most = larger(larger(strayed.faster, reacting), 0.0);
        let reaction_time = self.reaction_time + self.later;
        let in_order = if proof.held.speed + proof.held.accel * reaction_time > 0.0 {
            reacting + GUARD <= (proof.held.accel + proof.decel) * left
        } else {
            let Start { speed, accel } = strayed.held;
            speed + accel * (self.reaction_time + left) + GUARD <= 0.0
        };
        left >= 0.0 && in_order && strayed.further + reaction_time * most + GUARD <= self.handicap
    }
}

impl Refused {
    /// `needed` [m]: by how much it must be ahead, as Eq. 1 counts from a place that moves on.
    #[inline]
    fn holds(&self, proof: &Proof, strayed: &Strayed, needed: f64) -> bool {
        let (since, first) = (strayed.since, self.reaction_time - self.sooner);
        let reacting = strayed.faster + strayed.change * (first - since);
        let least = larger(larger(-strayed.faster, -reacting), 0.0);
        let ahead = strayed.further - needed;
        let in_order = proof.held.speed + proof.held.accel * first <= 0.0
            || reacting >= GUARD - (strayed.held.accel + proof.decel) * (self.sooner + since);
        since <= self.contact
            && since <= first
            && in_order
            && self.handicap + ahead - (self.reaction_time + since) * least >= GUARD + TOLERANCE
    }
}

/// The larger of two numbers.
#[inline]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}
