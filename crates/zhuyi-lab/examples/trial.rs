#![allow(missing_docs, clippy::all, clippy::pedantic, clippy::unwrap_used, clippy::print_stdout)]
use std::path::Path;
fn main() {
    let dir = std::env::args().nth(1).unwrap();
    let what = std::env::args().nth(2).unwrap_or_default();
    let mut plan = zhuyi_lab::Plan::embedded().unwrap();
    if let Some(r) = std::env::args().nth(3) { plan.rates = r.split(',').map(|x| x.parse().unwrap()).collect(); }
    if let Some(r) = std::env::args().nth(4) { plan.seeds = r.parse().unwrap(); }
    zhuyi_lab::prepare(Path::new(&dir)).unwrap();
    let r = if what == "robustness" { zhuyi_lab::robustness(&plan, &()) } else { zhuyi_lab::reproduce(&plan, &()) };
    r.write(Path::new(&dir)).unwrap();
    println!("{}", r.summary);
}
