// SPDX-License-Identifier: MIT
/// The plan as a file, so that only one of many processes has to read all scans to make it.
#include <cstring>
#include <nlohmann/json.hpp>

#include "base/checked_file.hpp"
#include "run/plan.hpp"

namespace dynamic_filter::app {

namespace {

using PlanJson = nlohmann::json;
constexpr const char* kPlanMagic = "dynamicfilter-plan-2";

/// Numbers as they are in memory, which is far smaller than an array of numbers.
template <class T>
PlanJson blob(const std::vector<T>& values) {
    const auto* const first = reinterpret_cast<const std::uint8_t*>(values.data());
    return PlanJson::binary({first, first + values.size() * sizeof(T)});
}

template <class T>
std::vector<T> from_blob(const PlanJson& json) {
    const auto& bytes = json.get_binary();
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(T));
    return values;
}

PlanJson json_of(const Remarks& remarks) {
    PlanJson json = PlanJson::array();
    for (const Remark& remark : remarks) json.push_back({name_of(remark.kind), remark.text});
    return json;
}

Remarks remarks_of(const PlanJson& json) {
    Remarks remarks;
    for (const PlanJson& one : json) {
        remarks.push_back({remark_kind_of(one.at(0).get<std::string>()), one.at(1)});
    }
    return remarks;
}

PlanJson json_of(const PlannedDrive& drive) {
    std::vector<std::uint8_t> used;
    std::vector<std::uint32_t> stretches, counts, counts_around;
    std::vector<double> positions;
    std::vector<PlaneCell> cells, around;
    for (const PlannedScan& scan : drive.scans) {
        used.push_back(scan.is_used ? 1 : 0);
        stretches.push_back(scan.stretch);
        for (const double x : scan.position) positions.push_back(x);
        counts.push_back(static_cast<std::uint32_t>(scan.cells.size()));
        counts_around.push_back(static_cast<std::uint32_t>(scan.around.size()));
        cells.insert(cells.end(), scan.cells.begin(), scan.cells.end());
        around.insert(around.end(), scan.around.begin(), scan.around.end());
    }
    PlanJson json{{"used", blob(used)},           {"parts", blob(stretches)},
                  {"positions", blob(positions)}, {"counts", blob(counts)},
                  {"cells", blob(cells)},         {"counts_around", blob(counts_around)},
                  {"around", blob(around)},       {"remarks", json_of(drive.remarks)},
                  {"deskew", drive.deskew},       {"most_points", drive.most_points}};
    const auto& at = drive.sensor_at;
    json["sensor_at"] = {at.x(), at.y(), at.z()};
    std::vector<float> corners;
    for (const Eigen::AlignedBox3f& box : drive.own_body) {
        for (const Point& corner : {box.min(), box.max()}) {
            corners.insert(corners.end(), corner.begin(), corner.end());
        }
    }
    json["own_body"] = blob(corners);
    if (drive.sweep) {
        json["sweep"] = {drive.sweep->clockwise, drive.sweep->seam, drive.sweep->duration,
                         drive.sweep->in_order, drive.sweep->shift};
    }
    return json;
}

PlannedDrive drive_of(const PlanJson& json) {
    PlannedDrive drive{.scans = {},
                       .remarks = remarks_of(json.at("remarks")),
                       .most_points = json.at("most_points"),
                       .deskew = json.at("deskew"),
                       .sweep = {}};
    const PlanJson& at = json.at("sensor_at");
    drive.sensor_at =
        Eigen::Vector3d(at.at(0).get<double>(), at.at(1).get<double>(), at.at(2).get<double>());
    const auto corners = from_blob<float>(json.at("own_body"));
    for (std::size_t i = 0; i + 6 <= corners.size(); i += 6) {
        drive.own_body.emplace_back(Point(&corners[i]), Point(&corners[i + 3]));
    }
    if (json.contains("sweep")) {
        const PlanJson& sweep = json["sweep"];
        drive.sweep = Sweep{.clockwise = sweep[0],
                            .seam = sweep[1],
                            .duration = sweep[2],
                            .in_order = sweep.at(3),
                            .shift = sweep.at(4)};
    }
    const auto used = from_blob<std::uint8_t>(json.at("used"));
    const auto stretches = from_blob<std::uint32_t>(json.at("parts"));
    const auto counts = from_blob<std::uint32_t>(json.at("counts"));
    const auto positions = from_blob<double>(json.at("positions"));
    const auto counts_around = from_blob<std::uint32_t>(json.at("counts_around"));
    const auto cells = from_blob<PlaneCell>(json.at("cells"));
    const auto around = from_blob<PlaneCell>(json.at("around"));
    auto next = cells.begin(), next_around = around.begin();
    for (std::size_t i = 0; i < used.size(); ++i) {
        const auto end = next + counts[i], end_around = next_around + counts_around[i];
        drive.scans.push_back({.is_used = used[i] != 0,
                               .stretch = stretches[i],
                               .position = Eigen::Vector3d(&positions[3 * i]),
                               .cells = {next, end},
                               .around = {next_around, end_around}});
        next = end;
        next_around = end_around;
    }
    return drive;
}

}  // namespace

void write_plan(const std::filesystem::path& file, const Plan& plan, const std::string& run) {
    PlanJson json{{"cell", plan.cell},
                  {"most_voxels", plan.most_voxels},
                  {"remarks", json_of(plan.remarks)},
                  {"drives", PlanJson::array()}};
    for (const PlannedDrive& drive : plan.drives) json["drives"].push_back(json_of(drive));
    std::vector<PlaneCell> cells;
    std::vector<std::uint64_t> counts;
    for (const auto& [cell, count] : plan.voxels) {
        cells.push_back(cell);
        counts.push_back(count);
    }
    json["cells"] = blob(cells);
    json["voxels"] = blob(counts);
    json["sampled"] = blob(plan.sampled);
    const std::vector<std::uint8_t> bytes = PlanJson::to_cbor(json);
    write_checked(file, kPlanMagic, fingerprint(run), std::as_bytes(std::span(bytes)));
}

Plan read_plan(const std::filesystem::path& file, const std::string& run, const Config& config) {
    const std::vector<std::byte> bytes = read_checked(file, kPlanMagic, fingerprint(run));
    const auto* const first = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const PlanJson json = PlanJson::from_cbor(first, first + bytes.size());
    Plan plan{.cell = json.at("cell"),
              .drives = {},
              .remarks = remarks_of(json.at("remarks")),
              .voxels = {},
              .sampled = from_blob<std::uint64_t>(json.at("sampled")),
              .most_voxels = json.at("most_voxels"),
              .tiles = {}};
    for (const PlanJson& drive : json.at("drives")) plan.drives.push_back(drive_of(drive));
    const auto cells = from_blob<PlaneCell>(json.at("cells"));
    const auto counts = from_blob<std::uint64_t>(json.at("voxels"));
    for (std::size_t i = 0; i < cells.size(); ++i) plan.voxels[cells[i]] = counts[i];
    cut_into_tiles(plan, config);
    return plan;
}

}  // namespace dynamic_filter::app
