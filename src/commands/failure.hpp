// SPDX-License-Identifier: MIT
/// How the programs end when an exception comes out of them.
#pragma once

#include <fmt/format.h>

#include <functional>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

/// Calls `work`; prints an exception as "PROGRAM: ..." on stderr. Returns the exit code.
inline int guarded(const char* program, const std::function<int()>& work) {
    const auto failed = [program](ExitCode code, const std::exception& error) {
        say(stderr, "{}: {}\n", program, error.what());
        return code;
    };
    try {
        return work();
    } catch (const ConfigError& error) {
        return failed(kUsage, error);
    } catch (const InputError& error) {
        return failed(kInput, error);
    } catch (const std::exception& error) {
        return failed(kInternal, error);
    }
}

}  // namespace dynamic_filter::app
