//! What claims 5 to 9 look at, step by step: runs made for them alone.

pub mod course;
pub mod foresight;
pub mod sensitivity;
pub mod throughput;
