// SPDX-License-Identifier: MIT
/// Saves the static map of the live filter while it goes on.
#pragma once

#include <filesystem>
#include <future>
#include <string>
#include <vector>

#include "live/session.hpp"

namespace dynamic_filter::live {

/// From now on, SIGUSR1 asks for the map. One for the process.
void catch_save_requests();

/// All functions have one caller; a thread of its own writes. The session must outlive it.
class MapSaver {
public:
    /// `file`: a cloud, by its extension; each save replaces the one before, as a whole.
    MapSaver(Session& session, std::filesystem::path file);
    /// Begins to save if SIGUSR1 came; one that came while the map is written is done afterwards.
    void run();
    /// Saves the map, and waits until it is written.
    void save();
    /// What was saved, or why it was not.
    std::vector<std::string> pop_notices();

private:
    void take_result();

    Session& session_;
    std::filesystem::path file_;
    std::future<std::string> running_;
    std::vector<std::string> notices_;
};

}  // namespace dynamic_filter::live
