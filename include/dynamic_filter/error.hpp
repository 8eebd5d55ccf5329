// SPDX-License-Identifier: MIT
/// @file
/// Exceptions of the library. The message is one sentence for the user: what was found and where,
/// what was expected, and what to do next.
///
/// - Errors: the filter throws ConfigError for wrong settings, and Error if functions are called in
///   the wrong order. Readers throw InputError, writers throw OutputError. In addition, every
///   function may throw std::bad_alloc, and functions that start threads may throw
///   std::system_error.
/// - Ownership: the exceptions copy all texts.
/// - Threads: plain data.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace dynamic_filter {

/// Base class of all exceptions of the library. It is thrown itself where none of the classes below
/// fits.
struct Error : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A setting or an argument is wrong (exit code 2).
struct ConfigError : Error {
    using Error::Error;
};

/// An input cannot be read or contradicts itself (exit code 3). `where` names the place in the file
/// ("byte 128", "line 3"); it is empty if the fault concerns the whole file.
struct InputError : Error {
    /// what() returns "FILE (WHERE): WHAT".
    InputError(const std::filesystem::path& file, const std::string& where, const std::string& what)
        : Error(file.string() + (where.empty() ? "" : " (" + where + ")") + ": " + what) {}
};

/// An output cannot be written (exit code 1).
struct OutputError : Error {
    /// what() returns "FILE: WHAT".
    OutputError(const std::filesystem::path& file, const std::string& what)
        : Error(file.string() + ": " + what) {}
};

}  // namespace dynamic_filter
