//! The functions of the header with whatever C may hand them: a status for everything, a panic for nothing.
//!
//! - `broken`: thousands of random scenes, most of them broken somewhere;
//! - `pointers`: each pointer null, one after the other; messages, version and threads.
//!
//! `scene` is the scene that both break.

mod broken;
mod pointers;
mod scene;
