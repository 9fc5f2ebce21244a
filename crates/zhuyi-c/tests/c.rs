//! The example, compiled as C and as C++ against the static and the shared library, prints what the Rust estimator
//! answers, bit by bit. Where there is no compiler it says that it skips.

#![cfg(unix)] // The compilers of other systems take other options.

use std::env;
use std::io::ErrorKind;
use std::path::{Path, PathBuf};
use std::process::Command;
use zhuyi_core::{Across, ActorId, Along, Body, Camera, Footprint, Forecast, Frenet, Pose};
use zhuyi_estimator::samples::{self, Sample};
use zhuyi_estimator::{Ego, Estimator, Future, Params, State, Watch};

const CAR: Footprint = Footprint {
    length: 4.5,
    width: 1.8,
};
const EGO: Ego = Ego {
    s: 0.0,
    d: 0.0,
    speed: 20.0,
    accel: 0.0,
    footprint: CAR,
};
const CURRENT_LATENCY: f64 = 1.0 / 30.0;

/// How a language is compiled.
struct Language {
    compiler: &'static str,
    /// The variable in which users name another compiler.
    variable: &'static str,
    flags: &'static [&'static str],
}

const C: Language = Language {
    compiler: "cc",
    variable: "CC",
    flags: &["-std=c11", "-x", "c"],
};
const CPP: Language = Language {
    compiler: "c++",
    variable: "CXX",
    flags: &["-std=c++11", "-x", "c++"],
};

/// Where Cargo puts the libraries when it builds the tests: beside this very test.
fn libraries() -> PathBuf {
    let test = env::current_exe().expect("the path of this test");
    let beside = test.parent().expect("the folder of this test");
    for library in ["libzhuyi_c.a", shared_library()] {
        assert!(
            beside.join(library).is_file(),
            "{library} is not in {}: has the crate lost one of its crate types?",
            beside.display()
        );
    }
    beside.to_path_buf()
}

fn shared_library() -> &'static str {
    if cfg!(target_os = "macos") {
        "libzhuyi_c.dylib"
    } else {
        "libzhuyi_c.so"
    }
}

/// The example as a program in `folder`, or `None` without a compiler.
fn compiled(language: &Language, shared: bool, folder: &Path) -> Option<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let (libraries, program) = (libraries(), folder.join("scene"));
    let compiler = env::var(language.variable).unwrap_or_else(|_| language.compiler.into());
    let mut command = Command::new(&compiler);
    command
        .args(language.flags)
        .args(["-Wall", "-Wextra", "-Werror", "-pedantic", "-I"])
        .arg(root.join("include"))
        .arg(root.join("examples/scene.c"))
        .args(["-x", "none", "-o"])
        .arg(&program);
    if shared {
        command
            .arg(libraries.join(shared_library()))
            .arg(format!("-Wl,-rpath,{}", libraries.display()));
    } else {
        command
            .arg(libraries.join("libzhuyi_c.a"))
            .args(["-lpthread", "-ldl", "-lm"]);
    }
    let output = match command.output() {
        Err(error) if error.kind() == ErrorKind::NotFound => return None,
        output => output.expect("the compiler runs"),
    };
    assert!(
        output.status.success(),
        "{compiler} refuses the example:\n{}",
        String::from_utf8_lossy(&output.stderr)
    );
    Some(program)
}

/// The numbers that the program prints, in order.
fn printed(program: &Path) -> Vec<f64> {
    let output = Command::new(program).output().expect("the example runs");
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8(output.stdout).expect("text");
    text.split(|c: char| c.is_whitespace() || c == ',' || c == ':')
        .filter_map(|word| word.parse().ok())
        .collect()
}

/// The same scene, asked in Rust: state, latency and rate for the car ahead, then number, latency and rate of each
/// camera.
fn expected() -> Vec<f64> {
    let still = |d: f64| {
        vec![Across {
            time: 0.0,
            d,
            d_rate: 0.0,
        }]
    };
    let ahead = zhuyi_core::Trajectory {
        along: vec![
            Along::constant_accel(0.0, 44.5, 20.0, -8.0),
            Along::constant_accel(2.5, 69.5, 0.0, 0.0),
        ],
        across: still(0.0),
        extents: Vec::new(),
        known_until: 20.0,
    };
    let sample = |time: f64, s: f64, d: f64, v: f64| Sample { time, s, d, v };
    let left = samples::trajectory(&[
        sample(0.0, 1.0, 3.5, 26.0),
        sample(2.0, 49.0, 3.5, 22.0),
        sample(4.0, 85.0, 0.0, 14.0),
    ])
    .expect("samples");
    let estimator = Estimator::new(Params::default());

    let future = Future::new(&ahead, 0.0);
    let answer = estimator.trajectory(&EGO, CAR, &future, CURRENT_LATENCY);
    // The car ahead stands 65 m ahead of the ego's front, of which 58.5 m may be used; braking takes 40.816 m. The
    // rest is 0.884 s of reaction, and l + 5 (l - 1/30) <= 0.884 makes l at most 0.1751: 0.175 s on the grid.
    assert_eq!(
        (answer.state, answer.latency),
        (State::Tolerable, Some(0.175))
    );
    let fpr = answer.fpr().expect("a rate");
    let mut numbers = vec![1.0, answer.latency.expect("a latency"), fpr];

    let forecasts = [(0, ahead), (1, left)].map(|(actor, trajectory)| Forecast {
        actor: ActorId(actor),
        footprint: CAR,
        trajectories: vec![(1.0, trajectory)],
    });
    let bodies = [(44.5, 0.0), (1.0, 3.5)].map(|(s, d)| Body {
        footprint: CAR,
        road: Frenet { s, d },
        pose: Pose::new(s, d, 0.0),
        turn: 0.0,
        extent: CAR,
        speed: 0.0,
        accel: 0.0,
        s_rate: 0.0,
        d_rate: 0.0,
    });
    let cameras = [
        (1.8, 0.0, 0.0, 150.0),
        (0.5, 0.9, 1.57, 80.0),
        (-2.0, 0.0, 3.1, 80.0),
    ]
    .map(|(forward, left, yaw, range)| Camera {
        name: String::new(),
        forward,
        left,
        yaw,
        fov: 2.0,
        range,
        analysed: true,
    });
    let rig = cameras.each_ref().map(|camera| Watch {
        camera,
        current_latency: CURRENT_LATENCY,
    });
    let actors = (0..).map(ActorId).zip(&bodies);
    let demands = estimator.demands(&rig, Pose::default(), actors, |actor, current_latency| {
        let forecast = &forecasts[actor.index()];
        let answer = estimator.forecast(&EGO, forecast, 0.0, current_latency);
        answer.estimate
    });
    // Three cameras with three different demands, or the comparison would show little.
    assert!(demands[0].fpr > demands[1].fpr && demands[1].fpr > demands[2].fpr);
    for (camera, demand) in demands.iter().enumerate() {
        numbers.extend([camera as f64, demand.latency, demand.fpr]);
    }
    numbers
}

#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn compare(language: &Language) {
    for shared in [false, true] {
        let folder = tempfile::tempdir().expect("a folder");
        match compiled(language, shared, folder.path()) {
            Some(program) => assert_eq!(printed(&program), expected(), "shared: {shared}"),
            None => println!("skipped: there is no compiler {}", language.compiler),
        }
    }
}

#[test]
fn law_the_example_in_c_prints_the_answers_of_rust() {
    compare(&C);
}

#[test]
fn law_the_example_in_cpp_prints_the_answers_of_rust() {
    compare(&CPP);
}
