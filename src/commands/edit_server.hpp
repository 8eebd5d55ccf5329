// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "page/http_server.hpp"

namespace dynamic_filter::app {

/// The editing requests of one run's page; docs/editing.md. Each must carry the token, which only
/// the printed address tells, in the header X-Edit-Token (403).
///
/// GET /edits: {"applied": bool, "document": edits.json}
/// POST /edits: saves the body as edits.json (400 if it is none)
/// POST /apply: rewrites labels and maps; {"points", "changed"} (409 where that cannot be done)
class EditServer {
public:
    /// Throws as refuse_unless_editable(), and InputError where edits.json cannot be read.
    explicit EditServer(std::filesystem::path run);

    [[nodiscard]] const std::string& token() const { return token_; }
    [[nodiscard]] static bool is_meant(const std::string& path) {
        return path == "/edits" || path == "/apply";
    }
    [[nodiscard]] HttpAnswer answer(const HttpRequest& request) const;

private:
    std::filesystem::path run_;
    std::string token_;
};

}  // namespace dynamic_filter::app
