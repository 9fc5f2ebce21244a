//! The registry and what it refuses.

use zhuyi_scheduler::{POLICIES, policy};

#[test]
fn law_every_listed_name_makes_a_policy_of_that_name() {
    for entry in POLICIES {
        let name = entry
            .id
            .replace("CAMERA=RATE,..", "front=10,left=1")
            .replace("COMMAND", "true");
        assert_eq!(policy(&name).unwrap().name(), name);
        assert!(!entry.meaning.is_empty());
        assert_eq!(entry.source.is_empty(), entry.name() == "exec");
    }
}

#[test]
fn hand_what_stands_for_no_policy_is_said_to() {
    for (name, message) in [
        ("", "there is no policy ``"),
        ("Uniform", "there is no policy `Uniform`"),
        ("static", "there is no policy `static`"),
        ("exec", "there is no policy `exec`"),
        (
            "exec: ",
            "`exec:` needs a command, as in `exec:./my-policy`",
        ),
        (
            "static:",
            "`static:` needs CAMERA=RATE,.. such as `static:front=10,left=1`, got ``",
        ),
        (
            "static:front",
            "`static:` needs CAMERA=RATE,.. such as `static:front=10,left=1`, got `front`",
        ),
        (
            "static:front=1,",
            "`static:` needs CAMERA=RATE,.. such as `static:front=10,left=1`, got ``",
        ),
        (
            "static:=1",
            "`static:` needs CAMERA=RATE,.. such as `static:front=10,left=1`, got `=1`",
        ),
        (
            "static:a=x",
            "the rate of `a` must be above 0 and at most 30 frames per second, got `x`",
        ),
        (
            "static:a=0",
            "the rate of `a` must be above 0 and at most 30 frames per second, got `0`",
        ),
        (
            "static:a=31",
            "the rate of `a` must be above 0 and at most 30 frames per second, got `31`",
        ),
        (
            "static:a=NaN",
            "the rate of `a` must be above 0 and at most 30 frames per second, got `NaN`",
        ),
        ("static:a=1,a=2", "`static:` names the camera `a` twice"),
    ] {
        assert_eq!(policy(name).unwrap_err().to_string(), message, "{name}");
    }
}
