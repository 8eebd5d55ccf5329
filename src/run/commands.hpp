// SPDX-License-Identifier: MIT
/// The subcommands. Each returns the exit code of the contract, or throws an Error.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/scores.hpp"
#include "dynamic_filter/simulation.hpp"

namespace dynamic_filter::app {

enum ExitCode {
    kDone = 0,
    kInternal = 1,
    kUsage = 2,
    kInput = 3,
    kRejected = 4,
    kInterrupted = 130
};

struct ConfigOptions {
    std::string preset = "default";
    std::optional<std::filesystem::path> file;
    std::vector<std::string> assignments;  ///< "a.b=v"
    std::string assigned_by = "--set ";    ///< what errors call them
};

/// A recording, and how to read it.
struct DataOptions {
    std::filesystem::path data;
    std::string format;  ///< empty: recognised
    std::string pose_fix = "none", time_unit = "s";
    std::string deskew = "auto";  ///< auto, on or off
    io::OpenOptions open;
};

inline constexpr std::size_t kFewestTileVoxels = 1000;  ///< smaller tiles are mostly halo

/// Several recordings of one world, or one that is larger than memory; see docs/city.md.
struct CityOptions {
    std::vector<std::filesystem::path> recordings;  ///< or lists of them
    std::string part;                               ///< "I/N", or empty: all tiles, and the merge
    std::string memory;                             ///< "1.5G", or empty
    std::optional<std::filesystem::path> plan;      ///< left by `plan -o`
    std::size_t tile_voxels = 1'500'000;            ///< most in a tile
    bool mpi = false;
};

struct RunOptions {
    DataOptions data;
    CityOptions city;
    std::optional<std::filesystem::path> output;
    ConfigOptions config;
    int threads = 0;
    std::string refine = "auto";  ///< auto, on or off
    bool online = false;
    double speed = 1.0;  ///< of online: times the sensor's rate; 0: as fast as it can
    bool overwrite = false, resume = false;
    std::optional<std::filesystem::path> edits;  ///< empty: those in the output folder, if any
    bool maps = true, report = true;             ///< left beside the labels
    bool view = false;
    std::uint16_t port = 0;  ///< of the view; 0: any
    bool quiet = false;      ///< says only what is wrong
    bool catches = true;     ///< interrupts; otherwise the caller does
    std::string after;       ///< stage of timing.json for what the process did before; may be empty
};

/// Which points are scored, by their distance from the sensor [m]. Both bounds are included.
struct RangeLimits {
    double min = 0.0;
    double max = std::numeric_limits<double>::infinity();
};

struct EvalOptions {
    DataOptions truth;
    std::optional<std::filesystem::path> labels, map, json;
    double voxel = eval::kVoxelSize;
    RangeLimits ranges;
    std::string protocol = "all";  ///< of protocol_names()
};

struct Evaluation {
    eval::Scores scores;
    std::size_t scans = 0, left_out = 0;  ///< left out: unreadable, or without labels
};

struct SimulateOptions {
    sim::SimulationOptions simulation;
    std::filesystem::path output;
    bool overwrite = false, quiet = false;
};

struct ConvertOptions {
    DataOptions data;
    std::filesystem::path output;
    std::optional<std::filesystem::path> labels;
    std::string to;      ///< layout of a folder: kitti, benchmark, autoware, 3dtiles or las; empty:
                         ///< by the output's name
    std::string origin;  ///< of 3dtiles: LAT,LON[,HEIGHT]; may be empty
    bool overwrite = false;
};

struct ReportOptions {
    std::vector<std::filesystem::path> results;  ///< folders of runs, their reports, clouds
    std::filesystem::path output = "report.html";
    DataOptions truth;
    double voxel = eval::kVoxelSize;
};

struct ServeOptions {
    std::filesystem::path folder;
    std::uint16_t port = 0;
    bool edit = false;  ///< corrections by hand, of one run
};

struct RenderOptions {
    DataOptions data;  ///< output folder of a run, cloud, or recording to animate
    std::filesystem::path output;
    bool from_above = false, clean = false;
    int width = 1600, height = 1000;
    double azimuth_deg = 60.0, elevation_deg = 35.0, point_size = 1.5;
    int pictures = 60;  ///< of an animation
    ConfigOptions config;
};

struct OdometryOptions {
    DataOptions data;
    std::filesystem::path output;
    ConfigOptions config;
    bool overwrite = false, quiet = false;
};

struct PlanOptions {
    RunOptions run;         ///< of the run that is planned
    std::size_t parts = 1;  ///< into which the tiles are divided
    bool json = false;
};

struct MergeOptions {
    std::vector<std::filesystem::path> parts;  ///< output folders of `run --part`
    std::filesystem::path output;
    int threads = 0;
    bool overwrite = false, quiet = false;
};

struct CheckOptions {
    std::vector<std::filesystem::path> recordings;  ///< or lists of them
    DataOptions how;  ///< how to read each of them; its `data` is not used
};

struct DemoOptions {
    std::filesystem::path output = "demo";
};

/// What `eval` prints. Throws what it does.
Evaluation scores_of(const EvalOptions& options);

int run(const RunOptions& options);
int plan(const PlanOptions& options);
int merge(const MergeOptions& options);
int evaluate(const EvalOptions& options);
int simulate(const SimulateOptions& options);
int demo(const DemoOptions& options);
int check(const CheckOptions& options);
int odometry(const OdometryOptions& options);
int convert(const ConvertOptions& options);
int report(const ReportOptions& options);
int render(const RenderOptions& options);
int serve(const ServeOptions& options);
int info(const std::filesystem::path& file);
int show_config(const ConfigOptions& options, bool json);

}  // namespace dynamic_filter::app
