// SPDX-License-Identifier: MIT
// What is in a message that others' readers decoded, as a line.
"use strict";
const fnv1a = require("./fnv1a.cjs");

/// x, y, z and intensity of each point.
function pointValues(cloud) {
  const view = new DataView(cloud.data.buffer, cloud.data.byteOffset, cloud.data.byteLength);
  const values = [];
  for (let row = 0; row < cloud.height; ++row) {
    for (let i = 0; i < cloud.width; ++i) {
      for (const name of ["x", "y", "z", "intensity"]) {
        const field = cloud.fields.find((f) => f.name === name);
        const at = row * cloud.row_step + i * cloud.point_step + field.offset;
        values.push(field.datatype === 8 ? view.getFloat64(at, true) : view.getFloat32(at, true));
      }
    }
  }
  return values;
}

const poseValues = (at, turn) => [at.x, at.y, at.z, turn.x, turn.y, turn.z, turn.w];

function valuesOf(type, message) {
  switch (type) {
    case "sensor_msgs/PointCloud2":
      return pointValues(message);
    case "nav_msgs/Odometry":
      return poseValues(message.pose.pose.position, message.pose.pose.orientation);
    case "geometry_msgs/PoseStamped":
      return poseValues(message.pose.position, message.pose.orientation);
    case "tf2_msgs/TFMessage": {
      const { translation, rotation } = message.transforms[0].transform;
      return poseValues(translation, rotation);
    }
    case "nav_msgs/OccupancyGrid": {
      const { resolution, width, height, origin } = message.info;
      return [resolution, width, height, origin.position.x, origin.position.y, origin.position.z,
        ...message.data];
    }
    case "nav_msgs/Path":
      return message.poses.flatMap(({ pose }) => poseValues(pose.position, pose.orientation));
    case "visualization_msgs/MarkerArray":
      return message.markers
        .filter((marker) => marker.action === 0)
        .flatMap(({ pose: { position: at }, scale: size }) =>
          [at.x, at.y, at.z, size.x, size.y, size.z]);
    case "diagnostic_msgs/DiagnosticArray":
      return message.status.flatMap(({ level, values }) => [
        level, ...values.map(({ key, value }) => Number(key) + Number(value))]);
    default:
      throw new Error(`unexpected type ${type}`);
  }
}

const nanoseconds = (t) => BigInt(t.sec) * 1000000000n + BigInt(t.nsec ?? t.nanosec);

/// The line that write_bags and serve_foxglove print of a message.
function describe(topic, type, recorded, message) {
  const header = (message.transforms?.[0] ?? message.markers?.[0] ?? message).header;
  const values = valuesOf(type, message);
  const frame = header.frame_id;
  const stamp = nanoseconds(header.stamp);
  return `${topic} ${type} ${recorded} ${stamp} ${frame} ${values.length} ${fnv1a(values)}`;
}

module.exports = { describe, nanoseconds };
