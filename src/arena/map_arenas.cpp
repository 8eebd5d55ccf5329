// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "arena/find.hpp"
#include "arena/rows.hpp"
#include "arena/score_trial.hpp"
#include "arena/truth_cloud.hpp"
#include "arena/twin.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/poses.hpp"
#include "formats/label_files.hpp"
#include "recording/folders.hpp"

namespace dynamic_filter::app {

namespace {

namespace fs = std::filesystem;

constexpr const char* kSequences =
    "sequences/NN/velodyne, labels, calib.txt, and poses.txt or "
    "poses_suma_optim.txt";
constexpr const char* kSemanticKitti =
    "the scans of KITTI's odometry benchmark (cvlibs.net, \"odometry data set, velodyne laser "
    "data\" "
    "and \"calibration files\"), and SemanticKITTI's labels and poses (semantic-kitti.org)";

/// ERASOR multiplies the camera's poses by this calibration, whatever the sequence, and begins its
/// map 1.73 m below the sensor, with x ahead.
Pose T_map_sensor_of_erasor(const Pose& T_world_camera) {
    Pose ahead = Pose::Identity(), calibration = Pose::Identity();
    ahead.linear() << 0, 0, 1, -1, 0, 0, 0, -1, 0;
    calibration.matrix().topRows<3>() << -1.857739385241e-03, -9.999659513510e-01,
        -8.039975204516e-03, -4.784029760483e-03, -6.481465826011e-03, 8.051860151134e-03,
        -9.999466081774e-01, -7.337429464231e-02, 9.999773098287e-01, -1.805528627661e-03,
        -6.496203536139e-03, -3.339968064433e-01;
    return ahead * T_world_camera * calibration * Eigen::Translation3d(0.0, 0.0, 1.73);
}

/// The sequence with the scans of ERASOR's window, changed by `change`.
std::optional<Trial> find_window(const fs::path& root, const std::string& sequence,
                                 const std::vector<std::string>& pose_files,
                                 void (*change)(ScanWindow&)) {
    auto trial = find_sequence(root, sequence, pose_files);
    if (!trial) return trial;
    ScanWindow window = semantickitti_window(sequence).value();
    change(window);
    choose_window(trial->data, trial->data.data / "velodyne", ".bin", window);
    trial->notes.push_back(fmt::format("{} scans", (window.last - window.first) / window.step + 1));
    return trial;
}

// SuMa's poses, which ERASOR2 ships, are those of ERASOR's tables.
const std::vector<std::string> kSumaFirst{"poses_suma_optim.txt", "poses.txt"};

/// ERASOR's lists end before the last scan of the window.
void end_before_last(ScanWindow& window) { window.last -= window.step; }

/// The map frame of ERASOR needs the poses of the camera again.
void use_map_of_erasor(Trial& trial) {
    const Pose Tr = io::read_calib_tr(trial.data.data / "calib.txt");
    trial.T_map_sensor = [Tr](const Pose& T_world_sensor) {
        return T_map_sensor_of_erasor(Tr * T_world_sensor * Tr.inverse());
    };
}

std::optional<Trial> find_erasor(const fs::path& root, const std::string& sequence) {
    auto trial = find_window(root, sequence, kSumaFirst, end_before_last);
    if (trial) use_map_of_erasor(*trial);
    return trial;
}

/// SemanticKITTI's labels, with trucks that move (258) as static points.
Labels truth_of_erasor2(const io::Recording& recording, std::size_t i, const io::FullScan& scan) {
    Labels truth = scan.truth;
    const std::string bytes = io::read_file(recording.info().label_files[i]);
    for (std::size_t p = 0; p < truth.size(); ++p) {
        const auto low = static_cast<unsigned char>(bytes[4 * p]);
        const auto high = static_cast<unsigned char>(bytes[4 * p + 1]);
        if ((high << 8 | low) == 258) truth[p] = Label::static_;
    }
    return truth;
}

std::optional<Trial> find_erasor2(const fs::path& root, const std::string& sequence) {
    auto trial = find_window(root, sequence, kSumaFirst, [](ScanWindow&) {});
    if (!trial) return trial;
    use_map_of_erasor(*trial);
    trial->truth = truth_of_erasor2;
    return trial;
}

/// The benchmark's program takes what is unlabelled within 3 m for the vehicle, which moves.
Labels truth_of_dynamicmap(const io::Recording&, std::size_t, const io::FullScan& scan) {
    constexpr float kVehicle = 3.0F;  // [m]
    Labels truth = scan.truth;
    for (std::size_t p = 0; p < truth.size(); ++p) {
        const bool is_vehicle = truth[p] == Label::unknown && scan.points[p].norm() < kVehicle;
        if (is_vehicle) truth[p] = Label::dynamic;
    }
    return truth;
}

std::optional<Trial> find_extracted(const fs::path& root, const std::string& sequence) {
    auto trial = find_window(root, sequence, {"poses.txt"}, [](ScanWindow& w) { w.step = 1; });
    if (trial) trial->truth = truth_of_dynamicmap;
    return trial;
}

std::optional<Trial> find_strict(const fs::path& root, const std::string& sequence) {
    auto trial = find_window(root, sequence, kSumaFirst, end_before_last);
    if (trial) trial->notes.emplace_back("the scans of FreeDOM's table are not published");
    return trial;
}

std::optional<Trial> find_dynamicmap(const fs::path& root, const std::string& entry) {
    const fs::path folder = root / entry;
    if (!io::is_folder(folder / "pcd")) return std::nullopt;
    Trial trial{.entry = entry, .data = {.data = folder, .format = "benchmark"}};
    // The benchmark's own program writes the whole sequence 01, but scores this part of it.
    if (entry == "01") choose_window(trial.data, folder / "pcd", ".pcd", {150, 250, 1});
    return trial;
}

const std::vector<ArenaColumn>& rates_columns() {
    static const std::vector<ArenaColumn> columns = {{"PR"}, {"RR"}, {"F1", false}};
    return columns;
}

}  // namespace

std::vector<Arena> map_arenas() {
    return {
        {.name = "erasor",
         .title = "SemanticKITTI windows by ERASOR's rule, the paper's Table I",
         .entries = {"00", "01", "02", "05", "07"},
         .columns = rates_columns(),
         .layout = kSequences,
         .download = kSemanticKitti,
         .find = find_erasor,
         .score = by_erasor,
         .write_twin = write_sequence_twin},
        {.name = "erasor2",
         .title = "the same windows as ERASOR2 counts them",
         .entries = {"00", "01", "02", "05", "07"},
         .columns = rates_columns(),
         .layout = kSequences,
         .download = kSemanticKitti,
         .find = find_erasor2,
         .score = by_erasor,
         .write_twin = write_sequence_twin},
        {.name = "strict",
         .title = "SemanticKITTI windows by FreeDOM's strict rule",
         .entries = {"02", "07"},
         .columns = {{"PR"}, {"RR"}, {"F1"}},
         .layout = kSequences,
         .download = kSemanticKitti,
         .find = find_strict,
         .score = by_strict,
         .write_twin = write_sequence_twin},
        {.name = "dynamicmap-kitti",
         .title = "SemanticKITTI windows as DynamicMap_Benchmark extracts them",
         .entries = {"00", "01", "02", "05", "07"},
         .columns = {{"SA"}, {"DA"}, {"AA"}, {"HA"}},
         .layout = kSequences,
         .download = kSemanticKitti,
         .find = find_extracted,
         .score = by_cover_to_50_m,
         .write_twin = write_sequence_twin},
        {.name = "dynamicmap",
         .title = "DynamicMap_Benchmark",
         .entries = {"00", "01", "05", "av2", "semindoor"},
         .columns = {{"SA"}, {"DA"}, {"AA"}, {"HA"}},
         .layout = "00/gt_cloud.pcd and 00/pcd/*.pcd, and so on",
         .download = "Zenodo record 10886629 (00.zip, 05.zip, av2.zip, semindoor.zip); 01 is made "
                     "with the benchmark's extract_semkitti.py",
         .find = find_dynamicmap,
         .score = by_truth_cloud,
         .write_twin = write_dynamicmap_twin}};
}

}  // namespace dynamic_filter::app
