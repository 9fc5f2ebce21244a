//! The estimator in a stack of your own: a scene by hand, what each actor and each camera asks for.
//! `cargo run --release -p zhuyi-estimator --example embed`

use zhuyi_core::{ActorId, Camera, Footprint, Forecast, Pose};
use zhuyi_estimator::samples::{Sample, SampleError, trajectory};
use zhuyi_estimator::{Ego, Estimate, Estimator, Moment, Params, Seen, Watch};

#[expect(clippy::print_stdout, reason = "an example shows what it found")]
#[rustfmt::skip]
fn main() -> Result<(), SampleError> {
    let car = Footprint { length: 4.6, width: 1.9 };
    // Ahead, 40 m from centre to centre: drives on at 15 m/s, or brakes at 5 m/s2 to standstill.
    let at = |time: f64, s: f64, d: f64, v: f64| Sample { time, s, d, v };
    let drives_on = trajectory(&[at(0.0, 40.0, 0.0, 15.0), at(4.0, 100.0, 0.0, 15.0)])?;
    let brakes = trajectory(&[at(0.0, 40.0, 0.0, 15.0), at(1.5, 56.9, 0.0, 7.5), at(3.0, 62.5, 0.0, 0.0)])?;
    let lead = Forecast { actor: ActorId(0), footprint: car, trajectories: vec![(0.9, drives_on), (0.1, brakes)] };
    // In the left lane, a little ahead, and staying there.
    let beside = trajectory(&[at(0.0, 6.0, 3.5, 20.0)])?;
    let left = Forecast { actor: ActorId(1), footprint: car, trajectories: vec![(1.0, beside)] };

    let camera = |name: &str, yaw: f64| Camera {
        name: name.into(), forward: 1.5, left: 0.0, yaw, fov: 2.0, range: 150.0, analysed: true,
    };
    let (front, side) = (camera("front", 0.0), camera("left", 1.57));
    let rig = [(&front, 30.0), (&side, 10.0)].map(|(camera, fps)| Watch { camera, current_latency: 1.0 / fps });
    let seen = [(40.0, 0.0, &lead), (6.0, 3.5, &left)]
        .map(|(x, y, forecast)| Seen { pose: Pose::new(x, y, 0.0), forecast });
    let ego = Ego { s: 0.0, d: 0.0, speed: 20.0, accel: 0.0, footprint: car };
    let moment = Moment { ego, pose: Pose::default(), now: 0.0, seen: &seen, rig: &rig };

    let estimator = Estimator::new(Params::default());
    let (mut demands, mut answers) = ([estimator.quiet(); 2], Vec::new());
    estimator.moment(&moment, &mut demands, |answer| answers.push(answer));
    answers.sort_by(|a, b| Estimate::by_importance(&a.forecast.estimate, &b.forecast.estimate));
    for answer in answers {
        println!("{answer:?}");
    }
    for (watch, demand) in rig.iter().zip(demands) {
        println!("{}: {:.1} FPR, asked for by {:?}", watch.camera.name, demand.fpr, demand.actor);
    }
    Ok(())
}
