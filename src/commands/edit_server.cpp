// SPDX-License-Identifier: MIT
#include "commands/edit_server.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <random>

#include "base/output_folder.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "run/apply_edits.hpp"
#include "run/run_state.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

std::string random_token() {
    std::random_device random;  // of the system, not a recording that can be guessed
    std::string token;
    for (int i = 0; i < 4; ++i) token += fmt::format("{:08x}", random());
    return token;
}

/// Compares in a time that does not tell how many bytes were right.
bool same(const std::string& a, const std::string& b) {
    if (a.size() != b.size()) return false;
    unsigned difference = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(b[i]);
    }
    return difference == 0;
}

HttpAnswer text(int status, std::string words) {
    return {status, "text/plain; charset=utf-8",
            std::make_shared<const std::string>(std::move(words))};
}

HttpAnswer json_answer(std::string words) {
    return {200, "application/json", std::make_shared<const std::string>(std::move(words))};
}

Edits edits_of(const fs::path& run) {
    const fs::path file = run / kEditsFile;
    if (fs::exists(file)) return read_edits(file);
    return {load_config({.file = run / "config.toml"}).map.voxel_size, {}};
}

/// While no other process writes into the run.
Applied apply_locked(const fs::path& run) {
    if (fs::exists(run / ".new")) {
        throw ConfigError(run.string() +
                          ": a run is replacing this result, or was killed while it did; finish "
                          "that with `dynamicfilter run ... --resume` first");
    }
    const OutputFolder lock(run, result_files(), Existing::resume);
    return apply_edits(run, edits_of(run), false);
}

}  // namespace

EditServer::EditServer(fs::path run) : run_(std::move(run)), token_(random_token()) {
    refuse_unless_editable(run_);
    edits_of(run_);
}

HttpAnswer EditServer::answer(const HttpRequest& request) const {
    if (!same(request.token, token_)) {
        return text(403, "the token is missing or wrong; open the address that `serve` printed");
    }
    const bool posts = request.method == "POST";
    try {
        if (request.path == "/apply" && posts) {
            const Applied applied = apply_locked(run_);
            return json_answer(fmt::format("{{\"points\": {}, \"changed\": {}}}", applied.points,
                                           applied.changed));
        }
        if (request.path != "/edits") return text(405, "expected POST");
        if (!posts) {
            const Edits edits = edits_of(run_);
            return json_answer(fmt::format("{{\"applied\": {}, \"document\": {}}}",
                                           is_applied(run_, edits), text_of(edits)));
        }
    } catch (const std::exception& error) {
        return text(409, error.what());
    }
    try {
        const Edits edits = parse_edits(request.body, "the page's edits");
        io::write_file(run_ / kEditsFile, text_of(edits));
        return json_answer("{}");
    } catch (const std::exception& error) {
        return text(400, error.what());
    }
}

}  // namespace dynamic_filter::app
