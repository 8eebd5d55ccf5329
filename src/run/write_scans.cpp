// SPDX-License-Identifier: MIT
#include "run/write_scans.hpp"

#include <utility>

#include "dynamic_filter/error.hpp"
#include "dynamic_filter/file.hpp"
#include "dynamic_filter/writers.hpp"
#include "formats/label_files.hpp"
#include "recording/mask.hpp"
#include "recording/recording_parts.hpp"
#include "recording/scans.hpp"
#include "run/map_files.hpp"
#include "run/map_gaps.hpp"

namespace dynamic_filter::app {

WrittenScans write_scans(const io::Recording& recording, const std::vector<std::size_t>& scans,
                         const Config& config, bool with_maps, const std::filesystem::path& folder,
                         const ScanResults& results) {
    const auto labels = folder / "labels";
    std::filesystem::create_directories(labels);
    MapFiles maps(folder, config.map, recording.info().layout == "benchmark");
    if (with_maps && !scans.empty()) {
        try {
            maps.begin(recording.read(scans.front()));
        } catch (const InputError& error) {
            throw changed_in_use(recording, scans.front(), error.what());
        }
    }
    std::vector<Verdict> verdicts(recording.size());
    std::vector<MapFiles::Records> records(recording.size());
    std::vector<Gaps> gaps(recording.size());
    std::vector<io::ScanGist> gists(recording.size());
    io::Continuity continuity(recording.parts().sensors);
    std::vector<io::ScanWatch> watch(recording.size());
    std::vector<io::DynamicBeside> beside(recording.size());
    WrittenScans written;
    std::vector<Gaps> gaps_of_scans;
    const auto decide = [&](std::size_t i, MaybeScan& maybe) {
        const io::FullScan& scan = *maybe.scan;
        verdicts[i] = results.decide(i, scan);
        io::label_own_body(scan.own, verdicts[i].labels);
        const Labels& final = verdicts[i].labels;
        if (results.look) results.look(i, scan, final);
        watch[i] = io::watch_scan(i, scan.points, scan.T_world_sensor, final);
        gists[i] = io::gist_of(scan.points, scan.T_world_sensor);
        beside[i] = io::dynamic_beside(scan.points, scan.T_world_sensor, final);
        io::write_labels(io::label_file(labels, io::stem(recording, i)), verdicts[i].labels,
                         io::Durable::contents);
        if (with_maps) {
            records[i] = maps.records_of(scan, verdicts[i]);
            gaps[i] = gaps_of(scan.points);
        }
    };
    const auto use = [&](std::size_t i, MaybeScan& maybe) {
        if (!maybe.scan) throw changed_in_use(recording, i, maybe.error);
        continuity.add(i, std::exchange(gists[i], {}));
        written.watch.push_back(watch[i]);
        written.beside.push_back(beside[i]);
        gaps_of_scans.push_back(std::move(gaps[i]));
        if (with_maps) maps.append(std::exchange(records[i], {}));
        results.use(i, *maybe.scan, std::exchange(verdicts[i], {}));
        return true;  // what is filtered is written even after an interruption; a second one kills
    };
    for_each_scan(recording, scans, decide, use);
    io::sync_folder(labels);
    maps.commit();
    write_gaps(folder, gaps_of_scans);
    written.breaks = continuity.breaks();
    return written;
}

}  // namespace dynamic_filter::app
