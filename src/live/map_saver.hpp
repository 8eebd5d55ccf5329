// SPDX-License-Identifier: MIT
/// Saves the static map of the live filter while it goes on.
#pragma once

#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "live/session.hpp"

namespace dynamic_filter::live {

/// What came of it, as a sentence.
struct Saved {
    bool is_saved = false;
    std::string text;
};

/// From now on, SIGUSR1 asks for the map. One for the process.
void catch_save_requests();

/// All functions have one caller; a thread of its own writes. The session must outlive it.
class MapSaver {
public:
    /// `file`: a cloud, by its extension; each save replaces the one before, as a whole. Throws
    /// ConfigError if it cannot be written, or is there already and must not be replaced.
    MapSaver(Session& session, std::filesystem::path file, bool overwrite);
    /// Begins to save if SIGUSR1 came; one that came while the map is written is done afterwards.
    void run();
    /// Saves the map, and waits until it is written.
    Saved save();
    std::vector<Saved> pop_results();

private:
    void take_result();

    Session& session_;
    std::filesystem::path file_;
    std::future<Saved> running_;
    std::vector<Saved> results_;
};

}  // namespace dynamic_filter::live
