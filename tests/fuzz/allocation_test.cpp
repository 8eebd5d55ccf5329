// SPDX-License-Identifier: MIT
// When memory runs out: every reader and the filter, with each allocation failing in turn.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <new>
#include <numeric>

#include "dynamic_filter/bag.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/online.hpp"
#include "dynamic_filter/poses.hpp"
#include "dynamic_filter/writers.hpp"
#include "fuzz/failing_new.hpp"
#include "paper/pipeline.hpp"
#include "recording/scans.hpp"
#include "support/room.hpp"
#include "support/temporary_folder.hpp"

namespace dynamic_filter {
namespace allocation_test {

namespace fs = std::filesystem;

constexpr long kAll = std::numeric_limits<long>::max();

/// What a piece of work gives, as bytes to compare.
using Work = std::function<std::string()>;

/// Empty: it threw what it may throw.
std::optional<std::string> result_of(const Work& work) {
    try {
        return work();
    } catch (const std::bad_alloc&) {
    } catch (const Error&) {
    }
    return std::nullopt;
}

/// Whichever allocation fails, alone or with all behind it: the work throws, or gives what it
/// should; and it works afterwards. `step`: beyond the first so many, only some of them.
void expect_survives(const Work& work, long step = kAll) {
    const std::string expected = work();
    for (const long more : {0L, kAll - 1}) {
        bool met = true;
        for (long k = 1; met; k += 1 + k / step) {
            std::optional<std::string> result;
            {
                const fuzz::NoMemory no_memory(k, more);
                result = result_of(work);
                met = no_memory.was_met();
            }
            ASSERT_TRUE(!result || *result == expected) << "allocation " << k << ", more " << more;
            ASSERT_TRUE(met || k > 1) << "nothing was allocated";
        }
        EXPECT_TRUE(work() == expected);
    }
}

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
    if (count > 0) bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}
std::string bytes_of(const io::Cloud& cloud) {
    std::string bytes;
    for (const io::Field& field : cloud.fields) bytes += field.name + " ";
    append(bytes, cloud.data.data(), cloud.data.size());
    return bytes;
}
std::string bytes_of(const fs::path& bag) {
    std::string bytes;
    const auto defects = io::Bag(bag).for_each([&](const io::Message& message) {
        bytes += message.topic.name + " ";
        append(bytes, message.data.data(), message.data.size());
    });
    for (const io::Defect& defect : defects) bytes += defect.what;
    return bytes;
}
std::string bytes_of(const io::PoseFile& file) {
    std::string bytes;
    for (const Pose& pose : file.poses) append(bytes, pose.matrix().data(), 16);
    append(bytes, file.stamps.data(), file.stamps.size());
    return bytes;
}
std::string bytes_of(const std::vector<Verdict>& verdicts) {
    std::string bytes;
    for (const Verdict& verdict : verdicts) {
        append(bytes, verdict.labels.data(), verdict.labels.size());
        append(bytes, verdict.probability.data(), verdict.probability.size());
    }
    return bytes;
}

/// Every seed that the reader of its kind can read.
void expect_reader_survives(const std::string& kind,
                            const std::function<std::string(const fs::path&)>& read) {
    std::size_t readable = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(DYNAMIC_FILTER_CORPUS) / kind)) {
        SCOPED_TRACE(entry.path().string());
        const Work work = [&] { return read(entry.path()); };
        try {
            work();
        } catch (const Error&) {
            continue;
        }
        ++readable;
        expect_survives(work);
    }
    EXPECT_GT(readable, 0U) << kind;
}

TEST(Allocation, CloudReadersSurviveEveryFailure) {
    for (const char* kind : {"bin", "las", "npy", "pcd", "ply", "text"}) {
        expect_reader_survives(kind,
                               [](const auto& file) { return bytes_of(io::read_cloud(file)); });
    }
}

TEST(Allocation, BagReadersSurviveEveryFailure) {
    for (const char* kind : {"mcap", "rosbag1", "rosbag2"}) {
        expect_reader_survives(kind, [](const auto& file) { return bytes_of(file); });
    }
}

TEST(Allocation, PoseReadersSurviveEveryFailure) {
    expect_reader_survives("poses",
                           [](const auto& file) { return bytes_of(io::read_poses(file)); });
}

/// Few points, so that a run is short.
std::vector<Scan> small_scans() {
    std::vector<Scan> scans;
    for (std::size_t i = 0; i < 10; ++i) {
        const auto t = static_cast<double>(i);
        Pose pose = Pose::Identity();
        pose.translation() = Eigen::Vector3d(0.0625 * t, 0.25, 1.25);
        const Eigen::Vector3d feet(4.5, 0.4 * t - 2.0, 0.02);
        auto seen = test::scan_room(
            pose, {{-6.03, -5.03, 0.02}, {9.03, 5.03, 3.1}},
            {{feet - Eigen::Vector3d(0.25, 0.25, 0.0), feet + Eigen::Vector3d(0.25, 0.25, 1.7)}},
            {.rings = 8, .columns = 60});
        seen.scan.stamp = 0.5 * t;
        seen.scan.index = i;
        scans.push_back(std::move(seen.scan));
    }
    return scans;
}

/// Reads in batches, on several threads. The recording is opened before, because libstdc++ 12 ends
/// the program if it has no memory for a name while it lists a folder.
TEST(Allocation, ReadingScansSurvivesEveryFailure) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "velodyne");
    std::vector<Pose> poses;
    for (const Scan& scan : small_scans()) {
        io::write_bin(folder / ("velodyne/00000" + std::to_string(scan.index) + ".bin"),
                      scan.points, std::vector<float>(scan.points.size()));
        poses.push_back(scan.T_world_sensor);
    }
    io::write_poses_kitti(folder / "poses.txt", poses);
    const io::Recording recording = io::open_recording(folder.path());
    std::vector<std::size_t> all(recording.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    expect_survives([&] {
        std::string bytes;
        app::for_each_scan(recording, all, {}, [&](std::size_t, app::MaybeScan& maybe) {
            if (!maybe.scan) throw Error(maybe.error);  // it says that memory is short
            bytes += bytes_of(maybe.scan->cloud);
            return true;
        });
        return bytes;
    });
}

/// A filter is of no use after a failure, but a new one works.
TEST(Allocation, TheFilterSurvivesEveryFailure) {
    const std::vector<Scan> scans = small_scans();
    expect_survives(
        [&] {
            DynamicFilter filter{Config{}};
            std::string bytes;
            for (const Scan& scan : scans) bytes += bytes_of({filter.push(scan)});
            filter.finish();
            for (const Scan& scan : scans) bytes += bytes_of({filter.verdict(scan)});
            return bytes;
        },
        32);
}

TEST(Allocation, ThePapersPipelineSurvivesEveryFailure) {
    const std::vector<Scan> scans = small_scans();
    expect_survives(
        [&] {
            PaperPipeline pipeline(preset("paper"));
            std::string bytes;
            for (const Scan& scan : scans) bytes += bytes_of(pipeline.push(scan));
            bytes += bytes_of(pipeline.finish());
            for (const Scan& scan : scans) bytes += bytes_of({pipeline.verdict(scan)});
            return bytes;
        },
        32);
}

/// A failure in one of its threads is reported to the caller.
TEST(Allocation, TheOnlineFilterSurvivesEveryFailure) {
    const std::vector<Scan> scans = small_scans();
    expect_survives(
        [&] {
            OnlineFilter filter(Config{}, {.overload = Overload::wait, .threads = 2}, {});
            for (const Scan& scan : scans) filter.push(scan);
            filter.finish();
            std::string bytes;
            for (const Scan& scan : scans) bytes += bytes_of({filter.verdict(scan)});
            return bytes;
        },
        16);
}

}  // namespace allocation_test
}  // namespace dynamic_filter
