//! Drives in parallel.

use rayon::prelude::*;

/// All of a list, one at a time: drives differ much in length, and of a batch of long ones left at the end one thread would do all
/// while the others wait.
pub fn one_by_one<T: Sync>(all: &[T]) -> impl IndexedParallelIterator<Item = &T> + use<'_, T> {
    all.par_iter().with_max_len(1)
}
