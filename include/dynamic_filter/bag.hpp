// SPDX-License-Identifier: MIT
/// @file
/// Reads recorded messages from MCAP files, ROS 1 bags (.bag) and ROS 2 bags. A ROS 2 bag is a
/// folder of .db3 or .mcap files, with or without metadata.yaml, or one such file. Also writes bags
/// that other programs can read: MCAP and SQLite as ROS 2 writes them, and .bag of ROS 1; and makes
/// the serialized messages for them, with covariances and velocities of zero.
///
/// - Units: [ns] since the epoch of the recorder, [bytes]; in messages that are made, [m] and
///   stamps [s], rounded to nanoseconds.
/// - Frames: the caller names them.
/// - Shapes: messages are bytes.
/// - Ownership: a Bag owns its open files; a Message borrows from it for the call. Topics and bytes
///   to write are borrowed for the call. Messages that are made are values.
/// - Threads: Bag::read() and the functions that make messages may be called from any thread; all
///   other members have a single caller.
/// - Errors: InputError if nothing can be read; damage to a part of a bag is returned as a Defect.
///   BagWriter: OutputError, and ConfigError from create(); without commit(), no file is left.
///   Error if a stamp or a text does not fit into a message.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/types.hpp"

namespace dynamic_filter::io {

/// How the fields of a message are serialized: as in ROS 1, or as CDR in ROS 2.
enum class MessageEncoding : std::uint8_t {
    ros1,  ///< little endian, without alignment
    cdr    ///< with alignment, in either byte order, after a header of 4 bytes
};

/// A topic of a bag.
struct Topic {
    std::string name;  ///< such as "/points"
    std::string type;  ///< such as "sensor_msgs/PointCloud2"; without "/msg" of ROS 2
    MessageEncoding encoding = MessageEncoding::cdr;  ///< encoding of its messages
    bool operator==(const Topic&) const = default;    ///< compares all three members
};

/// The position of a message. Valid only for the Bag that returned it.
struct MessageRef {
    std::size_t file = 0;      ///< index into Bag::files()
    std::uint64_t chunk = 0;   ///< [bytes] from the start of the file, or the number of a row
    std::uint64_t offset = 0;  ///< [bytes] from the start of the chunk
};

/// A message of a bag; `data` is valid only during the call.
struct Message {
    const Topic& topic;  ///< topic of the bag
    /// [ns] when the recorder received it; its header may have another stamp.
    std::int64_t recorded_ns = 0;
    MessageRef ref;                   ///< position, for Bag::read()
    std::span<const std::byte> data;  ///< bytes in the encoding of the topic
};

/// A part of a bag that cannot be read.
struct Defect {
    std::string what;  ///< one sentence, with the file and the byte
    /// True: messages are missing. False: messages may be missing, but the file does not tell.
    bool lost = true;
};

class BagFile;

/// Reads bags without an index. From a truncated or damaged file, everything readable is read, and
/// the rest is reported.
class Bag {
public:
    /// True if the path looks like a bag: .mcap, .bag, .bag.active, .db3, or a folder with such
    /// files.
    static bool recognises(const std::filesystem::path& path);

    /// Throws InputError if the path is no bag.
    explicit Bag(const std::filesystem::path& path);
    Bag(Bag&&) noexcept;  ///< the moved-from object can only be destroyed
    ~Bag();

    /// Calls `use` once for every message, file after file, in the order in which they were
    /// written. Reads all bytes once; needs memory for one chunk. Returns what could not be read.
    std::vector<Defect> for_each(const std::function<void(const Message&)>& use) const;

    /// Reads one message again. Throws InputError if it cannot be read any more. Thread-safe.
    [[nodiscard]] std::vector<std::byte> read(const MessageRef& message) const;

    /// Files of the bag, in the order in which for_each() reads them.
    [[nodiscard]] const std::vector<std::filesystem::path>& files() const { return paths_; }

private:
    std::vector<std::filesystem::path> paths_;
    std::vector<std::unique_ptr<BagFile>> files_;
};

/// Writes a bag that appears complete with commit(), or not at all. The same calls give the same
/// bytes. Memory: one chunk (1 MiB, or one larger message) and an index. Single caller. All members
/// throw OutputError.
class BagWriter {
public:
    /// Chooses the format by the extension: .mcap (zstd), .db3, or .bag (lz4). Throws ConfigError
    /// for any other extension.
    static std::unique_ptr<BagWriter> create(const std::filesystem::path& path);
    /// True if create() knows the extension, in upper or lower case.
    static bool recognises(const std::filesystem::path& path);

    BagWriter() = default;
    BagWriter(const BagWriter&) = delete;
    BagWriter& operator=(const BagWriter&) = delete;
    virtual ~BagWriter() = default;

    /// The encoding that messages must have: `ros1` for .bag, `cdr` for the others.
    [[nodiscard]] virtual MessageEncoding encoding() const = 0;

    /// Writes a message. A topic is registered when it is first used; its type must be one of those
    /// that the functions below make. `time_ns` is the time of recording: not negative,
    /// in any order.
    virtual void write(const Topic& topic, std::int64_t time_ns,
                       std::span<const std::byte> data) = 0;

    /// Completes the bag. Nothing can be written after it.
    virtual void commit() = 0;
};

/// Converts a stamp [s] to [ns], rounded; exact if the double is. Throws Error if the stamp is not
/// in [0, 2^31 s), the range of both ROS 1 and ROS 2.
std::int64_t to_nanoseconds(double stamp);

/// sensor_msgs/PointCloud2 with the fields of the cloud in their order, at `stamp` [s]. The message
/// type has no 64-bit integers; they become float64. Throws Error if x, y or z is missing.
std::vector<std::byte> cloud_message(const Cloud& cloud, double stamp, const std::string& frame,
                                     MessageEncoding encoding);

/// tf2_msgs/TFMessage with one transform, at `stamp` [s].
std::vector<std::byte> transform_message(const std::string& parent, const std::string& child,
                                         const Pose& T_parent_child, double stamp,
                                         MessageEncoding encoding);

/// nav_msgs/Odometry of `child` in `parent`, at `stamp` [s].
std::vector<std::byte> odometry_message(const std::string& parent, const std::string& child,
                                        const Pose& T_parent_child, double stamp,
                                        MessageEncoding encoding);

/// geometry_msgs/PoseStamped: a pose in `frame`, at `stamp` [s].
std::vector<std::byte> pose_message(const std::string& frame, const Pose& pose, double stamp,
                                    MessageEncoding encoding);

/// nav_msgs/Path: poses in `frame`, each with its stamp [s]; the arrays are parallel. The message
/// has the stamp of the last pose.
std::vector<std::byte> path_message(const std::string& frame, const std::vector<double>& stamps,
                                    const std::vector<Pose>& poses, MessageEncoding encoding);

/// A box for display, with edges along the axes of its frame.
struct BoxMarker {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< [m]
    Eigen::Vector3d size = Eigen::Vector3d::Ones();    ///< [m]
};

/// visualization_msgs/MarkerArray at `stamp` [s]: removes all earlier markers, then adds a red,
/// half-transparent box for each entry. ROS 2: as of Humble.
std::vector<std::byte> boxes_message(const std::vector<BoxMarker>& boxes, double stamp,
                                     const std::string& frame, MessageEncoding encoding);

/// Cells of a plane with z pointing up.
struct OccupancyCells {
    double cell = 0.0;                                 ///< [m] width of a cell
    std::uint32_t width = 0;                           ///< cells along x
    std::uint32_t height = 0;                          ///< cells along y
    Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< [m] lower left corner of the first cell
    std::vector<std::int8_t> values{};  ///< row by row along x; 0 free, 100 occupied, -1 unknown
};

/// nav_msgs/OccupancyGrid at `stamp` [s].
std::vector<std::byte> occupancy_message(const OccupancyCells& cells, double stamp,
                                         const std::string& frame, MessageEncoding encoding);

/// A row of diagnostic_msgs/DiagnosticStatus.
struct DiagnosticStatus {
    std::uint8_t level = 0;  ///< 0: good, 1: warning, 2: error, 3: no data comes
    std::string name;        ///< of the part that is described
    std::string message;     ///< its state, in a few words
    std::string hardware;    ///< the device, or what is looked at
    std::vector<std::pair<std::string, std::string>> values;  ///< names and values, for display
};

/// diagnostic_msgs/DiagnosticArray at `stamp` [s].
std::vector<std::byte> diagnostics_message(const std::vector<DiagnosticStatus>& statuses,
                                           double stamp, MessageEncoding encoding);

}  // namespace dynamic_filter::io
