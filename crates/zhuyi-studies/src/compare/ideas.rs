//! What each model goes by, in words, which is what makes it short or strict; the numbers are those of its parameters.
//!
//! Left out: sources and equations, which stand with the models in `zhuyi_metrics::safety_models`.

use zhuyi_metrics::safety_models::SafetyModels;

use zhuyi_batch::text::at_most_two_decimals as number;

/// As the rest of a sentence that begins with the name.
pub(super) fn idea(name: &str, rivals: &SafetyModels) -> String {
    match name {
        "zhuyi" => {
            "knows the future, keeps the margins C1 and C2, and looks no further than the first t_n at which it is behind and slower".to_string()
        }
        "zhuyi-jumps" => {
            "is the same with the paper's jumps, which miss some t_n and so ask for more".to_string()
        }
        "rss" => format!(
            "lets the ego speed up while it responds and then brake by {} m/s2, the actor brake at once by {} m/s2, and is content \
             where either axis is",
            number(rivals.rss.least_brake),
            number(rivals.rss.most_brake)
        ),
        "rss-capped" => {
            let cap = rivals.rss_capped.speed_cap;
            let cap = cap.map_or("no".to_string(), |cap| format!("{} km/h", number(3.6 * cap)));
            format!("is `rss`, but lets an ego above {cap} only hold its speed while it responds")
        }
        "sff" => format!(
            "lets the ego brake by {} m/s2, and the actor by {} m/s2 and keep its heading; a lane change that has not begun and a \
             harder braking are outside it",
            number(rivals.sff.least_decel),
            number(rivals.sff.most_decel)
        ),
        "r157-cut-in" => format!(
            "takes the time to collision at the speeds of the moment less what braking by {} m/s2 takes; a lead as fast as the ego is \
             none",
            number(rivals.cut_in.decel)
        ),
        "r157-driver" => format!(
            "lets the actor go on as it does, and brakes by {} m/s2; a lead that brakes is to it one that keeps its speed",
            number(rivals.driver.decel)
        ),
        "ttc" => format!(
            "takes {} s off the time to collision at the speeds of the moment, whatever braking takes; a lead as fast as the ego is none",
            number(rivals.ttc.threshold)
        ),
        "pylot" => {
            "looks at the ego's speed alone, the same deadline for every actor in view".to_string()
        }
        "visibility" => format!(
            "lets every actor in the lane stand still, brakes by {} m/s2, and sees nobody who is not in the lane or on the way into it",
            number(rivals.visibility.decel)
        ),
        _ => "is a model".to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hand_the_numbers_are_those_of_the_parameters() {
        let mut rivals = SafetyModels::default();
        // 0.774 * 9.81 = 7.593.
        for (name, told) in [
            ("rss-capped", "above 50 km/h only"),
            ("r157-driver", "brakes by 7.59 m/s2;"),
            ("ttc", "takes 2 s off"),
        ] {
            assert!(idea(name, &rivals).contains(told), "{name}");
        }
        rivals.rss.most_brake = 8.0;
        rivals.ttc.threshold = 1.5;
        assert!(
            idea("rss", &rivals).contains("brake by 6 m/s2, the actor brake at once by 8 m/s2")
        );
        assert!(idea("ttc", &rivals).contains("takes 1.5 s off"));
    }
}
