//! What the ego can do: the kinematic bicycle on the road's coordinates, its actuators and its tyres.
//!
//! ```text
//!  ds/dt = v cos(ψ + β) / (1 - κ d)      dd/dt = v sin(ψ + β)
//!  dψ/dt = v sin(β) / l_r - κ ds/dt      tan(β) = (l_r / L) tan(δ)
//! ```
//!
//! | symbol | meaning |
//! |---|---|
//! | s, d | centre of the box on the road |
//! | ψ | heading against the road's direction at s |
//! | v, β | speed of the centre and its angle against the heading |
//! | δ | steering angle of the front wheels |
//! | L, l_r | wheelbase, centre to rear axle: L / 2 |
//! | κ | curvature of the reference line at s |
//!
//! Actuators: first-order lag, jerk and rate limits, then the friction circle `a^2 + (v^2 c)^2 <= (μ g)^2`, in which
//! braking goes before cornering. Acceleration and steering angle are constant within a step, so the speed along the
//! path is piecewise linear. Source: Rajamani, Vehicle Dynamics and Control (2012), section 2.2; in road coordinates
//! the same with the reference line's curvature (section 2.5's moving frame). Left out: tyre slip, load transfer, pitch.

use zhuyi_core::geometry::sin_cos;
use zhuyi_core::{Body, Command, Footprint, Frenet, GRAVITY, Pose, Road};

/// The ego's body, actuators and tyres.
#[derive(Clone, Debug, PartialEq)]
pub struct Vehicle {
    /// The box.
    pub footprint: Footprint,
    /// [kg] mass, for the crash.
    pub mass: f64,
    /// [m] front axle to rear axle; the centre of the box lies midway.
    pub wheelbase: f64,
    /// [s] time constant of acceleration and brakes (first order).
    pub accel_lag: f64,
    /// [m/s3] hardest change of acceleration.
    pub max_jerk: f64,
    /// [m/s2] hardest acceleration.
    pub max_accel: f64,
    /// [m/s2] hardest braking.
    pub max_decel: f64,
    /// [-] friction coefficient: acceleration and cornering together stay within it times gravity.
    pub friction: f64,
    /// [s] time constant of the steering (first order).
    pub steering_lag: f64,
    /// [rad] largest steering angle of the front wheels.
    pub max_steering: f64,
    /// [rad/s] fastest change of the steering angle.
    pub max_steering_rate: f64,
}

impl Vehicle {
    /// [rad] β, angle of the centre's velocity against the heading, at a steering angle.
    ///
    /// By hand: the centre lies midway, so tan(β) = tan(δ) / 2.
    /// ```
    /// # use zhuyi_core::Footprint;
    /// # let car = zhuyi_world::Vehicle { footprint: Footprint { length: 4.8, width: 1.9 }, mass: 1800.0, wheelbase: 2.8,
    /// #   accel_lag: 0.1, max_jerk: 50.0, max_accel: 3.0, max_decel: 9.0, friction: 0.9, steering_lag: 0.1,
    /// #   max_steering: 0.6, max_steering_rate: 0.7 };
    /// assert!((car.slip_angle(libm::atan(0.2)) - libm::atan(0.1)).abs() < 1e-15);
    /// ```
    pub fn slip_angle(&self, steering: f64) -> f64 {
        libm::atan(libm::tan(steering) / 2.0)
    }

    /// [1/m] curvature of the centre's path at a steering angle: sin(β) / l_r.
    pub fn path_curvature(&self, steering: f64) -> f64 {
        self.turn(steering).curvature
    }

    /// What a steering angle makes of the way ahead.
    pub fn turn(&self, steering: f64) -> Turn {
        if steering == 0.0 {
            // Straight on.
            return Turn {
                slip: steering,
                curvature: steering,
            };
        }
        let slip = self.slip_angle(steering);
        Turn {
            slip,
            curvature: libm::sin(slip) / (self.wheelbase / 2.0),
        }
    }

    /// [rad] the steering angle that gives a curvature, within the steering's limits; inverse of [`Vehicle::path_curvature`].
    pub fn steering_for(&self, curvature: f64) -> f64 {
        let slip = libm::asin((curvature * self.wheelbase / 2.0).clamp(-0.999, 0.999));
        libm::atan(2.0 * libm::tan(slip)).clamp(-self.max_steering, self.max_steering)
    }

    /// [m/s2] the acceleration that follows on `accel` after `dt` seconds under the command `wanted`.
    fn lagged_accel(&self, accel: f64, wanted: f64, dt: f64) -> f64 {
        let wanted = wanted.clamp(-self.max_decel, self.max_accel);
        let change = (wanted - accel) * (1.0 - libm::exp(-dt / self.accel_lag));
        let limit = self.max_jerk * dt;
        (accel + change.clamp(-limit, limit))
            .clamp(-self.friction * GRAVITY, self.friction * GRAVITY)
    }

    /// [rad] the steering angle that follows on `steering` after `dt` seconds, at most what the tyres hold at `speed` and `accel`.
    fn lagged_steering(
        &self,
        steering: f64,
        curvature: f64,
        speed: f64,
        accel: f64,
        dt: f64,
    ) -> f64 {
        if curvature == 0.0 && steering == 0.0 {
            return 0.0; // straight on, whatever the tyres hold
        }
        let grip = ((self.friction * GRAVITY).powi(2) - accel * accel)
            .max(0.0)
            .sqrt();
        let most = if speed > 0.0 {
            grip / (speed * speed)
        } else {
            f64::INFINITY
        };
        let wanted = self.steering_for(curvature.clamp(-most, most));
        let change = (wanted - steering) * (1.0 - libm::exp(-dt / self.steering_lag));
        let limit = self.max_steering_rate * dt;
        let held = self.steering_for(most);
        (steering + change.clamp(-limit, limit)).clamp(-held, held)
    }
}

/// Where a steering angle leads, the same for a whole step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Turn {
    /// [rad] β, angle of the centre's velocity against the heading.
    pub slip: f64,
    /// [1/m] curvature of the centre's path.
    pub curvature: f64,
}

/// The ego in motion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ego {
    /// Centre of the box.
    pub road: Frenet,
    /// [rad] ψ, heading against the road.
    pub heading: f64,
    /// [m/s] v.
    pub speed: f64,
    /// [m/s2] acceleration, constant within a step.
    pub accel: f64,
    /// [rad] δ, constant within a step.
    pub steering: f64,
}

impl Ego {
    /// Sets the actuators for the next `dt` seconds. The last step of a braking ends exactly at standstill.
    pub fn actuate(&mut self, vehicle: &Vehicle, command: Command, dt: f64) {
        let accel = vehicle.lagged_accel(self.accel, command.accel, dt);
        self.accel = accel.max(-self.speed / dt);
        self.steering =
            vehicle.lagged_steering(self.steering, command.curvature, self.speed, self.accel, dt);
    }

    /// The state `dt` seconds later at constant acceleration and steering angle (one step of the classical Runge-Kutta
    /// method); `turn` is what the steering angle makes of the way.
    #[must_use]
    pub fn advanced(&self, turn: Turn, road: &Road, dt: f64) -> Self {
        if let Some(way) = self.straight_way(turn, road, dt) {
            return way;
        }
        self.advanced_by_steps(turn, road, dt)
    }

    /// The same where it goes straight on: of the four slopes the second and third are one, and none turns the heading.
    #[inline]
    fn straight_way(&self, turn: Turn, road: &Road, dt: f64) -> Option<Self> {
        let Frenet { s, d } = self.road;
        let last = self.speed + self.accel * dt;
        // No slope is greater than both of these.
        let reach = s + dt * (self.speed + last);
        let is_straight = || road.straight_until(s).is_some_and(|end| reach < end);
        if !(turn.curvature == 0.0 && last >= 0.0 && is_straight()) {
            return None;
        }
        let (sin, cos) = sin_cos(self.heading + turn.slip);
        if cos < 0.0 {
            return None;
        }
        let middle = self.speed + self.accel * (dt / 2.0);
        let step = |share: f64| {
            let [k1, k2, k4] = [self.speed, middle, last].map(|speed| speed * share);
            dt / 6.0 * (k1 + 2.0 * (k2 + k2) + k4)
        };
        Some(Self {
            road: Frenet {
                s: s + step(cos),
                d: d + step(sin),
            },
            speed: last.max(0.0),
            ..*self
        })
    }

    /// The same on any way.
    fn advanced_by_steps(&self, turn: Turn, road: &Road, dt: f64) -> Self {
        let mut known = (f64::NAN, (0.0, 1.0));
        // On a straight way the heading stays, and so do its sine and cosine.
        let mut sin_cos = |angle: f64| {
            if angle != known.0 {
                known = (angle, sin_cos(angle));
            }
            known.1
        };
        let mut rate = |s: f64, d: f64, heading: f64, time: f64| {
            let v = self.speed + self.accel * time;
            let curvature = road.curvature(s);
            let (sin, cos) = sin_cos(heading + turn.slip);
            let s_rate = v * cos / (1.0 - curvature * d);
            [s_rate, v * sin, v * turn.curvature - curvature * s_rate]
        };
        let Frenet { s, d } = self.road;
        let h = dt / 2.0;
        let k1 = rate(s, d, self.heading, 0.0);
        let k2 = rate(s + h * k1[0], d + h * k1[1], self.heading + h * k1[2], h);
        let k3 = rate(s + h * k2[0], d + h * k2[1], self.heading + h * k2[2], h);
        let k4 = rate(
            s + dt * k3[0],
            d + dt * k3[1],
            self.heading + dt * k3[2],
            dt,
        );
        let step = |i: usize| dt / 6.0 * (k1[i] + 2.0 * (k2[i] + k3[i]) + k4[i]);
        Self {
            road: Frenet {
                s: s + step(0),
                d: d + step(1),
            },
            heading: self.heading + step(2),
            speed: (self.speed + self.accel * dt).max(0.0),
            ..*self
        }
    }

    /// Where its box is in the world.
    pub fn pose(&self, road: &Road) -> Pose {
        let at = road.world_from_road(self.road);
        Pose::new(at.x, at.y, at.heading + self.heading)
    }

    /// The body as others see it.
    pub fn body(&self, vehicle: &Vehicle, turn: Turn, road: &Road) -> Body {
        let (at, curvature) = road.pose_and_curvature(self.road);
        let (sin, cos) = sin_cos(self.heading + turn.slip);
        Body {
            footprint: vehicle.footprint,
            road: self.road,
            pose: Pose::new(at.x, at.y, at.heading + self.heading),
            turn: self.heading,
            extent: vehicle.footprint.turned(self.heading),
            speed: self.speed,
            accel: self.accel,
            s_rate: self.speed * cos / (1.0 - curvature * self.road.d),
            d_rate: self.speed * sin,
        }
    }

    /// [rad/s] yaw rate.
    pub fn yaw_rate(&self, vehicle: &Vehicle) -> f64 {
        self.speed * vehicle.path_curvature(self.steering)
    }
}

#[cfg(test)]
mod tests;
