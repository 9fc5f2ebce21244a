//! The border between C and Rust: pointers become references and lists here, and nowhere else.
//!
//! C hands over structs of numbers and pointers only, never a `bool` or an enum, so that every pattern of bits is a
//! value that Rust may look at; what the numbers mean is checked afterwards. Results are written last, when nothing
//! of what was read is in use any more: a result may lie in the memory of an argument.

use crate::Status;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// What a pointer points to.
///
/// # Safety
/// If the pointer is not null it is aligned and points to a `T` that nobody changes during the call.
pub(crate) unsafe fn reference<'a, T>(pointer: *const T) -> Result<&'a T, Status> {
    // SAFETY: promised by the caller of this function.
    unsafe { pointer.as_ref() }.ok_or(Status::NullPointer)
}

/// `count` entries from a pointer on; a list without entries may be null.
///
/// # Safety
/// If the pointer is not null and `count` not zero, it is aligned and points to `count` values that nobody changes
/// during the call.
pub(crate) unsafe fn list<'a, T>(pointer: *const T, count: usize) -> Result<&'a [T], Status> {
    if count == 0 {
        return Ok(&[]);
    }
    if pointer.is_null() {
        return Err(Status::NullPointer);
    }
    fits::<T>(count)?;
    // SAFETY: not null, and no larger than any object can be; the rest is promised by the caller of this function.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// Does `work` and writes its result to `out`; a panic ends here, as [`Status::Internal`].
///
/// # Safety
/// If `out` is not null it is aligned and a `T` may be written there.
pub(crate) unsafe fn answer<T>(out: *mut T, work: impl FnOnce() -> Result<T, Status>) -> Status {
    if out.is_null() {
        return Status::NullPointer;
    }
    match guarded(work) {
        Ok(result) => {
            // SAFETY: not null; the rest is promised by the caller of this function.
            unsafe { out.write(result) };
            Status::Ok
        }
        Err(status) => status,
    }
}

/// The same for a list of `count` results; `work` must find no more than that.
///
/// # Safety
/// If `out` is not null it is aligned and `count` values may be written there.
pub(crate) unsafe fn answers<T>(
    out: *mut T,
    count: usize,
    work: impl FnOnce() -> Result<Vec<T>, Status>,
) -> Status {
    if out.is_null() && count > 0 {
        return Status::NullPointer;
    }
    match guarded(work) {
        Ok(results) if results.len() == count => {
            for (place, result) in results.into_iter().enumerate() {
                // SAFETY: not null, and `place` is below `count`; the rest is promised by the caller.
                unsafe { out.add(place).write(result) };
            }
            Status::Ok
        }
        Ok(_) => Status::Internal,
        Err(status) => status,
    }
}

/// Whether `count` values can lie in memory at all.
pub(crate) fn fits<T>(count: usize) -> Result<(), Status> {
    match count.checked_mul(size_of::<T>()) {
        Some(bytes) if isize::try_from(bytes).is_ok() => Ok(()),
        _ => Err(Status::OutOfRange),
    }
}

/// What `work` leaves behind when it panics is looked at by nobody: it has only borrowed what C does not change,
/// and its results are dropped.
fn guarded<T>(work: impl FnOnce() -> Result<T, Status>) -> Result<T, Status> {
    catch_unwind(AssertUnwindSafe(work)).unwrap_or(Err(Status::Internal))
}

#[cfg(test)]
mod tests {
    use super::{answer, answers, list};
    use crate::Status;

    #[test]
    fn hand_a_panic_ends_at_the_border() {
        let mut out = 7;
        // SAFETY: `out` is a local.
        let status = unsafe { answer(&raw mut out, || panic!("as meant by the test")) };
        assert_eq!((status, out), (Status::Internal, 7));
    }

    #[test]
    fn hand_a_list_larger_than_memory_is_refused() {
        let number = 1.0;
        // SAFETY: the list is refused before it is read.
        let list = unsafe { list(&raw const number, usize::MAX) };
        assert_eq!(list, Err(Status::OutOfRange));
    }

    #[test]
    fn hand_nothing_is_written_beyond_the_count() {
        let mut out = [1, 2, 3];
        // SAFETY: `out` has more entries than are written.
        let status = unsafe { answers(out.as_mut_ptr(), 2, || Ok(vec![8, 9])) };
        assert_eq!((status, out), (Status::Ok, [8, 9, 3]));
        // SAFETY: as above.
        let status = unsafe { answers(out.as_mut_ptr(), 1, || Ok(vec![5, 5])) };
        assert_eq!((status, out), (Status::Internal, [8, 9, 3]));
    }
}
