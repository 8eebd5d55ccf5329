// SPDX-License-Identifier: MIT
#include "base/say.hpp"

#include <cerrno>
#include <cstring>
#include <string>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {

namespace {

/// After a failure, of which errno has the reason.
void refuse_unless_gone(std::FILE* to) {
    if (errno != EPIPE) {
        const char* const name = to == stdout ? "standard output" : "standard error";
        throw OutputError(name, std::string("cannot be written: ") + std::strerror(errno));
    }
    std::clearerr(to);
}

}  // namespace

void say_text(std::FILE* to, std::string_view text) {
    errno = 0;
    if (std::fwrite(text.data(), 1, text.size(), to) == text.size()) return;
    refuse_unless_gone(to);
}

void finish_saying() {
    errno = 0;
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
    refuse_unless_gone(stdout);
}

}  // namespace dynamic_filter::app
