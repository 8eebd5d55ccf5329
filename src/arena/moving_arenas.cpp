// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "arena/find.hpp"
#include "arena/rows.hpp"
#include "arena/score_trial.hpp"
#include "arena/twin.hpp"
#include "base/text.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "recording/folders.hpp"
#include "recording/scans.hpp"
#include "recording/truth.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

// SemanticKITTI-MOS.

std::optional<Trial> find_mos(const fs::path& root, const std::string& sequence) {
    auto trial = find_sequence(root, sequence, {"poses.txt"});
    if (!trial) return trial;
    const io::Recording recording = open(trial->data);
    require_whole(*trial, recording);
    const std::size_t labelled = io::scans_with_truth(recording.info()).size();
    if (labelled != recording.size()) {
        throw InputError(trial->data.data / "labels", "",
                         fmt::format("has labels of {} of {} scans; the arena needs all", labelled,
                                     recording.size()));
    }
    trial->notes.push_back(fmt::format("{} scans", recording.size()));
    return trial;
}

// HeLiMOS.

/// The numbers of scans in a list, one a line.
std::set<std::size_t> numbers_in(const fs::path& file) {
    const std::string text = io::read_file(file);
    io::Lines lines(text, file);
    std::set<std::size_t> numbers;
    while (lines.next()) {
        const std::string_view line = io::trim(lines.line());
        if (line.empty()) continue;
        const auto number = io::parse_real(line);
        if (!number || *number < 0 || *number != std::floor(*number)) {
            lines.fail(io::quote(line) + " is no number of a scan");
        }
        numbers.insert(static_cast<std::size_t>(*number));
    }
    return numbers;
}

std::optional<Trial> find_helimos(const fs::path& root, const std::string& sensor) {
    const auto scans = first_folder({root / "Deskewed_LiDAR", root / "deskewed_LiDAR",
                                     root / "KAIST05" / "Deskewed_LiDAR",
                                     root / "KAIST05" / "deskewed_LiDAR", root});
    if (!scans || !io::is_folder(*scans / sensor / "velodyne")) return std::nullopt;
    Trial trial{
        .entry = sensor,
        .data = {
            .data = *scans / sensor, .poses = *scans / sensor / "poses.txt", .format = "kitti"}};
    const std::set<std::size_t> test = numbers_in(*scans / "test.txt");
    const io::Recording recording = open(trial.data);
    require_whole(trial, recording);
    trial.scored = io::scans_with_truth(recording.info());
    if (trial.scored.empty()) {
        throw InputError(*scans / sensor, "", "has no folder labels with a file of any scan");
    }
    for (const std::size_t i : trial.scored) {
        const auto number = io::parse_real(io::stem(recording, i));
        const bool is_test = number && test.contains(static_cast<std::size_t>(*number));
        if (is_test) trial.split.push_back(i);
    }
    if (trial.split.empty()) {
        throw InputError(*scans / "test.txt", "",
                         "names no scan of " + sensor + " that has labels");
    }
    trial.notes.push_back(fmt::format("{} labelled scans, {} of them in test.txt",
                                      trial.scored.size(), trial.split.size()));
    return trial;
}

// MOE.

/// A row for each point: moveable, moving, class; only the second number counts.
Labels truth_of_moe(const io::Recording& recording, std::size_t i, const io::FullScan& scan) {
    const fs::path file = recording.info().root / "label" / (io::stem(recording, i) + ".txt");
    const std::string text = io::read_file(file);
    io::Lines lines(text, file);
    Labels truth;
    while (lines.next()) {
        const auto tokens = io::split_tokens(lines.line());
        if (tokens.empty()) continue;
        const auto moving = tokens.size() > 1 ? io::parse_real(tokens[1]) : std::nullopt;
        if (!moving) lines.fail("expected a row of: moveable, moving, class");
        truth.push_back(*moving > 0.0 ? Label::dynamic : Label::static_);
    }
    if (truth.size() == scan.points.size()) return truth;
    throw InputError(
        file, "",
        fmt::format("has {} rows, but the scan has {} points", truth.size(), scan.points.size()));
}

std::optional<Trial> find_moe(const fs::path& root, const std::string& sequence) {
    const fs::path folder = root / sequence;
    if (!io::is_folder(folder / "pcd")) return std::nullopt;
    for (const char* name : {"gt_poses.txt", "label"}) {
        if (io::present(folder / name)) continue;
        throw InputError(
            folder, "",
            fmt::format("has no {}: a sequence of MOE comes in several archives, which "
                        "are unpacked into one folder",
                        name));
    }
    Trial trial{.entry = sequence,
                .data = {.data = folder, .poses = folder / "gt_poses.txt", .format = "folder"},
                .truth = truth_of_moe};
    const io::Recording recording = open(trial.data);
    require_whole(trial, recording);
    trial.notes.push_back(fmt::format("{} scans", recording.size()));
    return trial;
}

// DOALS.

/// A row of indices.csv: a stamp [ns], then the points of people by their place in the cloud.
struct PeopleInScan {
    double stamp = 0.0;  ///< [s]
    std::vector<std::size_t> points;
    std::string place;  ///< of the row, for messages
};

std::vector<PeopleInScan> read_people(const fs::path& file) {
    const std::string text = io::read_file(file);
    io::Lines lines(text, file);
    std::vector<PeopleInScan> rows;
    while (lines.next()) {
        if (io::trim(lines.line()).empty()) continue;
        PeopleInScan& row = rows.emplace_back();
        row.place = fmt::format("line {}", lines.number());
        bool is_stamp = true;
        for (const std::string_view part : io::split_at(lines.line(), ',')) {
            if (part.empty()) continue;  // a comma ends some rows
            const auto number = io::parse_count(part);
            if (!number) lines.fail(io::quote(part) + " is no whole number");
            if (is_stamp) {
                row.stamp = static_cast<double>(*number) * 1e-9;
            } else {
                row.points.push_back(*number);
            }
            is_stamp = false;
        }
    }
    return rows;
}

/// The scan of each row. Stamps are equal to the nanosecond, but seconds in double are not.
std::vector<std::size_t> scans_of(const std::vector<PeopleInScan>& rows, const fs::path& file,
                                  const std::vector<double>& stamps) {
    constexpr double kSame = 1e-6;  // [s]
    std::vector<std::size_t> scans;
    for (const PeopleInScan& row : rows) {
        const auto next = std::lower_bound(stamps.begin(), stamps.end(), row.stamp - kSame);
        if (next == stamps.end() || *next > row.stamp + kSame) {
            throw InputError(file, row.place,
                             fmt::format("no scan of the bag has the stamp {:.6f} s", row.stamp));
        }
        scans.push_back(static_cast<std::size_t>(next - stamps.begin()));
    }
    return scans;
}

std::optional<Trial> find_doals(const fs::path& root, const std::string& entry) {
    const fs::path folder = root / entry;
    if (!io::is_folder(folder)) return std::nullopt;
    fs::path bag = folder / "bag.bag";
    if (!io::present(bag)) {
        const auto bags = io::list_files(folder, {".bag"});
        if (bags.size() != 1)
            throw InputError(folder, "", "has no bag.bag, and not one other .bag");
        bag = bags.front();
    }
    const fs::path file = folder / "indices.csv";
    Trial trial{.entry = entry,
                .data = {.data = bag, .format = "bag", .topic = "/os1_cloud_node/points"}};
    const auto rows = std::make_shared<const std::vector<PeopleInScan>>(read_people(file));
    const io::Recording recording = open(trial.data);
    if (!recording.info().has_poses) {
        trial.data.poses = kNoPoses;
        trial.notes.emplace_back("poses by own odometry, because the bag has none");
    }
    const auto scans = std::make_shared<const std::vector<std::size_t>>(
        scans_of(*rows, file, recording.info().stamps));
    trial.scored = *scans;
    trial.notes.push_back(fmt::format("{} labelled scans", scans->size()));
    trial.truth = [rows, scans, file](const io::Recording&, std::size_t i,
                                      const io::FullScan& scan) {
        Labels truth(scan.points.size(), Label::static_);
        for (std::size_t r = 0; r < rows->size(); ++r) {
            if ((*scans)[r] != i) continue;
            for (const std::size_t point : (*rows)[r].points) {
                if (point >= truth.size()) {
                    throw InputError(file, (*rows)[r].place,
                                     fmt::format("point {} of {}", point, truth.size()));
                }
                truth[point] = Label::dynamic;
            }
        }
        return truth;
    };
    return trial;
}

}  // namespace

std::vector<Arena> moving_arenas() {
    return {
        {.name = "mos",
         .title = "SemanticKITTI-MOS, sequence 08 (validation)",
         .entries = {"08"},
         .columns = {{"IoU"}},
         .layout = "sequences/08/velodyne, labels, calib.txt, poses.txt",
         .download = "the scans of KITTI's odometry benchmark (cvlibs.net) and SemanticKITTI's "
                     "labels and poses (semantic-kitti.org)",
         .find = find_mos,
         .score = by_moving,
         .write_twin = write_sequence_twin},
        {.name = "helimos",
         .title = "HeLiMOS, four sensors",
         .entries = {"Aeva", "Avia", "Ouster", "Velodyne"},
         .columns = {{"IoU test"}, {"IoU"}, {"SA"}, {"DA"}, {"AA"}},
         .layout = "KAIST05/Deskewed_LiDAR/test.txt and SENSOR/velodyne, labels, poses.txt",
         .download = "HeLiMOS (KAIST), which is CC BY-NC-SA 4.0",
         .find = find_helimos,
         .score = by_moving_and_cover,
         .write_twin = write_helimos_twin},
        {.name = "doals",
         .title = "Urban Dynamic Objects LiDAR (DOALS)",
         .entries = {"station/sequence_1", "station/sequence_2", "shopville/sequence_1",
                     "shopville/sequence_2", "hauptgebaeude/sequence_1", "hauptgebaeude/sequence_2",
                     "niederdorf/sequence_1", "niederdorf/sequence_2"},
         .columns = {{"IoU to 20 m"}, {"IoU"}},
         .layout = "station/sequence_1/bag.bag and indices.csv, and so on",
         .download = "the data set DOALS of ASL, ETH Zurich; Dynablox's download script unpacks it "
                     "so",
         .find = find_doals,
         .score = by_scan,
         .write_twin = write_doals_twin},
        {.name = "moe",
         .title = "MOE",
         .entries = {"00", "01", "02", "03", "04"},
         .columns = {{"IoU"}},
         .layout = "NN/pcd/*.pcd, label/*.txt, gt_poses.txt",
         .download = "the releases of the repository of MOE on GitHub; the parts of a sequence "
                     "go into one folder",
         .find = find_moe,
         .score = by_moving,
         .write_twin = write_moe_twin}};
}

}  // namespace dynamic_filter::app
