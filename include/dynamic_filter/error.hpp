// SPDX-License-Identifier: MIT
/// @file
/// Errors thrown at the boundaries. The message is one sentence for the user: what was found and
/// where, what was expected, what to do.
///
/// - Errors: the core throws ConfigError, and Error for a call out of order; readers throw
///   InputError, writers OutputError. Besides these, all may throw std::bad_alloc, and what starts
///   threads std::system_error.
/// - Ownership: all texts are copied.
/// - Threads: plain data.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace dynamic_filter {

/// What all of them are; thrown itself where none of the others fits.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A setting or an argument is wrong (exit code 2).
struct ConfigError : Error {
    using Error::Error;
};

/// An input cannot be read, or contradicts itself (exit code 3).
/// `where` says the place in the file ("byte 128", "line 3"); empty for the file as a whole.
struct InputError : Error {
    /// what(): "FILE (WHERE): WHAT".
    InputError(const std::filesystem::path& file, const std::string& where, const std::string& what)
        : Error(file.string() + (where.empty() ? "" : " (" + where + ")") + ": " + what) {}
};

/// An output cannot be written (exit code 1).
struct OutputError : Error {
    /// what(): "FILE: WHAT".
    OutputError(const std::filesystem::path& file, const std::string& what)
        : Error(file.string() + ": " + what) {}
};

}  // namespace dynamic_filter
