//! Demand over time of one run: a sample every 0.1 s, kept where it differs from the one before.

use zhuyi_core::SimTime;
use zhuyi_estimator::Demand;

/// A camera's demand by one model, from a time on.
#[derive(Clone, Debug, PartialEq)]
pub struct Sample {
    /// From when on.
    pub time: SimTime,
    /// Place of the camera.
    pub camera: usize,
    /// Place of the model.
    pub model: usize,
    /// [FPR] the demand.
    pub fpr: f64,
}

/// Samples in the order of time, cameras and models.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Curve {
    /// Those that differ from the one before of their camera and model, and the first of each.
    pub samples: Vec<Sample>,
    /// The last of each camera and model.
    last: Vec<f64>,
}

impl Curve {
    /// Takes the demands of all models (outer) on all cameras (inner) at a time; those of `cameras` are kept.
    pub fn sample(&mut self, time: SimTime, cameras: &[usize], demands: &[Vec<Demand>]) {
        let first = self.last.is_empty();
        let mut last = Vec::with_capacity(cameras.len() * demands.len());
        for camera in cameras {
            for (model, demands) in demands.iter().enumerate() {
                let fpr = demands[*camera].fpr;
                if first || self.last[last.len()] != fpr {
                    self.samples.push(Sample {
                        time,
                        camera: *camera,
                        model,
                        fpr,
                    });
                }
                last.push(fpr);
            }
        }
        self.last = last;
    }

    /// [FPR] the largest demand of each of `models` within each second, over all cameras. What stood when a second began counts
    /// for it, unless it changed in that very instant.
    pub fn by_second(&self, models: usize) -> Vec<Vec<f64>> {
        let mut seconds: Vec<Vec<f64>> = Vec::new();
        let mut standing: Vec<Vec<(usize, f64)>> = vec![Vec::new(); models];
        for samples in self.samples.chunk_by(|a, b| a.time == b.time) {
            let time = samples[0].time.seconds();
            while seconds.len() as f64 <= time {
                let begins_now = seconds.len() as f64 == time;
                seconds.push(if begins_now {
                    vec![0.0; models]
                } else {
                    largest(&standing)
                });
            }
            for sample in samples {
                let cameras = &mut standing[sample.model];
                let known = cameras
                    .iter_mut()
                    .find(|(camera, _)| *camera == sample.camera);
                match known {
                    Some(known) => known.1 = sample.fpr,
                    None => cameras.push((sample.camera, sample.fpr)),
                }
            }
            if let Some(second) = seconds.last_mut() {
                for (most, now) in second.iter_mut().zip(largest(&standing)) {
                    if now > *most {
                        *most = now;
                    }
                }
            }
        }
        seconds
    }
}

/// [FPR] the largest over the cameras of each model.
fn largest(standing: &[Vec<(usize, f64)>]) -> Vec<f64> {
    let of_model = |cameras: &Vec<(usize, f64)>| {
        let demands = cameras.iter().map(|(_, fpr)| *fpr);
        demands.max_by(f64::total_cmp).unwrap_or(0.0)
    };
    standing.iter().map(of_model).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_the_largest_within_a_second_holds_what_stood_when_it_began() {
        let sample = |ms: i64, camera: usize, fpr: f64| Sample {
            time: SimTime::from_millis(ms),
            camera,
            model: 0,
            fpr,
        };
        // Camera 0 rises to 7 for 0.2 s within second 0 and falls to 2, which stands until it falls to 1 in the midst of
        // second 3; camera 1 asks for 4 from second 4 on, so that the 1 before it counts no more.
        let samples = vec![
            sample(0, 0, 1.0),
            sample(0, 1, 0.5),
            sample(300, 0, 7.0),
            sample(500, 0, 2.0),
            sample(3500, 0, 1.0),
            sample(4000, 1, 4.0),
        ];
        let curve = Curve {
            samples,
            ..Curve::default()
        };
        let seconds: Vec<f64> = curve.by_second(1).iter().map(|of| of[0]).collect();
        assert_eq!(seconds, [7.0, 2.0, 2.0, 2.0, 4.0]);
    }
}
