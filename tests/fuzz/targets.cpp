// SPDX-License-Identifier: MIT
#include "fuzz/targets.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/poses.hpp"
#include "dynamic_filter/recording.hpp"
#include "formats/bags/bag_file.hpp"
#include "formats/byte_reader.hpp"
#include "formats/clouds/bin_layout.hpp"
#include "formats/knowable_file.hpp"
#include "formats/messages/messages.hpp"
#include "recording/frame_tree.hpp"
#include "recording/mask.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::fuzz {
namespace {

/// The bytes as a file that is nowhere on disk.
class MemoryFile {
public:
    explicit MemoryFile(std::span<const std::uint8_t> bytes) : descriptor_(memfd_create("f", 0)) {
        if (descriptor_ < 0 || write(descriptor_, bytes.data(), bytes.size()) < 0) std::abort();
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;
    ~MemoryFile() { close(descriptor_); }
    [[nodiscard]] std::filesystem::path path() const {
        return "/proc/self/fd/" + std::to_string(descriptor_);
    }

private:
    int descriptor_;
};

template <class Read>
void expect_result_or_error(std::span<const std::uint8_t> bytes, const Read& read) {
    const MemoryFile file(bytes);
    try {
        read(file.path());
    } catch (const Error&) {
    }
}

void use_cloud(const io::Cloud& cloud) {
    if (cloud.data.size() != cloud.size() * cloud.point_bytes) std::abort();
    (void)io::positions(cloud);
    (void)io::point_times(cloud, 0.0);
}

void use_message(const io::FoundMessage& found) {
    const io::Message message{found.topic, found.recorded_ns, {}, found.data};
    try {
        switch (io::kind_of(found.topic.type)) {
            case io::MessageKind::cloud:
            case io::MessageKind::livox:
                use_cloud(io::read_cloud_message(found.data, found.topic).cloud);
                break;
            case io::MessageKind::odometry:
            case io::MessageKind::pose:
                (void)io::read_pose_message(message);
                break;
            case io::MessageKind::transforms: {
                io::FrameTree frames;
                for (const auto& transform : io::read_transforms(message)) {
                    frames.add(transform, false);
                }
                frames.put_in_order();
                (void)frames.pose("lidar", "map", 0.0);
                break;
            }
            case io::MessageKind::other:
                break;
        }
    } catch (const io::Malformed&) {
    }
}

using OpenBag = std::unique_ptr<io::BagFile> (*)(const std::filesystem::path&);
template <OpenBag open>
void read_bag(std::span<const std::uint8_t> bytes) {
    expect_result_or_error(bytes, [](const std::filesystem::path& file) {
        const auto bag = open(file);
        std::uint64_t chunk = 0, offset = 0;
        std::size_t size = SIZE_MAX;
        (void)bag->for_each([&](const io::FoundMessage& message) {
            use_message(message);
            chunk = message.chunk;
            offset = message.offset;
            size = message.data.size();
        });
        if (size != SIZE_MAX && bag->read(chunk, offset).size() != size) std::abort();
    });
}

template <io::Cloud (*read)(const std::filesystem::path&)>
void read_cloud_file(std::span<const std::uint8_t> bytes) {
    expect_result_or_error(bytes, [](const auto& file) { use_cloud(read(file)); });
}

void read_bin_as_it_looks(std::span<const std::uint8_t> bytes) {
    const auto data = std::as_bytes(bytes);
    const io::BinSample sample{{data.begin(), data.end()}, data.size()};
    const io::BinChoice choice = io::choose_bin_layout({&sample, 1});
    expect_result_or_error(bytes, [&](const auto& file) {
        use_cloud(choice.layout ? io::read_bin(file, *choice.layout) : io::read_bin(file));
    });
}

/// The first byte chooses the type and the encoding, the rest is the message.
void read_message(std::span<const std::uint8_t> bytes) {
    constexpr const char* kTypes[] = {"sensor_msgs/PointCloud2", "livox_ros_driver2/CustomMsg",
                                      "nav_msgs/Odometry", "tf2_msgs/TFMessage"};
    if (bytes.empty()) return;
    const io::Topic topic{
        "/t", kTypes[bytes[0] % 4],
        bytes[0] / 4 % 2 == 0 ? io::MessageEncoding::cdr : io::MessageEncoding::ros1};
    try {
        use_message({topic, 0, 0, 0, std::as_bytes(bytes.subspan(1))});
    } catch (const Error&) {
    }
}

}  // namespace

const std::map<std::string, Target>& targets() {
    static const std::map<std::string, Target> all = {
        {"pcd", read_cloud_file<io::read_pcd>},
        {"ply", read_cloud_file<io::read_ply>},
        {"bin", read_bin_as_it_looks},
        {"mask",
         [](std::span<const std::uint8_t> bytes) {
             expect_result_or_error(bytes, [](const auto& file) { (void)io::read_boxes(file); });
         }},
        {"las", read_cloud_file<io::read_las>},
        {"npy", read_cloud_file<io::read_npy>},
        {"text", read_cloud_file<io::read_text_cloud>},
        {"mcap", read_bag<io::open_mcap>},
        {"rosbag1", read_bag<io::open_rosbag1>},
        {"rosbag2", read_bag<io::open_rosbag2>},
        {"message", read_message},
        {"poses",
         [](std::span<const std::uint8_t> bytes) {
             expect_result_or_error(bytes, [](const auto& file) { (void)io::read_poses(file); });
         }},
        {"calib",
         [](std::span<const std::uint8_t> bytes) {
             expect_result_or_error(bytes, [](const auto& file) { (void)io::read_calib_tr(file); });
         }},
        {"labels",
         [](std::span<const std::uint8_t> bytes) {
             expect_result_or_error(bytes, [](const auto& file) { (void)io::read_labels(file); });
         }},
        {"knowable",
         [](std::span<const std::uint8_t> bytes) {
             expect_result_or_error(
                 bytes, [&](const auto& file) { (void)io::read_knowable(file, bytes.size() / 4); });
         }},
        {"config",
         [](std::span<const std::uint8_t> bytes) {
             expect_result_or_error(
                 bytes, [](const auto& file) { (void)app::load_config({.file = file}); });
         }},
    };
    return all;
}

}  // namespace dynamic_filter::fuzz
