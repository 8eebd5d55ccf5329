// SPDX-License-Identifier: MIT
#include "run/evidence_file.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "base/checked_file.hpp"
#include "dynamic_filter/error.hpp"
#include "filter/archive.hpp"

namespace dynamic_filter::app {

namespace {

constexpr const char* kEvidenceMagic = "dynamicfilter-evidence-1";

/// Without the scores, which are those of the drives that a run labels.
void archive(Archive& archive, TileSummary& summary) {
    archive.value(summary.voxels);
    archive.value(summary.still);
    archive.value(summary.keyframes);
    archive.value(summary.low);
    archive.value(summary.high);
    std::vector<char> mark(summary.map_mark.begin(), summary.map_mark.end());
    archive.values(mark);
    summary.map_mark.assign(mark.begin(), mark.end());
}

void archive(Archive& archive, TileEvidence& evidence) {
    archive.values(evidence.filter);
    bool has_seen = evidence.seen.has_value();
    archive.value(has_seen);
    if (has_seen && archive.reads()) evidence.seen.emplace(1);
    if (has_seen) evidence.seen->archive(archive);
    app::archive(archive, evidence.of_filter);
    app::archive(archive, evidence.of_all);
}

}  // namespace

std::string evidence_mark(const Job& job, const TileWork& work, std::size_t drives) {
    std::set<std::size_t> reaching{0};  // the first drive also says how high the filter's frame is
    for (const ScanOfDrive& scan : work.scans) reaching.insert(scan.drive);
    std::string mark =
        job.begun.tiles + fmt::format("tile {}\n", name_of(work.tile)) + job.begun.reading;
    for (const std::size_t d : reaching) {
        if (d < drives) {
            mark += fmt::format("drive {}\n", d) + job.begun.states[d] + job.begun.poses[d];
        }
    }
    return mark;
}

void write_evidence(const std::filesystem::path& file, TileEvidence evidence,
                    const std::string& mark) {
    Archive writer;
    archive(writer, evidence);
    const std::vector<std::byte> bytes = writer.take();
    Archive sized;
    std::uint64_t size = bytes.size();
    std::vector<std::byte> small = packed(bytes);
    sized.value(size);
    sized.values(small);
    write_checked(file, kEvidenceMagic, fingerprint(mark), sized.take());
}

std::optional<TileEvidence> read_evidence(const std::filesystem::path& file,
                                          const std::string& mark) {
    if (!std::filesystem::exists(file)) return std::nullopt;
    try {
        const std::vector<std::byte> whole = read_checked(file, kEvidenceMagic, fingerprint(mark));
        Archive sized(whole);
        std::uint64_t size = 0;
        std::vector<std::byte> small;
        sized.value(size);
        sized.values(small);
        const std::vector<std::byte> bytes = unpacked(small, size, file);
        Archive reader(bytes);
        TileEvidence evidence;
        archive(reader, evidence);
        return evidence;
    } catch (const Error&) {
        return std::nullopt;
    }
}

}  // namespace dynamic_filter::app
