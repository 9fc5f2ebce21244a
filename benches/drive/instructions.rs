//! Instructions of the simulator, case by case (see [`cases`]), as CSV: `cargo bench --bench drive_instructions`, or
//! `.. -- run` for the cases with that in their name. How they are counted: [`callgrind`].

#[path = "../callgrind.rs"]
mod callgrind;
mod cases;

use callgrind::Failure;
use cases::Case;

#[expect(clippy::print_stdout, reason = "the table is the result")]
fn main() -> Result<(), Failure> {
    let filter = callgrind::filter();
    let asked = |case: &Case| format!("drive/{}", case.name).contains(&filter);
    let cases: Vec<Case> = cases::all().into_iter().filter(asked).collect();
    let ready: Vec<_> = cases.iter().map(|case| &case.ready).collect();
    if let Some(counts) = callgrind::counts("drive_instructions", &ready)? {
        println!("case,steps,instructions");
        for (case, instructions) in cases.iter().zip(counts) {
            println!("drive/{},{},{instructions}", case.name, case.steps);
        }
    }
    Ok(())
}
