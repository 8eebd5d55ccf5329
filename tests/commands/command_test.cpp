// SPDX-License-Identifier: MIT
// The command as a user types it: exit codes, what a run leaves behind, and what it says of bad
// input.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/poses.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/messages/messages.hpp"
#include "page/page.hpp"
#include "support/sample_map.hpp"
#include "support/temporary_folder.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter {
namespace command_test {

using test::slurp;
using test::spill;

/// Leaves every third column of each scan: the tests run the command some eighty times, and need no
/// finer sensor.
void thin(const fs::path& recording) {
    for (const auto& scan : fs::directory_iterator(recording / "velodyne")) {
        const fs::path truth =
            recording / "labels" / scan.path().filename().replace_extension(".label");
        const std::string points = slurp(scan.path()), labels = slurp(truth);
        std::string kept_points, kept_labels;
        for (std::size_t i = 0; i < points.size() / 16; ++i) {
            float xy[2];
            std::memcpy(xy, &points[16 * i], sizeof xy);
            if (std::lround(std::atan2(xy[1], xy[0]) / (0.2 * M_PI / 180)) % 3 != 0) continue;
            kept_points.append(points, 16 * i, 16);
            kept_labels.append(labels, 4 * i, 4);
        }
        spill(scan.path(), kept_points);
        spill(truth, kept_labels);
    }
}

/// A small simulated recording, made once.
const fs::path& recording() {
    static const test::TemporaryFolder folder;
    static const fs::path path = folder / "recording";
    if (!fs::exists(path)) {
        const std::string make = std::string(COMMAND) +
                                 " simulate crowd --frames 24 --pedestrians 30 -o " +
                                 path.string() + " >/dev/null 2>&1";
        EXPECT_EQ(std::system(make.c_str()), 0);
        thin(path);
    }
    return path;
}

class Command : public testing::Test {
protected:
    /// Runs the command in the test's folder; its output goes to said().
    int run(const std::string& arguments) {
        const std::string line =
            "cd " + folder_.path().string() + " && " + COMMAND + " " + arguments + " >out.txt 2>&1";
        const int status = std::system(line.c_str());
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    std::string said() { return slurp(folder_ / "out.txt"); }
    void expect_said(const std::string& text) {
        EXPECT_NE(said().find(text), std::string::npos)
            << "expected: " << text << "\nsaid: " << said();
    }
    /// A copy of the recording that a test may spoil.
    fs::path copy() {
        fs::copy(recording(), folder_ / "data", fs::copy_options::recursive);
        return folder_ / "data";
    }
    std::map<std::string, std::string> bytes_of(const std::string& output) {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder_ / output)) {
            const std::string name = entry.path().filename();
            if (entry.is_regular_file() && name != "timing.json" && name != "run.log" &&
                name != "report.html") {
                files[fs::relative(entry.path(), folder_ / output)] = slurp(entry.path());
            }
        }
        return files;
    }
    test::TemporaryFolder folder_;
};

TEST_F(Command, RunLeavesWhatTheContractSays) {
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0) << said();
    const io::Recording sequence = io::open_recording(recording());
    std::size_t points = 0;
    for (std::size_t i = 0; i < sequence.size(); ++i) {
        const auto label_file = folder_ / ("out/labels/" + io::stem(sequence, i) + ".label");
        const std::size_t in_scan = sequence.read(i).points.size();
        ASSERT_EQ(fs::file_size(label_file), 4 * in_scan);
        points += in_scan;
    }
    const io::Cloud still = io::read_cloud(folder_ / "out/static_map.pcd");
    const io::Cloud dynamic = io::read_cloud(folder_ / "out/dynamic_points.pcd");
    EXPECT_EQ(still.size() + dynamic.size(), points);
    EXPECT_GT(dynamic.size(), 0U);
    EXPECT_NE(still.find("intensity"), nullptr);

    const auto metrics = nlohmann::json::parse(slurp(folder_ / "out/metrics.json"));
    for (const char* reading : {"excluded", "static_wins", "majority"}) {
        EXPECT_GT(metrics["voxel"][reading]["f1"], 0.5) << reading;
        EXPECT_GT(metrics["instant"]["voxel"][reading]["pr"], 0.5) << reading;
    }
    for (const char* score : {"sa", "da", "aa", "ha", "iou"})
        EXPECT_GT(metrics["point"][score], 0.3);
    const auto timing = nlohmann::json::parse(slurp(folder_ / "out/timing.json"));
    EXPECT_GT(timing["scans_per_second"], 0);
    EXPECT_GT(timing["judge"]["scans_per_second"], 0);
    EXPECT_GT(timing["integrate"]["scans_per_second"], 0);
    EXPECT_GT(timing["keyframes"], 0);
    EXPECT_GT(timing["stages"]["judge"]["p99"], 0);
    for (const char* of_submaps : {"front_end", "back_end", "submaps"}) {
        EXPECT_FALSE(timing.contains(of_submaps)) << of_submaps;
    }
    for (const char* key : {"cpu_seconds", "voxels", "peak_rss_bytes", "threads"})
        EXPECT_GT(timing[key], 0);
    double wall = 0.0, cpu = 0.0;
    for (const auto& stage : timing["process"]) {
        wall += stage["wall_seconds"].get<double>();
        cpu += stage["cpu_seconds"].get<double>();
    }
    EXPECT_NEAR(timing["wall_seconds"], wall, 1e-6);
    EXPECT_NEAR(timing["cpu_seconds"], cpu, 1e-6);
    EXPECT_TRUE(fs::exists(folder_ / "out/run.log"));
    // The written configuration gives the same run again.
    ASSERT_EQ(run("run " + recording().string() + " -o again --config out/config.toml"), 0);
    EXPECT_EQ(bytes_of("again"), bytes_of("out"));
}

TEST_F(Command, LeavesOutMapsAndReportIfAsked) {
    const std::string line = "run " + recording().string();
    ASSERT_EQ(run(line + " -o all"), 0);
    ASSERT_EQ(run(line + " -o labels --no-maps --no-report"), 0) << said();
    auto all = bytes_of("all"), labels = bytes_of("labels");
    for (const char* map : {"static_map.pcd", "dynamic_points.pcd"}) {
        EXPECT_EQ(all.erase(map), 1U);
        EXPECT_FALSE(labels.contains(map));
    }
    EXPECT_FALSE(fs::exists(folder_ / "labels/report.html"));
    EXPECT_EQ(labels["metrics.json"], all["metrics.json"]);
    EXPECT_EQ(labels.size(), all.size());
    // A run that was begun without maps cannot be resumed with them.
    EXPECT_EQ(run(line + " -o labels --resume"), 2);
    EXPECT_EQ(run(line + " -o labels --resume --no-maps --no-report"), 0);
    EXPECT_EQ(run(line + " -o other --no-report --view"), 2);
}

TEST_F(Command, GivesTheSameBytesForOneAndTwoThreads) {
    ASSERT_EQ(run("run " + recording().string() + " -o one --threads 1"), 0);
    ASSERT_EQ(run("run " + recording().string() + " -o two --threads 2"), 0);
    EXPECT_EQ(bytes_of("one"), bytes_of("two"));
}

TEST_F(Command, OnlineGivesTheSameBytesIfNothingIsDropped) {
    for (const std::string preset : {"default", "paper"}) {
        const std::string line = "run " + recording().string() + " --preset " + preset;
        ASSERT_EQ(run(line + " -o off" + preset), 0);
        ASSERT_EQ(run(line + " -o on" + preset + " --online --speed 0"), 0);
        EXPECT_EQ(bytes_of("on" + preset), bytes_of("off" + preset));
        const auto timing = nlohmann::json::parse(slurp(folder_ / ("on" + preset) / "timing.json"));
        EXPECT_EQ(timing["online"]["processed"], 24);
        EXPECT_EQ(timing["online"]["queued"], 0);
        EXPECT_EQ(timing["stages"]["latency"]["count"], 24);
    }
}

TEST_F(Command, OnlineDropsWhatItCannotKeepUpWithAndSaysSo) {
    const int code = run("run " + recording().string() + " -o out --online --speed 1e6");
    const auto metrics = nlohmann::json::parse(slurp(folder_ / "out" / "metrics.json"));
    const std::size_t dropped = metrics["dropped"].size();
    EXPECT_EQ(metrics["scans"].get<std::size_t>() + dropped, 24U);
    EXPECT_GT(dropped, 0U);  // a million times too fast
    EXPECT_EQ(code, 4);
    std::size_t labels = 0;
    for (const auto& entry : fs::directory_iterator(folder_ / "out" / "labels")) {
        labels += entry.is_regular_file() ? 1 : 0;
    }
    EXPECT_EQ(labels, metrics["scans"]);
    EXPECT_EQ(run("run " + recording().string() + " -o out2 --speed 2"), 2);  // without --online
}

// Two drives in one folder: poses jump from one to the other.
TEST_F(Command, SaysThatPosesJump) {
    const fs::path data = copy();
    std::string poses, line;
    std::istringstream lines(slurp(data / "poses.txt"));
    for (int i = 0; std::getline(lines, line); ++i) {
        std::istringstream words(line);
        for (int k = 0; k < 12; ++k) {
            double value = 0.0;
            words >> value;
            poses += std::to_string(value + (i >= 12 && k == 3 ? 500.0 : 0.0)) + " ";
        }
        poses += "\n";
    }
    spill(data / "poses.txt", poses);
    ASSERT_EQ(run("run data -o out"), 0);
    expect_said("a new map begins");
    EXPECT_NE(slurp(folder_ / "out" / "run.log").find("000012: the pose is 500 m"),
              std::string::npos)
        << slurp(folder_ / "out" / "run.log");
}

TEST_F(Command, SimulatesTheSameBytesForTheSameSeed) {
    ASSERT_EQ(run("simulate street --frames 2 --sensor vlp16 --seed 5 -o a"), 0) << said();
    ASSERT_EQ(run("simulate street --frames 2 --sensor vlp16 --seed 5 -o b"), 0);
    ASSERT_EQ(run("simulate street --frames 2 --sensor vlp16 --seed 6 -o c"), 0);
    EXPECT_EQ(bytes_of("a"), bytes_of("b"));
    EXPECT_NE(bytes_of("a"), bytes_of("c"));
}

TEST_F(Command, SimulatesDrivesAsRecordingsOfTheirOwn) {
    ASSERT_EQ(run("simulate city --km 0.05 --drives 2 --frames 2 -q -o city"), 0) << said();
    for (const char* drive : {"drive_1", "drive_2"}) {
        EXPECT_TRUE(fs::exists(folder_ / "city" / drive / "velodyne/000001.bin"));
        EXPECT_EQ(run(std::string("info city/") + drive), 0) << said();
    }
    EXPECT_FALSE(fs::exists(folder_ / "city/drive_3"));
    EXPECT_NE(bytes_of("city/drive_1"), bytes_of("city/drive_2"));
    EXPECT_EQ(run("simulate city --km 0.05 --drives 2 --frames 2 -q -o city"), 2);
    EXPECT_EQ(run("simulate street --km 1 -o street"), 2);
    expect_said("with drives: city");
}

TEST_F(Command, EvalSaysWhatWasRemovedOfWhatCouldBeKnown) {
    ASSERT_EQ(run("simulate crowd --frames 8 --pedestrians 10 --knowable -q -o known"), 0);
    EXPECT_EQ(fs::file_size(folder_ / "known/knowable/000007.bin"),
              fs::file_size(folder_ / "known/labels/000007.label"));
    const std::string eval = "eval --truth known --labels ";
    // Labels that are the truth remove all that is dynamic.
    ASSERT_EQ(run(eval + "known --last 5 --json s.json"), 0) << said();
    expect_said("  what is dynamic                  points removed [%]    voxels  RR [%]\n");
    const auto scores = nlohmann::json::parse(slurp(folder_ / "s.json"))["knowable"];
    EXPECT_EQ(scores["groups"]["knowable"]["rr"], 1.0);
    EXPECT_EQ(scores["groups"]["all"]["points_removed"], 1.0);
    std::size_t points = 0;
    for (const auto& bin : scores["bins"]) points += bin["points"].get<std::size_t>();
    EXPECT_EQ(scores["groups"]["all"]["points"], points);
    EXPECT_GT(points, 1000U);

    ASSERT_EQ(run("run known -o out --no-report"), 0) << said();
    ASSERT_EQ(run("eval --truth known --map out/static_map.pcd"), 0) << said();
    EXPECT_EQ(said().find("what is dynamic"), std::string::npos);
    spill(folder_ / "known/knowable/000003.bin", "1234");
    EXPECT_EQ(run(eval + "out"), 3);
    expect_said("known/knowable/000003.bin: has 4 bytes; expected ");
    fs::remove(folder_ / "known/knowable/000003.bin");
    EXPECT_EQ(run(eval + "out"), 3);
    expect_said("known/knowable/000003.bin: ");
    ASSERT_EQ(run("simulate crowd --frames 8 --pedestrians 10 -q -o known --overwrite"), 0);
    EXPECT_FALSE(fs::exists(folder_ / "known/knowable"));
    EXPECT_EQ(run(eval + "out"), 0) << said();
}

TEST_F(Command, WhatCouldBeKnownGoesWithASweepAndWithNoisyPoses) {
    ASSERT_EQ(run("simulate street --sensor vlp16 --frames 4 --sweep --pose-noise 0.02 --knowable "
                  "-q -o swept"),
              0);
    ASSERT_EQ(run("eval --truth swept --labels swept"), 0) << said();
    expect_said("  knowable ");
    ASSERT_EQ(run("simulate city --km 0.05 --drives 2 --frames 2 --knowable -q -o city"), 0);
    EXPECT_TRUE(fs::exists(folder_ / "city/drive_2/knowable/000001.bin"));
}

TEST_F(Command, EvalOfLabelsAndOfTheMapAgreeWithTheRun) {
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0);
    const auto metrics = nlohmann::json::parse(slurp(folder_ / "out/metrics.json"));
    ASSERT_EQ(run("eval --truth " + recording().string() + " --labels out --json l.json"), 0)
        << said();
    ASSERT_EQ(
        run("eval --truth " + recording().string() + " --map out/static_map.pcd --json m.json"), 0);
    const auto labels = nlohmann::json::parse(slurp(folder_ / "l.json"));
    const auto map = nlohmann::json::parse(slurp(folder_ / "m.json"));
    EXPECT_EQ(labels["voxel"], metrics["voxel"]);
    EXPECT_EQ(labels["point"], metrics["point"]);
    for (const char* grid : {"voxel", "voxel_shifted"}) {
        EXPECT_NEAR(map[grid]["excluded"]["f1"], labels[grid]["excluded"]["f1"], 0.002) << grid;
    }
    EXPECT_NE(labels["voxel_shifted"], labels["voxel"]);
    EXPECT_NEAR(map["point"]["aa"], labels["point"]["aa"], 0.002);
    EXPECT_EQ(run("eval --truth " + recording().string()), 2);
}

/// x, y and z of all points of clouds, in an order that does not depend on that of the points.
std::vector<std::array<double, 3>> sorted_points(const std::vector<fs::path>& files) {
    std::vector<std::array<double, 3>> points;
    for (const fs::path& file : files) {
        const io::Cloud cloud = io::read_cloud(file);
        const auto x = io::values(cloud, *cloud.find("x")), y = io::values(cloud, *cloud.find("y")),
                   z = io::values(cloud, *cloud.find("z"));
        for (std::size_t i = 0; i < cloud.size(); ++i) points.push_back({x[i], y[i], z[i]});
    }
    std::sort(points.begin(), points.end());
    return points;
}

// Found poses, refined poses and motion that was undone: the result brings them all.
TEST_F(Command, WhoTakesAResultHasThePointsOfItsRun) {
    ASSERT_EQ(run("simulate crowd --frames 10 --pedestrians 10 --sweep -q -o sweeps"), 0);
    const std::string still = recording().string();
    for (const auto& [data, how] : {std::pair<std::string, std::string>{"sweeps", "--deskew on"},
                                    {"sweeps", "--poses none --deskew on"},
                                    {still, "--refine on --last 9"},
                                    {still, "--pose-fix inverse --refine off"}}) {
        const int code = how.find("inverse") == std::string::npos ? 0 : 4;  // poses that were right
        ASSERT_EQ(run("run " + data + " --no-report --overwrite -o out " + how), code) << said();
        ASSERT_EQ(run("convert " + data + " all.pcd --overwrite --labels out"), 0) << said();
        expect_said("the recording is read as by the run in out: with ");
        EXPECT_EQ(
            sorted_points({folder_ / "all.pcd"}),
            sorted_points({folder_ / "out/static_map.pcd", folder_ / "out/dynamic_points.pcd"}))
            << data << " " << how;
        const auto metrics = nlohmann::json::parse(slurp(folder_ / "out/metrics.json"));
        ASSERT_EQ(run("eval --truth " + data + " --labels out --json s.json"), 0) << said();
        expect_said("the recording is read as by the run in out: with ");
        const auto scores = nlohmann::json::parse(slurp(folder_ / "s.json"));
        EXPECT_EQ(scores["voxel"], metrics["voxel"]) << data << " " << how;
        EXPECT_EQ(scores["point"], metrics["point"]) << data << " " << how;
    }
    // What is given on the command line goes before.
    ASSERT_EQ(run("convert " + still + " given --labels out --poses " + still + "/poses.txt"), 0)
        << said();
    ASSERT_EQ(run("convert " + still + " plain"), 0) << said();
    EXPECT_EQ(slurp(folder_ / "given/poses.txt"), slurp(folder_ / "plain/poses.txt"));
}

TEST_F(Command, EvalRepeatsTheProtocolsOfOthers) {
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0);
    const std::string eval = "eval --truth " + recording().string() + " --labels out";
    const auto metrics = nlohmann::json::parse(slurp(folder_ / "out/metrics.json"));
    const auto two_digits = [](double share) { return fmt::format("{:.2f}", 100.0 * share); };
    ASSERT_EQ(run(eval + " --protocol mos"), 0) << said();
    expect_said("moving IoU " + two_digits(metrics["point"]["iou"]) + " %");
    ASSERT_EQ(run(eval + " --protocol benchmark"), 0);
    expect_said("AA " + two_digits(metrics["point"]["aa"]) + " %");
    for (const auto& [protocol, reading] :
         std::map<std::string, std::string>{{"voxel", "excluded"}, {"strict", "static_wins"}}) {
        ASSERT_EQ(run(eval + " --protocol " + protocol), 0);
        expect_said("RR " + two_digits(metrics["voxel"][reading]["rr"]) + " %");
    }
    EXPECT_EQ(run(eval + " --protocol nobody"), 2);
    ASSERT_EQ(run(eval + " --protocol erasor --json e.json"), 0) << said();
    const auto rates = nlohmann::json::parse(slurp(folder_ / "e.json"))["voxel"]["erasor"];
    expect_said("RR " + two_digits(rates["rr"]) + " %");
    ASSERT_EQ(run("eval --truth " + recording().string() +
                  " --map out/static_map.pcd --protocol erasor --json m.json"),
              0)
        << said();
    // The map holds the points that the labels keep; only their labels are found again.
    const auto of_map = nlohmann::json::parse(slurp(folder_ / "m.json"))["voxel"]["erasor"];
    EXPECT_NEAR(of_map["pr"].get<double>(), rates["pr"].get<double>(), 0.02);
    EXPECT_NEAR(of_map["rr"].get<double>(), rates["rr"].get<double>(), 0.05);
}

TEST_F(Command, EvalScoresWithinTheRangeAskedFor) {
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0);
    const std::string eval = "eval --truth " + recording().string() + " --labels out --json s.json";
    const auto scores = [&](const std::string& options) {
        EXPECT_EQ(run(eval + options), 0) << said();
        return nlohmann::json::parse(slurp(folder_ / "s.json"));
    };
    const auto all = scores(""), same = scores(" --min-range 0 --max-range 1000");
    EXPECT_EQ(all["point"], same["point"]);
    EXPECT_FALSE(all.contains("part"));
    EXPECT_EQ(same["part"], nlohmann::json::parse(R"({"max_range": 1000.0})"));
    const auto near = scores(" --max-range 8");
    expect_said("scored are points from 0 m to 8 m of the sensor");
    EXPECT_NE(near["point"], all["point"]);
    const auto boxed = scores(" --box=-5,-5,5,5"), everywhere = scores(" --box=-1e4,-1e4,1e4,1e4");
    EXPECT_NE(boxed["point"], all["point"]);
    EXPECT_EQ(everywhere["point"], all["point"]);
    EXPECT_EQ(everywhere["part"]["box"][0][1], -1e4);
    expect_said("scored are points within the box");
    // Nothing is nearer than the sensor's own body, and nothing is measured so far away.
    for (const char* nothing : {" --max-range 0.01", " --box=5000,5000,5010,5010"}) {
        EXPECT_EQ(run(eval + nothing), 3);
        expect_said("has no point with ground truth in the part that is scored");
    }
    EXPECT_EQ(run(eval + " --min-range 5 --max-range 5"), 2);
    expect_said("--min-range must be 0 or more, and less than --max-range");
}

TEST_F(Command, UsageErrorsExitWithTwo) {
    EXPECT_EQ(run(""), 2);
    expect_said("`dynamicfilter --help` lists the commands");
    EXPECT_EQ(run("run"), 2);
    expect_said("dynamicfilter: DATA is required; `dynamicfilter run --help` lists the options");
    EXPECT_EQ(run("fly"), 2);
    expect_said(
        "unknown command 'fly'; the commands are: run, plan, merge, diff, live, eval, bench, "
        "simulate, convert");
    EXPECT_EQ(run("rnu data"), 2);
    expect_said("unknown command 'rnu', did you mean 'run'?");
    EXPECT_EQ(run("eval --truth data --lables out"), 2);
    expect_said("unknown option '--lables', did you mean '--labels'?");
    EXPECT_EQ(run("--verson"), 2);
    expect_said("unknown option '--verson', did you mean '--version'?");
    EXPECT_EQ(run("--pose-fix inverse"), 2);
    expect_said("options come after a command");
    EXPECT_EQ(run("run data out"), 2);
    expect_said("several recordings may be given, and -o names the output folder");
    EXPECT_EQ(run("run " + recording().string() + " --set map.voxle_size=1"), 2);
    expect_said("map.voxel_size");
    EXPECT_EQ(run("run " + recording().string() + " --set map.voxel_size=-1"), 2);
    EXPECT_EQ(run("run " + recording().string() + " --set back_end.max_submaps=20"), 2);
    expect_said("belongs to the method 'submaps'");
    EXPECT_EQ(run("config --preset paper --set scans.max_keyframes=9"), 2);
    expect_said("belongs to the method 'scans'");
    EXPECT_EQ(run("run " + recording().string() + " --preset best"), 2);
    EXPECT_EQ(run("run " + recording().string() + " --format cloud"), 2);
    EXPECT_EQ(run("run " + recording().string() + " --first 99"), 2);
    EXPECT_EQ(run("run " + recording().string() + " --stride -1"), 2);
    expect_said("'-1' is no whole number of 1 or more");
    EXPECT_EQ(run("simulate crowd --frames 0 -o x"), 2);
    EXPECT_EQ(run("simulate moon -o x"), 2);
    expect_said("crowd");
    EXPECT_FALSE(fs::exists(folder_ / "results"));
}

TEST_F(Command, NeverWritesOverARecording) {
    const fs::path data = copy();
    EXPECT_EQ(run("run data -o data --overwrite"), 2);
    EXPECT_EQ(run("run data -o data/velodyne --overwrite"), 2);
    EXPECT_EQ(run("demo -o data"), 2);
    EXPECT_EQ(run("run data -o out"), 0);
}

TEST_F(Command, OneFileIsNotWrittenOverAnother) {
    const fs::path copy = folder_ / "copy";
    fs::copy(recording(), copy, fs::copy_options::recursive);
    const std::string poses = slurp(copy / "poses.txt");
    EXPECT_EQ(run("odometry " + copy.string() + " -o " + (copy / "poses.txt").string()), 2);
    expect_said("poses.txt: exists; choose another -o, or --overwrite");
    EXPECT_EQ(run("eval --truth " + copy.string() + " --labels " + copy.string() + " --json " +
                  (copy / "poses.txt").string()),
              2);
    expect_said("must end in .json");
    EXPECT_EQ(run("report " + copy.string() + " -o " + (copy / "times.txt").string()), 2);
    expect_said("must end in .html");
    EXPECT_EQ(slurp(copy / "poses.txt"), poses);
}

TEST_F(Command, QuietSaysOnlyWhatIsWrong) {
    EXPECT_EQ(run("simulate crowd --frames 3 --pedestrians 5 -q -o data"), 0);
    EXPECT_EQ(said(), "");
    EXPECT_EQ(run("run data -q -o out"), 0);
    EXPECT_EQ(said(), "");
    fs::resize_file(folder_ / "data/velodyne/000001.bin", 7);
    EXPECT_EQ(run("run data --quiet -o again"), 4);
    expect_said("rejected 000001");
}

TEST_F(Command, EvalSaysWhatItLeftOut) {
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0);
    const fs::path data = copy();
    fs::resize_file(data / "velodyne/000004.bin", 1001);
    EXPECT_EQ(run("eval --truth data --map out/static_map.pcd"), 4);
    expect_said("left out 1 of 24 scans: unreadable, or without labels; the first is 000004");
    EXPECT_EQ(run("eval --truth data --labels data/velodyne"), 3);
    fs::rename(folder_ / "out/labels/000001.label", folder_ / "out/labels/000002.label");
    EXPECT_EQ(run("eval --truth " + recording().string() + " --labels out"), 2);
    expect_said("another recording");
}

/// Removes the ground truth of all scans but every `step`-th one.
void thin_truth(const fs::path& data, std::size_t scans, std::size_t step) {
    for (std::size_t i = 0; i < scans; ++i) {
        if (i % step != 0) fs::remove(data / fmt::format("labels/{:06}.label", i));
    }
}

TEST_F(Command, ScoresTheScansThatHaveTruthWhereItIsSparse) {
    const fs::path data = copy();
    thin_truth(data, 24, 10);
    ASSERT_EQ(run("run data -o out"), 0) << said();
    expect_said("labels of 3 of 24 scans");
    expect_said("scores against the ground truth of 3 of 24 scans");
    const auto metrics = nlohmann::json::parse(slurp(folder_ / "out/metrics.json"));
    EXPECT_EQ(metrics["scans_with_truth"], 3);
    ASSERT_EQ(run("eval --truth data --labels out --json s.json"), 0) << said();
    expect_said("scored 3 of 24 scans: those with ground truth");
    const auto scores = nlohmann::json::parse(slurp(folder_ / "s.json"));
    EXPECT_EQ(scores["voxel"], metrics["voxel"]);
    EXPECT_EQ(scores["point"], metrics["point"]);
    EXPECT_EQ(run("eval --truth data --map out/static_map.pcd"), 0) << said();
    // The chosen scans are those that were to have none.
    EXPECT_EQ(run("eval --truth data --labels out --first 1 --last 9"), 3);
    expect_said("has no ground truth of the 9 chosen scans, but of others");
}

TEST_F(Command, NamesAScanThatSeemsToHaveLostItsTruth) {
    const fs::path data = copy();
    fs::remove(data / "labels/000007.label");
    ASSERT_EQ(run("run data -o out"), 0) << said();
    expect_said("scans without are not scored, the first is 000007.bin");
    EXPECT_EQ(run("eval --truth data --labels out"), 4);
    expect_said("left out 1 of 24 scans: unreadable, or without labels; the first is 000007");
}

TEST_F(Command, ResultsThatCannotBePrintedAreAnError) { EXPECT_EQ(run("config > /dev/full #"), 1); }

TEST_F(Command, HelpAndVersionExitWithZero) {
    EXPECT_EQ(run("--help"), 0);
    expect_said("simulate");
    EXPECT_EQ(run("run --help"), 0);
    EXPECT_EQ(run("--version"), 0);
}

TEST_F(Command, AnOutputFolderInUseIsLeftAlone) {
    fs::create_directories(folder_ / "out");
    spill(folder_ / "out/static_map.pcd", "precious");
    EXPECT_EQ(run("run " + recording().string() + " -o out"), 2);
    expect_said("not empty");
    EXPECT_EQ(slurp(folder_ / "out/static_map.pcd"), "precious");
    EXPECT_EQ(run("run " + recording().string() + " -o out --overwrite"), 0);
}

TEST_F(Command, InputThatIsNotThereOrContradictsItselfExitsWithThree) {
    EXPECT_EQ(run("run nowhere"), 3);
    const fs::path data = copy();
    const std::string poses = slurp(data / "poses.txt");
    spill(data / "poses.txt", poses.substr(0, poses.size() / 2));
    EXPECT_EQ(run("run data -o out"), 3);
    expect_said("poses");
    std::string others;  // of another drive, twice as long
    for (int i = 0; i < 48; ++i) others += "1 0 0 " + std::to_string(90 * i) + " 0 1 0 0 0 0 1 0\n";
    spill(data / "poses.txt", others);
    EXPECT_EQ(run("run data -o out"), 3);
    expect_said("24");
    expect_said("48");
    spill(data / "poses.txt", "2 0 0 0 0 2 0 0 0 0 2 0\n" + poses.substr(poses.find('\n') + 1));
    EXPECT_EQ(run("run data -o out"), 3);
    expect_said("line 1");
    EXPECT_FALSE(fs::exists(folder_ / "out/static_map.pcd"));
}

TEST_F(Command, BadScansAreRejectedCountedAndNamed) {
    const fs::path data = copy();
    fs::resize_file(data / "velodyne/000003.bin", 1001);
    fs::resize_file(data / "velodyne/000005.bin", 0);
    fs::resize_file(data / "labels/000007.label", 8);
    EXPECT_EQ(run("run data -o out"), 4) << said();
    const auto metrics = nlohmann::json::parse(slurp(folder_ / "out/metrics.json"));
    EXPECT_EQ(metrics["rejected"].size(), 2U);
    for (const char* stem : {"000003", "000005"}) {
        EXPECT_FALSE(fs::exists(folder_ / "out/labels" / (std::string(stem) + ".label")));
        EXPECT_NE(slurp(folder_ / "out/run.log").find(std::string("rejected ") + stem),
                  std::string::npos);
    }
    EXPECT_TRUE(fs::exists(folder_ / "out/labels/000004.label"));
    EXPECT_EQ(run("check data"), 4);
    expect_said("UNUSABLE  000003");
    expect_said("UNUSABLE  000005");
}

TEST_F(Command, GroundTruthThatDoesNotFitChangesNoLabel) {
    const fs::path data = copy();
    fs::resize_file(data / "labels/000007.label", 8);
    ASSERT_EQ(run("run data -o out"), 0) << said();
    expect_said("labels/000007.label: 2 labels but ");
    expect_said("not scored");
    fs::remove_all(data / "labels");
    ASSERT_EQ(run("run data -o without"), 0) << said();
    EXPECT_TRUE(bytes_of("out/labels") == bytes_of("without/labels"));
}

TEST_F(Command, ABagThatLostScansIsNotDone) {
    ASSERT_EQ(run("convert " + recording().string() + " a.mcap"), 0);
    fs::resize_file(folder_ / "a.mcap", fs::file_size(folder_ / "a.mcap") / 2);
    EXPECT_EQ(run("run a.mcap -o out"), 4);
    expect_said("lost     a.mcap: the record at byte ");
    EXPECT_NE(slurp(folder_ / "out/run.log").find("lost     a.mcap"), std::string::npos);
    EXPECT_FALSE(nlohmann::json::parse(slurp(folder_ / "out/metrics.json"))["lost"].empty());
    EXPECT_EQ(run("check a.mcap"), 4);
    EXPECT_EQ(run("convert a.mcap b.bag"), 4);
}

TEST_F(Command, PointsThatAreNoMeasurementsEndAsUnknown) {
    const fs::path data = copy();
    std::string bytes = slurp(data / "velodyne/000002.bin");
    const float nan = std::numeric_limits<float>::quiet_NaN(), zero[3] = {0, 0, 0};
    std::memcpy(bytes.data(), &nan, sizeof nan);
    std::memcpy(bytes.data() + 16, zero, sizeof zero);
    spill(data / "velodyne/000002.bin", bytes);
    EXPECT_EQ(run("run data -o out"), 0) << said();
    const std::string labels = slurp(folder_ / "out/labels/000002.label");
    EXPECT_EQ(labels.substr(0, 8), std::string(8, '\0'));
    EXPECT_NE(labels.substr(8, 4), std::string(4, '\0'));
}

TEST_F(Command, NamesNeedNotBeUtf8) {
    const std::string odd = "d\xff\xfe";
    fs::rename(copy(), folder_ / odd);
    fs::resize_file(folder_ / odd / "velodyne/000003.bin", 1001);
    for (const char* kind : {"velodyne/000004.bin", "labels/000004.label"}) {
        const fs::path file = folder_ / odd / kind;
        fs::rename(file, file.parent_path() / ("000004\xe9" + file.extension().string()));
    }
    EXPECT_EQ(run("run " + odd + " -o out"), 4) << said();
    EXPECT_TRUE(fs::exists(folder_ / "out/labels/000004\xe9.label"));
    EXPECT_TRUE(nlohmann::json::accept(slurp(folder_ / "out/metrics.json")));
    EXPECT_EQ(run("info " + odd), 0);
}

TEST_F(Command, FailingToWriteExitsWithOne) {
    spill(folder_ / "file", "");
    EXPECT_EQ(run("run " + recording().string() + " -o file/out"), 1);
    EXPECT_EQ(run("run " + recording().string() + " -o /proc/none"), 1);
}

TEST_F(Command, InfoDescribesFilesAndFolders) {
    EXPECT_EQ(run("info " + recording().string()), 0) << said();
    expect_said("kitti");
    expect_said("intensity");
    EXPECT_EQ(run("info " + (recording() / "velodyne/000000.bin").string()), 0);
    EXPECT_EQ(run("info nothing.pcd"), 3);
    spill(folder_ / "utm.xyz", "500123.25 5400000 0.123456\n500987.5 5400321 12\n");
    EXPECT_EQ(run("info utm.xyz"), 0) << said();
    for (const char* range : {"500123.25 .. 500987.50", "5400000 .. 5400321", "0.1235 .. 12"})
        expect_said(range);
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0) << said();
    for (const char* command : {"info out", "check out", "run out -o x"}) {
        EXPECT_EQ(run(command), 3) << command;
        expect_said("is the output of a run, not a recording");
    }
    ASSERT_EQ(run("run " + recording().string() + " --part 1/1 -o part"), 0) << said();
    for (const char* command : {"info part", "check part", "run part -o x"}) {
        EXPECT_EQ(run(command), 3) << command;
        expect_said("is a part of a run, not a recording");
    }
    ASSERT_EQ(run("convert " + recording().string() + " a.bag"), 0);
    fs::rename(folder_ / "a.bag", folder_ / "recording.data");
    EXPECT_EQ(run("check recording.data"), 3);
    expect_said("is a ROS 1 bag; leave --format out, or give --format bag");
    EXPECT_EQ(run("check recording.data --format bag"), 0) << said();
    EXPECT_EQ(run("convert recording.data b.mcap --format bag"), 0) << said();
    EXPECT_EQ(run("info recording.data --format bag"), 0) << said();
    expect_said("/points");
    EXPECT_EQ(run("convert recording.data --format bag -o c.mcap"), 0) << said();
    EXPECT_EQ(slurp(folder_ / "c.mcap"), slurp(folder_ / "b.mcap"));
}

TEST_F(Command, InfoSaysWhetherThereArePoses) {
    EXPECT_EQ(run("info " + recording().string()), 0) << said();
    expect_said("poses   of all scans, from " + (recording() / "poses.txt").string());
    expect_said("path    ");
    const fs::path data = copy();
    fs::remove(data / "poses.txt");
    EXPECT_EQ(run("info data"), 0) << said();
    expect_said("poses   none: the odometry finds them");
    expect_said("intensity");
    ASSERT_EQ(run("convert " + recording().string() + " told.mcap"), 0);
    EXPECT_EQ(run("info told.mcap"), 0) << said();
    expect_said("/points");
    expect_said("poses   of all scans");
    ASSERT_EQ(run("convert " + recording().string() + " bench --to benchmark"), 0);
    EXPECT_EQ(run("info bench"), 0) << said();
    expect_said("poses   in the scans' files");
}

TEST_F(Command, ConfigPrintsWhatRunReads) {
    EXPECT_EQ(run("config --preset paper"), 0);
    spill(folder_ / "paper.toml", said());
    EXPECT_EQ(run("config --config paper.toml"), 0);
    EXPECT_EQ(said(), slurp(folder_ / "paper.toml"));
    EXPECT_EQ(run("config --json --set map.voxel_size=0.125"), 0);
    expect_said("0.125");
}

TEST_F(Command, NamesTheDefaultOutputByTimeAndLinksTheLatest) {
    ASSERT_EQ(run("run " + recording().string() + " --last 3"), 0) << said();
    EXPECT_TRUE(fs::exists(folder_ / "results/latest/static_map.pcd"));
    EXPECT_TRUE(fs::is_symlink(folder_ / "results/latest"));
}

TEST_F(Command, FirstLastAndStrideSelectScans) {
    ASSERT_EQ(run("run " + recording().string() + " --first 2 --last 10 --stride 4 -o out"), 0);
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "out/labels")) {
        names.push_back(entry.path().filename());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"000002.label", "000006.label", "000010.label"}));
}

TEST_F(Command, TheSameScansInEveryFormatGiveTheSameLabels) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o expected"), 0) << said();
    const auto expected = bytes_of("expected/labels");
    for (const std::string copy : {"copy.mcap", "copy.bag", "copy.db3", "copy"}) {
        ASSERT_EQ(run("convert " + data + " " + copy), 0) << said();
        ASSERT_EQ(run("run " + copy + " -o from_" + copy), 0) << said();
        EXPECT_TRUE(bytes_of("from_" + copy + "/labels") == expected) << copy;
        EXPECT_EQ(run("convert " + data + " " + copy), 2) << "what is there is not overwritten";
    }
    // The benchmark's scans are rounded in the world's frame.
    ASSERT_EQ(run("convert " + data + " benchmark --to benchmark"), 0) << said();
    ASSERT_EQ(run("run benchmark -o from_benchmark"), 0) << said();
    const auto rounded = bytes_of("from_benchmark/labels");
    ASSERT_EQ(rounded.size(), expected.size());
    std::size_t other = 0, bytes = 0;
    for (const auto& [name, labels] : expected) {
        ASSERT_EQ(rounded.at(name).size(), labels.size());
        for (std::size_t i = 0; i < labels.size(); i += 4) {
            other += labels[i] != rounded.at(name)[i] ? 1 : 0;
        }
        bytes += labels.size();
    }
    EXPECT_LT(other * 4 * 1000, bytes);
}

TEST_F(Command, ResumeGoesOnWithTheSameOnly) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out"), 0) << said();
    const auto expected = bytes_of("out");
    EXPECT_EQ(run("run " + data + " -o out --resume"), 0);
    expect_said("complete out");
    EXPECT_EQ(run("run " + data + " -o out --resume --set map.voxel_size=0.3"), 2);
    expect_said("other settings");
    const std::string state = slurp(folder_ / "out/.run");
    for (const std::size_t at : {std::size_t{9}, state.size() / 2, state.size() - 2}) {
        std::string damaged = state;
        damaged[at] ^= 1;
        spill(folder_ / "out/.run", damaged);
        EXPECT_EQ(run("run " + data + " -o out --resume"), 2) << at;
        expect_said("start afresh with --overwrite");
    }
    spill(folder_ / "out/.run", state);
    // As a kill in the midst of it leaves it.
    spill(folder_ / "out/.run",
          slurp(folder_ / "out/.run").substr(0, slurp(folder_ / "out/.run").find("complete")));
    fs::remove(folder_ / "out/static_map.pcd");
    spill(folder_ / "out/labels/.000003.label.tmp.9.9", "half");
    EXPECT_EQ(run("run " + data + " -o out --resume"), 0) << said();
    EXPECT_TRUE(bytes_of("out") == expected);
    EXPECT_EQ(run("run " + data + " --resume"), 2);
    fs::create_directory(folder_ / "thesis");
    spill(folder_ / "thesis/thesis.tex", "precious");
    EXPECT_EQ(run("run " + data + " -o thesis --resume"), 2);
    expect_said("no run of this version began");
    EXPECT_FALSE(fs::exists(folder_ / "thesis/labels"));
}

TEST_F(Command, ResumeGoesOnWithAnOverwriteThatWasKilled) {
    const std::string data = recording().string(), other = " --set map.voxel_size=0.3";
    ASSERT_EQ(run("run " + data + " -o out"), 0) << said();
    ASSERT_EQ(run("run " + data + " -o expected" + other), 0) << said();
    const std::string state = slurp(folder_ / "expected/.run");
    fs::create_directories(folder_ / "out/.new/labels");
    spill(folder_ / "out/.new/.run", state.substr(0, state.find("complete")));
    EXPECT_EQ(run("run " + data + " -o out --resume" + other), 0) << said();
    EXPECT_TRUE(bytes_of("out") == bytes_of("expected"));
    // Killed when all was written, and nothing put in place.
    fs::create_directory(folder_ / "again");
    fs::copy(folder_ / "expected", folder_ / "again/.new", fs::copy_options::recursive);
    spill(folder_ / "again/run.log", "old");
    EXPECT_EQ(run("run " + data + " -o again --resume" + other), 0) << said();
    EXPECT_TRUE(bytes_of("again") == bytes_of("expected"));
}

TEST_F(Command, OverwriteLeavesGroundTruthAlone) {
    const fs::path data = copy();
    const auto truth = bytes_of("data/labels");
    EXPECT_EQ(run("run " + recording().string() + " -o data --overwrite"), 2);
    expect_said("labels that no run left");
    EXPECT_TRUE(bytes_of("data/labels") == truth);
    EXPECT_EQ(run("convert data data/velodyne/map.pcd"), 2);
    EXPECT_EQ(run("convert data/velodyne/000000.bin data/velodyne/000000.bin --overwrite"), 2);
}

TEST_F(Command, WhatFailsLeavesTheOldResultWhole) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out"), 0) << said();
    const auto expected = bytes_of("out");
    // No file may grow beyond 1000 blocks: the maps do not fit.
    const std::string line = "cd " + folder_.path().string() + " && (ulimit -f 1000; " + COMMAND +
                             " run " + data + " -o out --overwrite >out.txt 2>&1)";
    const int status = std::system(line.c_str());
    EXPECT_EQ(WEXITSTATUS(status), 1) << said();
    expect_said("cannot be written");
    EXPECT_TRUE(bytes_of("out") == expected);
}

std::size_t points_on(const fs::path& bag, const std::string& topic) {
    std::size_t points = 0;
    (void)io::Bag(bag).for_each([&](const io::Message& message) {
        if (message.topic.name == topic)
            points += io::read_cloud_message(message.data, message.topic).cloud.size();
    });
    return points;
}

/// As the map files do, unknown points follow map.keep_unknown of the run that left the labels.
TEST_F(Command, ConvertPutsUnknownPointsWhereTheRunDid) {
    const std::string data = recording().string();
    for (const bool keeps : {true, false}) {
        const std::string set = keeps ? "true" : "false";
        ASSERT_EQ(run("run " + data + " -o " + set + " --set map.keep_unknown=" + set), 0)
            << said();
        std::size_t unknown = 0, still = 0, moving = 0;
        for (const auto& entry : fs::directory_iterator(folder_ / set / "labels")) {
            for (const Label label : io::read_labels(entry.path())) {
                ++(label == Label::unknown ? unknown : label == Label::static_ ? still : moving);
            }
        }
        ASSERT_GT(unknown, 0U);
        for (const char* labels : {"", "/labels", "/labels/"}) {
            ASSERT_EQ(run("convert " + data + " split.mcap --overwrite --labels " + set + labels),
                      0)
                << said();
            EXPECT_EQ(points_on(folder_ / "split.mcap", "/points_static"),
                      still + (keeps ? unknown : 0));
            EXPECT_EQ(points_on(folder_ / "split.mcap", "/points_dynamic"), moving);
        }
    }
    test::spill(folder_ / "false/config.toml", "[map]\nkeeps = 1\n");
    EXPECT_EQ(run("convert " + data + " split.mcap --overwrite --labels false"), 0) << said();
    expect_said("as with map.keep_unknown = true");
}

/// A map as map_server of ROS reads it: 0, 205 or 254 at a place of the world.
struct ServedMap {
    int width = 0, height = 0;
    double resolution = 0.0, x = 0.0, y = 0.0;  // of the lower left corner
    std::string pixels;

    explicit ServedMap(const fs::path& folder) {
        const std::string yaml = slurp(folder / "map.yaml"), pgm = slurp(folder / "map.pgm");
        const auto after = [&](const char* key) {
            return yaml.c_str() + yaml.find(key) + std::strlen(key);
        };
        EXPECT_EQ(std::sscanf(after("resolution: "), "%lf", &resolution), 1);
        EXPECT_EQ(std::sscanf(after("origin: ["), "%lf, %lf, 0]", &x, &y), 2);
        int used = 0;
        EXPECT_EQ(std::sscanf(pgm.c_str(), "P5\n%d %d\n255\n%n", &width, &height, &used), 2);
        pixels = pgm.substr(static_cast<std::size_t>(used));
        EXPECT_EQ(pixels.size(),
                  static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    }
    [[nodiscard]] int at(double wx, double wy) const {
        const int column = static_cast<int>(std::floor((wx - x) / resolution));
        const int row = height - 1 - static_cast<int>(std::floor((wy - y) / resolution));
        return static_cast<unsigned char>(
            pixels.at(static_cast<std::size_t>(row * width + column)));
    }
};

TEST_F(Command, ConvertWritesAMapForNavigation) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out --no-report"), 0) << said();
    ASSERT_EQ(run("convert " + data + " nav --labels out --to nav2"), 0) << said();
    expect_said("m above the floor");
    const ServedMap map(folder_ / "nav");
    EXPECT_EQ(map.resolution, 0.05);
    for (const Pose& pose : io::read_poses(data + "/poses.txt").poses) {
        EXPECT_EQ(map.at(pose.translation().x(), pose.translation().y()), 254);
    }
    for (const char value : {'\0', '\xCD', '\xFE'}) {
        EXPECT_NE(map.pixels.find(value), std::string::npos) << static_cast<int>(value);
    }
    EXPECT_NE(slurp(folder_ / "nav/map.yaml").find("occupied_thresh: 0.65\nfree_thresh: 0.196\n"),
              std::string::npos);

    EXPECT_EQ(run("convert " + data + " wide --labels out --to nav2 --cell 0.2"), 0);
    EXPECT_EQ(ServedMap(folder_ / "wide").resolution, 0.2);
    EXPECT_EQ(run("convert " + data + " none --labels out --to nav2 --storey 2"), 2);
    expect_said("has 1 storey");
    EXPECT_EQ(run("convert out/static_map.pcd none --to nav2"), 2);
    expect_said("made of a recording");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Command, ConvertWritesOctomaps) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out --no-report"), 0) << said();
    for (const char* file : {"map.bt", "map.ot"}) {
        ASSERT_EQ(run(fmt::format("convert {} {} --labels out", data, file)), 0) << said();
        expect_said("voxels of 0.1 m are occupied");
        EXPECT_NE(slurp(folder_ / file).find("id OcTree\nsize "), std::string::npos);
    }
    EXPECT_EQ(run("convert " + data + " map.bt --labels out"), 2);
    expect_said("--overwrite");
    EXPECT_EQ(run("convert " + data + " wide.bt --labels out --cell 0.4"), 0) << said();
    EXPECT_LT(fs::file_size(folder_ / "wide.bt"), fs::file_size(folder_ / "map.bt") / 8);
    EXPECT_EQ(run("convert out/static_map.pcd none.bt"), 2);
    expect_said("OctoMap is made of a recording");
    EXPECT_EQ(run("convert " + data + " none.ot --labels out --only static"), 2);
    expect_said("both end beams");
    const fs::path bare = folder_ / "bare";
    fs::create_directories(bare);
    fs::copy(fs::path(data) / "velodyne", bare / "velodyne");
    fs::copy(fs::path(data) / "poses.txt", bare / "poses.txt");
    EXPECT_EQ(run("convert bare none.bt"), 2);
    expect_said("OctoMap needs labels");
    EXPECT_FALSE(fs::exists(folder_ / "none.bt") || fs::exists(folder_ / "none.ot"));
}

TEST_F(Command, ConvertNamesObjects) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out --no-report"), 0) << said();
    ASSERT_EQ(run("convert " + data + " objects --labels out --to objects"), 0) << said();
    expect_said("objects moved");
    std::map<std::uint32_t, std::size_t> points;
    for (std::size_t i = 0; fs::exists(folder_ / fmt::format("out/labels/{:06}.label", i)); ++i) {
        const std::string name = fmt::format("labels/{:06}.label", i);
        const std::string now = slurp(folder_ / "objects" / name),
                          plain = slurp(folder_ / "out" / name);
        ASSERT_EQ(now.size(), plain.size());
        for (std::size_t at = 0; at < now.size(); at += 4) {
            std::uint32_t value = 0, label = 0;
            std::memcpy(&value, now.data() + at, 4);
            std::memcpy(&label, plain.data() + at, 4);
            EXPECT_EQ(value & 0xFFFFU, label);
            if (value >> 16U != 0) ++points[value >> 16U];
            EXPECT_TRUE(label == 251 || value >> 16U == 0);
        }
    }
    ASSERT_GT(points.size(), 3U);
    std::istringstream table(slurp(folder_ / "objects/objects.csv"));
    std::string line;
    std::getline(table, line);
    std::size_t rows = 0;
    while (std::getline(table, line)) {
        unsigned object = 0, scans = 0;
        std::size_t count = 0;
        double first = 0, last = 0;
        ASSERT_EQ(
            std::sscanf(line.c_str(), "%u,%lf,%lf,%u,%zu", &object, &first, &last, &scans, &count),
            5);
        EXPECT_EQ(points.at(object), count) << "as in the labels";
        EXPECT_TRUE(fs::exists(folder_ / fmt::format("objects/pictures/{:06}.png", object)));
        EXPECT_GE(scans, 3U);
        ++rows;
    }
    EXPECT_EQ(rows, points.size());
    EXPECT_EQ(run("eval --labels objects/labels --truth " + data), 0)
        << "labels with numbers are read";
    EXPECT_EQ(run("convert " + data + " none --labels out --to objects --box 0,0,1,1"), 2);
    expect_said("a label for each point");
    EXPECT_FALSE(fs::exists(folder_ / "none"));
}

TEST_F(Command, ConvertTakesAPart) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out --no-report"), 0) << said();
    const io::Cloud still = io::read_cloud(folder_ / "out/static_map.pcd");
    const auto points_of = [&](const char* file) { return io::read_cloud(folder_ / file).size(); };
    ASSERT_EQ(run("convert " + data + " still.pcd --labels out --only static"), 0) << said();
    EXPECT_EQ(points_of("still.pcd"), still.size());
    ASSERT_EQ(run("convert " + data + " moving.pcd --labels out --only dynamic"), 0) << said();
    EXPECT_EQ(points_of("moving.pcd"), points_of("out/dynamic_points.pcd"));

    ASSERT_EQ(run("convert " + data + " near.pcd --max-range 8"), 0) << said();
    std::size_t near = 0;
    const io::Recording scans = io::open_recording(data);
    for (std::size_t i = 0; i < scans.size(); ++i) {
        for (const Point& p : scans.read(i).points) near += is_measured(p) && p.norm() <= 8.0F;
    }
    EXPECT_NEAR(static_cast<double>(points_of("near.pcd")), static_cast<double>(near), 50.0);
    ASSERT_EQ(run("convert still.pcd box.pcd --box=-5,-5,0,5,5,2"), 0) << said();
    ASSERT_EQ(run("convert " + data + " same.pcd --labels out --only static --box=-5,-5,0,5,5,2"),
              0);
    EXPECT_EQ(points_of("same.pcd"), points_of("box.pcd"));
    EXPECT_LT(points_of("box.pcd"), still.size());

    ASSERT_EQ(run("convert " + data + " thin.pcd --labels out --only static --thin 0.5"), 0);
    std::set<std::array<int, 3>> cells;
    for (const Point& p : io::positions(io::read_cloud(folder_ / "thin.pcd"))) {
        const Eigen::Vector3i cell = (p * 2.0F).array().floor().cast<int>();
        EXPECT_TRUE(cells.insert({cell.x(), cell.y(), cell.z()}).second) << "one for each cell";
    }
    std::set<std::array<int, 3>> all;
    for (const Point& p : io::positions(still)) {
        const Eigen::Vector3i cell = (p * 2.0F).array().floor().cast<int>();
        all.insert({cell.x(), cell.y(), cell.z()});
    }
    EXPECT_EQ(cells, all) << "none lost";

    ASSERT_EQ(run("convert " + data + " only.mcap --labels out --only static"), 0) << said();
    ASSERT_EQ(run("info only.mcap"), 0);
    expect_said("/points_static");
    EXPECT_EQ(said().find("/points "), std::string::npos);
    EXPECT_EQ(said().find("/points_dynamic"), std::string::npos);
    ASSERT_EQ(run("convert " + data + " part --labels out --box=-5,-5,5,5"), 0) << said();
    ASSERT_EQ(run("info part"), 0) << "is a recording again";
}

TEST_F(Command, ConvertWritesAllDrivesOfAMap) {
    fs::copy(recording(), folder_ / "monday", fs::copy_options::recursive);
    fs::copy(recording(), folder_ / "tuesday", fs::copy_options::recursive);
    run("run monday tuesday -o both --no-report --set map.keep_unknown=false");
    ASSERT_TRUE(fs::exists(folder_ / "both/map/index.json")) << said();
    ASSERT_EQ(run("convert both still.pcd --only static"), 0) << said();
    const auto points_of = [&](const char* file) { return io::read_cloud(folder_ / file).size(); };
    EXPECT_EQ(points_of("still.pcd"), points_of("both/drives/monday/static_map.pcd") +
                                          points_of("both/drives/tuesday/static_map.pcd"));
    ASSERT_EQ(run("convert both navigation --to nav2"), 0) << said();
    ASSERT_EQ(run("convert both map.bt --cell 0.2"), 0) << said();
    EXPECT_EQ(run("convert both x.bag"), 2);
    expect_said("is the map of several drives");
    EXPECT_EQ(run("convert both x.pcd --labels both"), 2);
    expect_said("--labels is for one recording");
    fs::rename(folder_ / "tuesday", folder_ / "wednesday");
    EXPECT_EQ(run("convert both x.pcd"), 3);
    expect_said("is not there any more; the run in");
    fs::rename(folder_ / "both/map", folder_ / "map");
    EXPECT_EQ(run("convert map x.pcd"), 3);
    expect_said("is not the whole output folder of a run");
    EXPECT_FALSE(fs::exists(folder_ / "x.pcd"));
}

TEST_F(Command, ConvertAddsNormalsAndClasses) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out --no-report"), 0) << said();
    ASSERT_EQ(run("convert " + data +
                  " map.ply --labels out --normals --ground --moving-class 18 --thin 0.2"),
              0)
        << said();
    const io::Cloud map = io::read_cloud(folder_ / "map.ply");
    const auto column = [&](const char* name) { return io::values(map, *map.find(name)); };
    const auto nx = column("nx"), ny = column("ny"), nz = column("nz"), z = column("z");
    const auto kind = column("classification"), moves = column("dynamic");
    std::size_t ground = 0, upright = 0;
    for (std::size_t i = 0; i < map.size(); ++i) {
        const double length = std::sqrt(nx[i] * nx[i] + ny[i] * ny[i] + nz[i] * nz[i]);
        EXPECT_TRUE(length == 0.0 || std::abs(length - 1.0) < 1e-4);
        EXPECT_EQ(moves[i] == 1.0, kind[i] == 18.0);
        if (kind[i] != 2.0) continue;
        EXPECT_LT(std::abs(z[i]), 0.3);
        ++ground;
        upright += nz[i] > 0.9 ? 1 : 0;
    }
    EXPECT_GT(ground, map.size() / 20);
    EXPECT_GT(upright, ground * 8 / 10);
    EXPECT_EQ(run("convert map.ply x.las --ground"), 2);
    expect_said("are for a recording that is written as one cloud");
    EXPECT_EQ(run("convert " + data + " x --normals"), 2);
}

TEST_F(Command, ConvertRefusesAPartThatIsNone) {
    const std::string data = recording().string();
    for (const auto& [options, what] : std::vector<std::pair<const char*, const char*>>{
             {"x.pcd --box 500,500,501,501", "no scan has a point"},
             {"x.pcd --box 1,2,3", "two corners"},
             {"x --thin 0.1", "--thin is for one cloud"},
             {"x.pcd --cell 0.5", "--cell is for OctoMap"},
             {"x.pcd --step 0.2", "are for --to nav2"},
             {"x.bt --to nav2", "makes a folder"},
             {"x.pcd --max-range 0", "--max-range"},
             {"x.pcd --origin 48,11", "--origin is for"}}) {
        EXPECT_EQ(run("convert " + data + " " + options), 2) << options;
        expect_said(what);
    }
    ASSERT_EQ(run("convert " + data + " cloud.pcd"), 0) << said();
    for (const char* options : {"--only static", "--max-range 5", "--labels out"}) {
        EXPECT_EQ(run(fmt::format("convert cloud.pcd x.pcd {}", options)), 2) << options;
        expect_said("is for a recording");
    }
    EXPECT_EQ(run("convert cloud.pcd x.pcd --box 500,500,501,501"), 2);
    expect_said("no point of");
    EXPECT_FALSE(fs::exists(folder_ / "x.pcd") || fs::exists(folder_ / "x"));
}

TEST_F(Command, ConvertWritesMapsAndSplitScans) {
    const std::string data = recording().string();
    ASSERT_EQ(run("run " + data + " -o out"), 0) << said();
    ASSERT_EQ(run("convert " + data + " map.las --labels out"), 0) << said();
    const io::Cloud map = io::read_cloud(folder_ / "map.las");
    ASSERT_NE(map.find("dynamic"), nullptr);
    const io::Cloud still = io::read_cloud(folder_ / "out/static_map.pcd");
    const io::Cloud moving = io::read_cloud(folder_ / "out/dynamic_points.pcd");
    EXPECT_EQ(map.size(), still.size() + moving.size());
    std::size_t dynamic = 0;
    for (const double value : io::values(map, *map.find("dynamic")))
        dynamic += value == 1.0 ? 1 : 0;
    EXPECT_EQ(dynamic, moving.size());
    ASSERT_EQ(run("convert out/static_map.pcd map.ply"), 0) << said();
    EXPECT_EQ(io::read_cloud(folder_ / "map.ply").size(), still.size());
    ASSERT_EQ(run("convert " + data + " split.mcap --labels out"), 0) << said();
    ASSERT_EQ(run("info split.mcap"), 0);
    for (const char* topic :
         {"/points ", "/points_static", "/points_dynamic", "/tf", "/static_map"}) {
        expect_said(topic);
    }
    ASSERT_EQ(run("convert out/static_map.pcd tiles --to autoware"), 0) << said();
    std::size_t in_tiles = 0, tiles = 0;
    const std::string metadata = slurp(folder_ / "tiles/pointcloud_map_metadata.yaml");
    for (const auto& entry : fs::directory_iterator(folder_ / "tiles/pointcloud_map.pcd")) {
        in_tiles += io::read_cloud(entry.path()).size();
        ++tiles;
        EXPECT_NE(metadata.find(entry.path().filename().string() + ": ["), std::string::npos);
    }
    EXPECT_EQ(in_tiles, still.size());
    EXPECT_GT(tiles, 4U);
    EXPECT_EQ(slurp(folder_ / "tiles/map_projector_info.yaml"), "projector_type: Local\n");
    ASSERT_EQ(run("convert " + data + " MAP.TXT --labels out"), 0) << said();
    expect_said("left out: poses, stamps");
    const io::Cloud text = io::read_cloud(folder_ / "MAP.TXT");
    EXPECT_EQ(text.size(), map.size());
    ASSERT_NE(text.find("dynamic"), nullptr);
    EXPECT_EQ(io::values(text, *text.find("dynamic")), io::values(map, *map.find("dynamic")));
    EXPECT_EQ(run("convert " + data + " out --overwrite"), 2);
    expect_said("result of a run");
    ASSERT_EQ(run("convert " + data + " bench --to benchmark"), 0);
    expect_said("left out: intensity, stamps");
    EXPECT_EQ(run("convert " + data + " x.pcx"), 2);
    EXPECT_EQ(run("convert nothing.pcd x.pcd"), 3);
    EXPECT_EQ(run("convert " + data + " y.mcap --labels " + data + "/velodyne"), 3);
    EXPECT_FALSE(fs::exists(folder_ / "y.mcap"));
    EXPECT_EQ(run("convert " + data + " half --labels " + data + "/velodyne"), 3);
    EXPECT_FALSE(fs::exists(folder_ / "half"));
}

TEST_F(Command, TheMapOfSeveralDrivesIsConverted) {
    const app::MapIndex index = app::write_sample_map(folder_ / "city");
    for (const char* from : {"city", "city/map", "city/map/index.json"}) {
        ASSERT_EQ(run(fmt::format("convert {} tiles --to 3dtiles --overwrite", from)), 0) << said();
        expect_said("19 tiles as");
    }
    const std::string plain = slurp(folder_ / "tiles/tileset.json");
    EXPECT_TRUE(fs::exists(folder_ / "tiles/tiles/0_2_2.glb"));
    EXPECT_EQ(run("convert city tiles --to 3dtiles"), 2);
    expect_said("not empty");
    const std::string before = slurp(folder_ / "tiles/tiles/root.glb");
    ASSERT_EQ(run("convert city tiles --to 3dtiles --overwrite --origin 48.1,11.6"), 0) << said();
    EXPECT_NE(slurp(folder_ / "tiles/tileset.json"), plain);
    EXPECT_EQ(slurp(folder_ / "tiles/tiles/root.glb"), before) << "the same bytes again";
    ASSERT_EQ(run("convert city las --to las"), 0) << said();
    expect_said("rounded to 1 mm");
    EXPECT_EQ(io::read_cloud(folder_ / "las/las/0_2_2.las").size(),
              io::read_cloud(folder_ / "city/map/0_2_2.pcd").size());
    ASSERT_EQ(run("convert city autoware --to autoware"), 0) << said();
    EXPECT_TRUE(fs::exists(folder_ / "autoware/pointcloud_map_metadata.yaml"));
    ASSERT_EQ(run("convert city placed --to autoware --origin 48.1374,11.5755,520"), 0) << said();
    EXPECT_NE(slurp(folder_ / "placed/map_projector_info.yaml").find("  latitude: 48.1374\n"),
              std::string::npos);
    ASSERT_EQ(run("info city"), 0) << said();
    for (const char* part : {"tiles   19", "drive_2", "voxels"}) expect_said(part);
}

TEST_F(Command, OptionsForTheMapOfSeveralDrivesAreChecked) {
    app::write_sample_map(folder_ / "city");
    EXPECT_EQ(run("convert city x"), 2);
    expect_said("--to nav2, --to 3dtiles, --to las or --to autoware");
    EXPECT_EQ(run("convert city x --to las --origin 1,2"), 2);
    expect_said("--to las needs --crs");
    EXPECT_EQ(run("convert city x --to las --box 0,0,1,1"), 2);
    expect_said("not for the map of several drives");
    EXPECT_EQ(run("convert city x --to 3dtiles --origin north"), 2);
    expect_said("expected LAT,LON");
    EXPECT_EQ(run("convert city x --to 3dtiles --labels city"), 2);
    EXPECT_EQ(run("convert " + recording().string() + " x --to 3dtiles"), 2);
    expect_said("is for the map of several drives");
    fs::remove(folder_ / "city/map/0_2_2.pcd");
    EXPECT_EQ(run("convert city x --to 3dtiles"), 3);
    expect_said("0_2_2.pcd");
    EXPECT_FALSE(fs::exists(folder_ / "x")) << "half an export misleads";
}

TEST_F(Command, PointsThatLasLeavesOutAreNotCounted) {
    spill(folder_ / "a.xyz", "1 2 3\n4 nan 6\n7 8 9\n");
    EXPECT_EQ(run("convert a.xyz a.las"), 0);
    expect_said("(2 points)");
    expect_said("1 points that are not finite");
    EXPECT_EQ(run("convert a.xyz a.ply"), 0);
    expect_said("(3 points)");
    spill(folder_ / "far.xyz", "1 2 3\n1e10 5 6\n");
    EXPECT_EQ(run("convert far.xyz far.las"), 1);
    expect_said("x = 1 to 1e+10 m, wider than the 4,000 km");
}

TEST_F(Command, ReportsOfRunsAndMapsAreSetSideBySide) {
    if (app::viewer_page().empty())
        GTEST_SKIP() << "built WITHOUT THE VIEWER: script/bootstrap fetches what it needs";
    ASSERT_EQ(run("run " + recording().string() + " -o out"), 0);
    const std::string report = slurp(folder_ / "out/report.html");
    EXPECT_NE(report.find("\"scans\":24"), std::string::npos);
    EXPECT_LT(report.size(), 30'000'000U);
    const auto timing = nlohmann::json::parse(slurp(folder_ / "out/timing.json"));
    EXPECT_EQ(timing["process"].back()["stage"], "report");

    ASSERT_EQ(
        run("report out out/static_map.pcd --truth " + recording().string() + " -o both.html"), 0)
        << said();
    const std::string both = slurp(folder_ / "both.html");
    EXPECT_NE(both.find("id=\"run-0-map-position\""), std::string::npos);
    EXPECT_NE(both.find("id=\"run-1-map-position\""), std::string::npos);
    EXPECT_EQ(both.find("id=\"run-1-frame-begin\""), std::string::npos);  // a map has no scans
    EXPECT_NE(both.find("\"name\":\"static_map.pcd\""), std::string::npos);

    EXPECT_EQ(run("report out/labels"), 3);
    expect_said("holds no report.html");
    EXPECT_EQ(run("report out/config.toml"), 3);
    EXPECT_EQ(run("report out -o out/report.html"), 0) << said();  // the same again
    EXPECT_EQ(run("report out/report.html -o out/report.html"), 2);
    EXPECT_EQ(slurp(folder_ / "out/report.html"), report);
    EXPECT_EQ(run("serve out/labels"), 3);
    EXPECT_EQ(run("run " + recording().string() + " -o no --port 80"), 2);
    EXPECT_EQ(run("run " + recording().string() + " -o no --view --port 99999"), 2);
}

/// Cars that drive beside the sensor tell nothing of the times of points, and the scans of a sensor
/// that sees a part of the surroundings overlay less evenly than others do.
TEST_F(Command, CheckIsSilentAboutSoundScans) {
    EXPECT_EQ(run("simulate jam --frames 60 --rate 10 --sweep --seed 63 -o jam"), 0) << said();
    EXPECT_EQ(run("check jam"), 0) << said();
    EXPECT_EQ(run("simulate square --sensor solid --frames 40 --rate 10 --seed 32 -o square"), 0);
    EXPECT_EQ(run("check square"), 0) << said();
}

TEST_F(Command, CheckSaysWhatToTypeAndThatWorks) {
    const std::string data = recording().string();
    EXPECT_EQ(run("check " + data), 0) << said();
    std::vector<Pose> poses = io::open_recording(recording()).info().T_world_sensor;
    for (Pose& pose : poses) pose = pose.inverse();
    io::write_poses_kitti(folder_ / "inverse.txt", poses);
    EXPECT_EQ(run("check " + data + " --poses inverse.txt"), 4);
    const std::string fixed = data + " --poses inverse.txt --pose-fix inverse";
    expect_said("try       dynamicfilter run " + fixed + "\n");
    expect_said("next      dynamicfilter run " + fixed + "\n");
    EXPECT_EQ(run("check " + fixed), 0) << said();
    expect_said("next      dynamicfilter run " + fixed + "\n");
    EXPECT_EQ(run("check " + data + " --pose-fix inverse"), 4);
    expect_said("the poses are right without --pose-fix inverse");
    EXPECT_EQ(run("check " + data + " --poses none --pose-fix inverse"), 2);
    expect_said("no poses to correct");
    EXPECT_EQ(run("run " + data + " --poses inverse.txt -o out"), 0);
    expect_said("warning: the poses are inverse");
}

TEST_F(Command, ALayoutIsNamedAndOnlyThisOneIsRead) {
    const std::string data = recording().string();
    EXPECT_EQ(run("info " + data + " --first 2 --stride 2"), 0) << said();
    expect_said("format  kitti\n");
    EXPECT_EQ(run("info " + data + "/velodyne/000000.bin --stride 2"), 2);
    expect_said("are for recordings");
    EXPECT_EQ(run("check " + data + " --format kitti --stride 2"), 0) << said();
    EXPECT_EQ(run("check " + data + " --format kitti-360"), 3);
    expect_said("is not a drive of KITTI-360 (--format kitti-360); looked for data_3d_raw/");
}

TEST_F(Command, CheckComparesTheFramesOfSeveralRecordings) {
    const std::string data = recording().string();
    ASSERT_EQ(run("convert " + data + " monday --stride 2"), 0) << said();
    ASSERT_EQ(run("convert " + data + " tuesday --first 1 --stride 2"), 0) << said();
    EXPECT_EQ(run("check monday tuesday"), 0) << said();
    expect_said("recording monday\n");
    expect_said("recording tuesday\n");
    expect_said("frames    monday and tuesday: their scans overlay at ");
    expect_said("next      dynamicfilter run monday tuesday\n");

    std::vector<Pose> moved = io::open_recording(folder_ / "tuesday").info().T_world_sensor;
    for (Pose& pose : moved) pose.pretranslate(Eigen::Vector3d(0.0, 0.5, 0.0));
    io::write_poses_kitti(folder_ / "tuesday/poses.txt", moved);
    EXPECT_EQ(run("check monday tuesday"), 4) << said();
    expect_said("tuesday shows things (0.00, 0.50, 0.00) m from where monday shows them");
    expect_said("advice    add (0.00, -0.50, 0.00) m to the positions of the poses of tuesday");
    EXPECT_EQ(run("check tuesday"), 0) << said();  // alone it is right
    spill(folder_ / "list.txt", "monday\n# a comment\ntuesday\tmonday/poses.txt\n");
    EXPECT_EQ(run("check list.txt"), 4) << said();
    expect_said("monday and tuesday have the same poses");

    EXPECT_EQ(run("check monday tuesday --poses none"), 4) << said();
    expect_said("monday, tuesday have no poses");
    EXPECT_EQ(run("check monday tuesday monday"), 2);
    expect_said("monday: is given twice");
    EXPECT_EQ(run("check monday tuesday --poses monday/poses.txt"), 2);
    expect_said("belongs to one recording");
    EXPECT_EQ(run("check monday nowhere"), 3);
}

}  // namespace command_test
}  // namespace dynamic_filter
