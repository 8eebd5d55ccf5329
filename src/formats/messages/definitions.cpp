// SPDX-License-Identifier: MIT
#include "formats/messages/definitions.hpp"

#include <algorithm>
#include <array>
#include <sstream>
#include <string_view>
#include <vector>

namespace dynamic_filter::io {
namespace {

struct Part {
    std::string_view type, fields;
};

constexpr std::array kParts = {
    Part{"diagnostic_msgs/DiagnosticArray",
         "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
    Part{"diagnostic_msgs/DiagnosticStatus",
         "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\n"
         "string message\nstring hardware_id\ndiagnostic_msgs/KeyValue[] values\n"},
    Part{"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
    Part{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    Part{"geometry_msgs/Pose",
         "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Part{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    Part{"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
    Part{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    Part{"geometry_msgs/Transform",
         "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
    Part{"geometry_msgs/TransformStamped",
         "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
    Part{"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    Part{"geometry_msgs/TwistWithCovariance",
         "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
    Part{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    Part{"nav_msgs/OccupancyGrid",
         "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"},
    Part{"nav_msgs/Odometry",
         "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
         "geometry_msgs/TwistWithCovariance twist\n"},
    Part{"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
    Part{"sensor_msgs/PointCloud2",
         "std_msgs/Header header\nuint32 height\nuint32 width\nsensor_msgs/PointField[] fields\n"
         "bool is_bigendian\nuint32 point_step\nuint32 row_step\nuint8[] data\nbool is_dense\n"},
    Part{"sensor_msgs/PointField",
         "uint8 INT8=1\nuint8 UINT8=2\nuint8 INT16=3\nuint8 UINT16=4\nuint8 INT32=5\n"
         "uint8 UINT32=6\nuint8 FLOAT32=7\nuint8 FLOAT64=8\nstring name\nuint32 offset\n"
         "uint8 datatype\nuint32 count\n"},
    Part{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    Part{"std_msgs/String", "string data\n"},
    Part{"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
    Part{"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
};

constexpr std::array kOfRos1 = {
    Part{"nav_msgs/MapMetaData",
         "time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
         "geometry_msgs/Pose origin\n"},
    Part{"std_msgs/Header", "uint32 seq\ntime stamp\nstring frame_id\n"},
    Part{"visualization_msgs/Marker",
         "uint8 ARROW=0\nuint8 CUBE=1\nuint8 SPHERE=2\nuint8 CYLINDER=3\nuint8 LINE_STRIP=4\n"
         "uint8 LINE_LIST=5\nuint8 CUBE_LIST=6\nuint8 SPHERE_LIST=7\nuint8 POINTS=8\n"
         "uint8 TEXT_VIEW_FACING=9\nuint8 MESH_RESOURCE=10\nuint8 TRIANGLE_LIST=11\n"
         "uint8 ADD=0\nuint8 MODIFY=0\nuint8 DELETE=2\nuint8 DELETEALL=3\n"
         "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
         "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
         "duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
         "std_msgs/ColorRGBA[] colors\nstring text\nstring mesh_resource\n"
         "bool mesh_use_embedded_materials\n"},
};
constexpr std::array kOfRos2 = {
    Part{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    Part{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    Part{"nav_msgs/MapMetaData",
         "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
         "geometry_msgs/Pose origin\n"},
    Part{"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    Part{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    // Since Humble, with textures and files of meshes.
    Part{"visualization_msgs/Marker",
         "std_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
         "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
         "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
         "std_msgs/ColorRGBA[] colors\nstring texture_resource\n"
         "sensor_msgs/CompressedImage texture\nvisualization_msgs/UVCoordinate[] uv_coordinates\n"
         "string text\nstring mesh_resource\nvisualization_msgs/MeshFile mesh_file\n"
         "bool mesh_use_embedded_materials\n"},
    Part{"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    Part{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
};

std::string_view fields_in(std::span<const Part> parts, std::string_view type) {
    const auto found = std::find_if(parts.begin(), parts.end(),
                                    [&](const Part& part) { return part.type == type; });
    return found == parts.end() ? std::string_view{} : found->fields;
}

std::string fields_of(std::string_view type, MessageEncoding encoding) {
    const std::string_view shared = fields_in(kParts, type);
    if (!shared.empty()) return std::string(shared);
    return std::string(encoding == MessageEncoding::ros1 ? fields_in(kOfRos1, type)
                                                         : fields_in(kOfRos2, type));
}

/// The types of fields that contain the name of a package.
std::vector<std::string> types_in(const std::string& fields) {
    std::vector<std::string> types;
    std::istringstream lines(fields);
    for (std::string type, rest; lines >> type && std::getline(lines, rest);) {
        if (type.find('/') != std::string::npos) types.push_back(type.substr(0, type.find('[')));
    }
    return types;
}

}  // namespace

const Definition* find_definition(const std::string& type) {
    static const std::array definitions = {
        Definition{"diagnostic_msgs/DiagnosticArray", "60810da900de1dd6ddd437c3503511da"},
        Definition{"geometry_msgs/PoseStamped", "d3812c3cbc69362b77dc0b19b345f8f5"},
        Definition{"nav_msgs/OccupancyGrid", "3381f2d731d4076ec5c71b0759edbe4e"},
        Definition{"nav_msgs/Odometry", "cd5e73d190d741a2f92e81eda573aca7"},
        Definition{"nav_msgs/Path", "6227e2b7e9cce15051f669a5e197bbf7"},
        Definition{"sensor_msgs/PointCloud2", "1158d486dd51d683ce2f1be655c3c181"},
        Definition{"std_msgs/Empty", "d41d8cd98f00b204e9800998ecf8427e"},
        Definition{"std_msgs/String", "992ce8a1687cec8c8bd883ec73ca41d1"},
        Definition{"tf2_msgs/TFMessage", "94810edda583a504dfda3829e70d7eec"},
        Definition{"visualization_msgs/MarkerArray", "d155b9ce5188fbaf89745847fd5882d7"},
    };
    const auto found = std::find_if(definitions.begin(), definitions.end(),
                                    [&](const Definition& d) { return d.type == type; });
    return found == definitions.end() ? nullptr : &*found;
}

std::string full_definition(const std::string& type, MessageEncoding encoding) {
    constexpr std::size_t kRule = 80;  // separator between types that parsers look for
    std::vector<std::string> types{type};
    std::string text;
    for (std::size_t i = 0; i < types.size(); ++i) {
        const std::string fields = fields_of(types[i], encoding);
        if (i > 0) text += std::string(kRule, '=') + "\nMSG: " + types[i] + "\n";
        text += fields;
        for (const std::string& part : types_in(fields)) {
            if (std::find(types.begin(), types.end(), part) == types.end()) types.push_back(part);
        }
    }
    return text;
}

std::string ros2_type(const std::string& type) {
    const std::size_t slash = type.find('/');
    return type.substr(0, slash) + "/msg" + type.substr(slash);
}

}  // namespace dynamic_filter::io
