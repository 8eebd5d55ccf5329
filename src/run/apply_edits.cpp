// SPDX-License-Identifier: MIT
#include "run/apply_edits.hpp"

#include <algorithm>
#include <span>
#include <vector>

#include "base/natural_order.hpp"
#include "dynamic_filter/cloud.hpp"
#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/recording.hpp"
#include "dynamic_filter/writers.hpp"
#include "geometry/kept.hpp"
#include "run/edit_lookup.hpp"
#include "run/map_gaps.hpp"
#include "settings/config_file.hpp"

namespace fs = std::filesystem;

namespace dynamic_filter::app {

namespace {

constexpr const char *kStaticFile = "static_map.pcd", *kDynamicFile = "dynamic_points.pcd";
constexpr const char *kKept = "unedited", *kKeeping = ".unedited";

Config config_of(const fs::path& run) { return load_config({.file = run / "config.toml"}); }

/// A second name where the file system has such, or else a copy: files are only ever replaced.
void link_or_copy(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::create_hard_link(from, to, error);
    if (error) fs::copy_file(from, to);
}

/// The folder has its name only once all is in it.
void keep_unedited(const fs::path& run) {
    try {
        fs::remove_all(run / kKeeping);
        fs::create_directory(run / kKeeping);
        for (const auto& entry : fs::directory_iterator(run / "labels")) {
            if (entry.path().extension() != ".label") continue;
            link_or_copy(entry.path(), run / kKeeping / entry.path().filename());
        }
        for (const char* map : {kStaticFile, kDynamicFile}) {
            link_or_copy(run / map, run / kKeeping / map);
        }
        io::sync_folder(run / kKeeping);
        fs::rename(run / kKeeping, run / kKept);
        io::sync_folder(run);
    } catch (const fs::filesystem_error& error) {
        throw OutputError(run / kKept, error.code().message());
    }
}

std::vector<fs::path> label_files(const fs::path& folder) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".label") files.push_back(entry.path());
    }
    io::sort_naturally(files);
    return files;
}

/// A map of the filter, whose records are taken one after the other.
class MapRecords {
public:
    MapRecords(const fs::path& run, const char* name)
        : run_(run), cloud_(io::read_cloud(run / kKept / name)) {
        for (const char* axis : {"x", "y", "z"}) {
            xyz_.push_back(io::values(cloud_, *cloud_.find(axis)));
        }
    }
    struct Record {
        std::span<const std::byte> bytes;
        Eigen::Vector3d world;
    };
    Record next() {
        if (at_ == cloud_.size()) throw misfit();
        const std::size_t i = at_++;
        return {std::span(cloud_.data).subspan(i * cloud_.point_bytes, cloud_.point_bytes),
                {xyz_[0][i], xyz_[1][i], xyz_[2][i]}};
    }
    void expect_end() const {
        if (at_ != cloud_.size()) throw misfit();
    }
    [[nodiscard]] const io::Cloud& cloud() const { return cloud_; }

private:
    [[nodiscard]] InputError misfit() const {
        return {run_, "",
                "labels and maps are not of the same run, so edits cannot be applied; run again "
                "into this folder with --overwrite (its edits.json is kept and applied)"};
    }
    fs::path run_;
    io::Cloud cloud_;
    std::vector<std::vector<double>> xyz_;
    std::size_t at_ = 0;
};

std::vector<bool> is_gap(const std::vector<Gaps>& gaps, std::size_t scan, std::size_t points) {
    std::vector<bool> result(points);
    if (scan >= gaps.size()) return result;
    for (const auto& [first, count] : gaps[scan]) {
        for (std::size_t i = first; i < std::min<std::size_t>(points, std::size_t{first} + count);
             ++i) {
            result[i] = true;
        }
    }
    return result;
}

void append(std::vector<std::byte>& to, std::span<const std::byte> record) {
    to.insert(to.end(), record.begin(), record.end());
}

Applied rewrite(const fs::path& run, const EditLookup& lookup, bool keep_unknown) {
    MapRecords still(run, kStaticFile), dynamic(run, kDynamicFile);
    const std::vector<Gaps> gaps = read_gaps(run);
    const io::Cloud& layout = still.cloud();
    io::PcdWriter new_still(run / kStaticFile, layout.fields, layout.point_bytes),
        new_dynamic(run / kDynamicFile, layout.fields, layout.point_bytes);
    Applied applied;
    std::vector<Labels> edited;
    std::vector<std::byte> records_still, records_dynamic;
    const std::vector<fs::path> files = label_files(run / kKept);
    for (std::uint32_t row = 0; row < files.size(); ++row) {
        Labels labels = io::read_labels(files[row]);
        const std::vector<bool> gap = is_gap(gaps, row, labels.size());
        records_still.clear();
        records_dynamic.clear();
        for (std::size_t i = 0; i < labels.size(); ++i) {
            const Label from = labels[i];
            if (gap[i] || (from == Label::unknown && !keep_unknown)) continue;  // in no map
            const auto record = (from == Label::dynamic ? dynamic : still).next();
            labels[i] = lookup.label_of(record.world, from, row);
            if (labels[i] != from) ++applied.changed;
            const Kept kept = where(labels[i], false, keep_unknown);
            if (kept == Kept::removed) append(records_dynamic, record.bytes);
            if (kept == Kept::in_map) append(records_still, record.bytes);
        }
        applied.points += labels.size();
        new_still.append(records_still);
        new_dynamic.append(records_dynamic);
        edited.push_back(std::move(labels));
    }
    still.expect_end();
    dynamic.expect_end();
    for (std::size_t row = 0; row < files.size(); ++row) {  // not before all is known to fit
        io::write_labels(run / "labels" / files[row].filename(), edited[row],
                         io::Durable::contents);
    }
    io::sync_folder(run / "labels");
    new_still.commit();
    new_dynamic.commit();
    return applied;
}

}  // namespace

void refuse_unless_editable(const fs::path& run) {
    if (!fs::exists(run / "config.toml") || !fs::is_directory(run / "labels")) {
        throw InputError(run, "",
                         "is not the output folder of a run; make one with `dynamicfilter run DATA "
                         "-o DIR`");
    }
    if (!fs::exists(run / kStaticFile) || !fs::exists(run / kDynamicFile)) {
        throw InputError(run, "",
                         "holds no static_map.pcd or no dynamic_points.pcd, which edits change; "
                         "run again with --overwrite and without --no-maps");
    }
    if (config_of(run).map.time == MapTime::latest) {
        throw ConfigError(run.string() +
                          ": edits cannot be applied to maps of map.time=latest; run again with "
                          "--overwrite --set map.time=always");
    }
}

Applied apply_edits(const fs::path& run, const Edits& edits, bool afresh) {
    refuse_unless_editable(run);
    std::error_code ignored;
    if (afresh) fs::remove_all(run / kKept, ignored);
    if (!fs::exists(run / kKept)) keep_unedited(run);
    fs::remove(run / kKept / kEditsFile, ignored);  // until all is done, nothing is applied
    const Applied applied = rewrite(run, EditLookup(edits), config_of(run).map.keep_unknown);
    io::write_file(run / kKept / kEditsFile, text_of(edits));
    return applied;
}

bool is_applied(const fs::path& run, const Edits& edits) {
    const fs::path file = run / kKept / kEditsFile;
    if (!fs::exists(file)) return edits.edits.empty() && !fs::exists(run / kKept);
    return io::read_file(file) == text_of(edits);
}

}  // namespace dynamic_filter::app
