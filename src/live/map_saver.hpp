// SPDX-License-Identifier: MIT
/// Saves the static map of the live filter while it goes on.
#pragma once

#include <cstdint>
#include <filesystem>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "live/session.hpp"

namespace dynamic_filter::live {

/// What came of it.
struct Saved {
    bool is_saved = false;
    std::string text;  ///< as a sentence
    std::filesystem::path file{};
    std::uint64_t points = 0, bytes = 0;
    std::uint64_t request = 0;  ///< the last one that it answers; 0: none
};

/// From now on, SIGUSR1 asks for the map. One for the process.
void catch_save_requests();

/// All functions but request() have one caller; a thread of its own writes. The session must
/// outlive it.
class MapSaver {
public:
    /// `file`: a cloud, by its extension; each save replaces the one before, as a whole. Throws
    /// ConfigError if it cannot be written, or is there already and must not be replaced.
    MapSaver(Session& session, std::filesystem::path file, bool overwrite);
    /// Asks for the map, as SIGUSR1 does; with a name that has no fault, in a file of that name
    /// beside the usual one. Of two requests before the map is written, the later one counts.
    /// Returns the number of the request. May be called in any thread.
    std::uint64_t request(const std::string& name = "");
    /// The name of a file of this format beside the usual one. An empty path stands for the usual
    /// name, an empty format for what the extension of the path says.
    [[nodiscard]] std::string name_of(const std::string& path, const std::string& format) const;
    /// Why there can be no map of this name, in a sentence; "" if there can.
    [[nodiscard]] std::string fault_of(const std::string& name) const;
    /// Begins to save if somebody asked; who asks while the map is written gets it afterwards.
    void run();
    /// Saves the map, and waits until it is written.
    Saved save();
    std::vector<Saved> pop_results();

private:
    void take_result();

    Session& session_;
    std::filesystem::path file_;
    std::mutex lock_;                              // guards the next two
    std::optional<std::filesystem::path> wanted_;  // the file that is asked for
    std::uint64_t requests_ = 0;
    std::future<Saved> running_;
    std::vector<Saved> results_;
};

}  // namespace dynamic_filter::live
