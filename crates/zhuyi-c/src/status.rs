//! What a call came to. Every refusal of an argument has its own status; the first one found is returned.

use std::ffi::CStr;

/// What a call came to.
#[repr(u32)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Status {
    /// Done; what was asked for is written.
    Ok = 0,
    /// A pointer is null that must not be.
    NullPointer = 1,
    /// A list has no entries that needs at least one.
    Empty = 2,
    /// A number is NaN or infinite.
    NotFinite = 3,
    /// A number is outside of its range, or a choice is none of its enum.
    OutOfRange = 4,
    /// The times of a list go backwards; those of samples also must not stand still.
    NotSorted = 5,
    /// A defect of the library, not of the call: please report it.
    Internal = 6,
}

impl Status {
    const ALL: [Self; 7] = [
        Self::Ok,
        Self::NullPointer,
        Self::Empty,
        Self::NotFinite,
        Self::OutOfRange,
        Self::NotSorted,
        Self::Internal,
    ];

    const fn message(self) -> &'static CStr {
        match self {
            Self::Ok => c"done",
            Self::NullPointer => c"a pointer is null",
            Self::Empty => c"a list is empty",
            Self::NotFinite => c"a number is NaN or infinite",
            Self::OutOfRange => c"a number is outside of its range",
            Self::NotSorted => c"the times of a list are not in order",
            Self::Internal => c"a defect of zhuyi",
        }
    }
}

/// A sentence for a number that may be no status at all.
pub(crate) fn message(status: u32) -> &'static CStr {
    Status::ALL
        .into_iter()
        .find(|known| *known as u32 == status)
        .map_or(c"not a status of zhuyi", Status::message)
}
