// SPDX-License-Identifier: MIT
#include "run/tile_file.hpp"

#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "base/checked_file.hpp"
#include "base/crc.hpp"
#include "dynamic_filter/error.hpp"
#include "geometry/verdict_code.hpp"

namespace dynamic_filter::app {

namespace {

using Json = nlohmann::ordered_json;

// The file: the first line, packed blocks, the index as JSON, and the last line, which says where
// the index lies. Both lines end with a line feed.
constexpr const char* kTileMagic = "dynamicfilter-tile-1";
constexpr std::size_t kLastLine = 64;  // bytes

/// Bits 0-1: final, 2-3: instant, 4: stays.
std::byte code_of(const PointVerdict& verdict) {
    const int code = verdict_code(verdict.final) | verdict_code(verdict.instant) << 2 |
                     (verdict.stays ? 1 : 0) << 4;
    return static_cast<std::byte>(code);
}

PointVerdict verdict_of(std::byte byte) {
    const auto code = std::to_integer<unsigned>(byte);
    return {.final = label_of_code(code),
            .instant = label_of_code(code >> 2),
            .stays = (code >> 4 & 1U) != 0};
}

Json json_of(const eval::ScoreSums& sums) {
    Json voxel = Json::object();
    for (const auto& [reading, t] : sums.voxel) {
        voxel[reading] = {t.static_total, t.static_kept, t.dynamic_total, t.dynamic_kept};
    }
    const auto& c = sums.cover;
    const auto& f = sums.confusion;
    return {{"voxel", voxel},
            {"cover", {c.still, c.dynamic, c.covered_still, c.covered_dynamic}},
            {"confusion", {f.true_positive, f.false_positive, f.false_negative}},
            {"voxels", {sums.voxels, sums.dynamic_voxels}}};
}

eval::ScoreSums sums_of(const Json& json) {
    eval::ScoreSums sums;
    for (const auto& [reading, t] : json.at("voxel").items()) {
        sums.voxel[reading] = {.static_total = t.at(0),
                               .static_kept = t.at(1),
                               .dynamic_total = t.at(2),
                               .dynamic_kept = t.at(3)};
    }
    const Json &c = json.at("cover"), &f = json.at("confusion");
    sums.cover = {
        .still = c.at(0), .dynamic = c.at(1), .covered_still = c.at(2), .covered_dynamic = c.at(3)};
    sums.confusion = {
        .true_positive = f.at(0), .false_positive = f.at(1), .false_negative = f.at(2)};
    sums.voxels = json.at("voxels").at(0);
    sums.dynamic_voxels = json.at("voxels").at(1);
    return sums;
}

Json json_of(const TileSummary& s) {
    Json drives = Json::array();
    for (const DriveCounts& drive : s.drives) {
        drives.push_back({{"drive", drive.drive},
                          {"final", json_of(drive.final)},
                          {"instant", json_of(drive.instant)}});
    }
    return {{"level", s.tile.level},
            {"x", s.tile.x},
            {"y", s.tile.y},
            {"whole", s.tile.is_whole},
            {"voxels", s.voxels},
            {"static", s.still},
            {"keyframes", s.keyframes},
            {"low", {s.low.x(), s.low.y(), s.low.z()}},
            {"high", {s.high.x(), s.high.y(), s.high.z()}},
            {"map", s.map_mark},
            {"scores", drives}};
}

TileSummary summary_of(const Json& json) {
    const auto vector = [](const Json& v) { return Eigen::Vector3d(v.at(0), v.at(1), v.at(2)); };
    TileSummary s{.tile = {.level = json.at("level"),
                           .x = json.at("x"),
                           .y = json.at("y"),
                           .is_whole = json.at("whole")},
                  .voxels = json.at("voxels"),
                  .still = json.at("static"),
                  .keyframes = json.at("keyframes"),
                  .low = vector(json.at("low")),
                  .high = vector(json.at("high")),
                  .drives = {},
                  .map_mark = json.at("map")};
    for (const Json& drive : json.at("scores")) {
        s.drives.push_back({.drive = drive.at("drive"),
                            .final = sums_of(drive.at("final")),
                            .instant = sums_of(drive.at("instant"))});
    }
    return s;
}

[[noreturn]] void refuse_damaged_tile(const std::filesystem::path& file) {
    throw InputError(file, "", "is damaged; remove it, and start again with --resume");
}

std::string read_at(const std::filesystem::path& file, std::uint64_t offset, std::size_t size) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError(file, "", "cannot be read");
    std::string bytes(size, '\0');
    in.seekg(static_cast<std::streamoff>(offset));
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (static_cast<std::size_t>(in.gcount()) != size) refuse_damaged_tile(file);
    return bytes;
}

std::string first_line(const std::string& run) {
    return std::string(kTileMagic) + " " + fingerprint(run) + "\n";
}

std::string last_line(std::uint64_t offset, std::string_view index) {
    const std::uint32_t crc = crc_of(std::as_bytes(std::span(index)));
    return fmt::format("{:<{}}\n", fmt::format("index {} {} {:08x}", offset, index.size(), crc),
                       kLastLine - 1);
}

/// The index of a file whose first and last line are right.
Json read_index(const std::filesystem::path& file, const std::string& run) {
    const std::string first = first_line(run);
    const std::uint64_t size = std::filesystem::file_size(file);
    if (size < first.size() + kLastLine) refuse_damaged_tile(file);
    const std::string begin = read_at(file, 0, first.size());
    if (!begin.starts_with(std::string(kTileMagic) + " ")) {
        throw InputError(file, "line 1", fmt::format("expected \"{} ...\"", kTileMagic));
    }
    if (begin != first) {
        throw ConfigError(file.string() +
                          ": belongs to a run of other recordings, settings or another version");
    }
    const std::string end = read_at(file, size - kLastLine, kLastLine);
    unsigned long long offset = 0, bytes = 0;
    if (std::sscanf(end.c_str(), "index %llu %llu", &offset, &bytes) != 2 ||
        offset + bytes + kLastLine != size) {
        refuse_damaged_tile(file);
    }
    const std::string index = read_at(file, offset, bytes);
    if (last_line(offset, index) != end) refuse_damaged_tile(file);
    return Json::parse(index);
}

}  // namespace

TileWriter::TileWriter(const std::filesystem::path& file, const std::string& run) : file_(file) {
    const std::string first = first_line(run);
    file_.write(first);
    end_ = first.size();
}

void TileWriter::add(const ScanOfDrive& scan, const PointVerdicts& verdicts) {
    std::vector<std::byte> codes(verdicts.size());
    for (std::size_t i = 0; i < codes.size(); ++i) codes[i] = code_of(verdicts[i]);
    const std::vector<std::byte> bytes = packed(codes);
    blocks_.push_back({.scan = scan,
                       .points = static_cast<std::uint32_t>(codes.size()),
                       .bytes = static_cast<std::uint32_t>(bytes.size()),
                       .crc = crc_of(bytes),
                       .offset = end_});
    file_.write(bytes);
    end_ += bytes.size();
}

void TileWriter::commit(const TileSummary& summary) {
    Json json = json_of(summary);
    Json& scans = json["scans"] = Json::array();
    for (const Block& b : blocks_) {
        scans.push_back({b.scan.drive, b.scan.scan, b.points, b.offset, b.bytes, b.crc});
    }
    const std::string index = json.dump() + "\n";
    file_.write(index);
    file_.write(last_line(end_, index));
    file_.commit();
}

TileReader::TileReader(std::filesystem::path file, const std::string& run)
    : path_(std::move(file)) {
    const Json json = read_index(path_, run);
    summary_ = summary_of(json);
    for (const Json& b : json.at("scans")) {
        blocks_[{b.at(0), b.at(1)}] = {
            .offset = b.at(3), .points = b.at(2), .bytes = b.at(4), .crc = b.at(5)};
    }
}

std::string TileReader::packed_bytes_of(const Block& block) const {
    std::string bytes = read_at(path_, block.offset, block.bytes);
    if (crc_of(std::as_bytes(std::span(bytes))) != block.crc) refuse_damaged_tile(path_);
    return bytes;
}

PointVerdicts TileReader::read(const ScanOfDrive& scan) const {
    const auto block = blocks_.find(scan);
    if (block == blocks_.end()) return {};
    const std::string bytes = packed_bytes_of(block->second);
    PointVerdicts verdicts;
    for (const std::byte code :
         unpacked(std::as_bytes(std::span(bytes)), block->second.points, path_)) {
        verdicts.push_back(verdict_of(code));
    }
    return verdicts;
}

void TileReader::check_all() const {
    for (const auto& [scan, block] : blocks_) (void)packed_bytes_of(block);
    if (summary_.map_mark.empty()) return;
    const std::filesystem::path map = path_.parent_path() / tile_map_file(summary_.tile);
    if (file_mark_of(map) != summary_.map_mark) refuse_damaged_tile(map);
}

std::string file_mark_of(const std::filesystem::path& file) {
    const std::string bytes = io::read_file(file);
    return fmt::format("{} {:08x}", bytes.size(), crc_of(std::as_bytes(std::span(bytes))));
}

bool is_done(const std::filesystem::path& file, const std::string& run) {
    if (!std::filesystem::exists(file)) return false;
    try {
        TileReader(file, run).check_all();
        return true;
    } catch (const InputError&) {
        return false;
    }
}

}  // namespace dynamic_filter::app
