// SPDX-License-Identifier: MIT
/// The subcommands as Python functions, with the same code as the command. Results are JSON texts
/// here.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <array>
#include <csignal>
#include <nlohmann/json.hpp>

#include "base/exit_code.hpp"
#include "base/output_folder.hpp"
#include "base/progress.hpp"
#include "commands/convert.hpp"
#include "commands/evaluate.hpp"
#include "commands/write_simulation.hpp"
#include "dynamic_filter/check.hpp"
#include "dynamic_filter/file.hpp"
#include "export/outputs.hpp"
#include "export/part.hpp"
#include "geometry/pose.hpp"
#include "python/src/module.hpp"
#include "recording/scans.hpp"
#include "run/run.hpp"
#include "score/report.hpp"
#include "upkeep/diff.hpp"

namespace dynamic_filter::python {

namespace py = pybind11;

namespace {

namespace fs = std::filesystem;

/// An interrupt ends the command, but not Python; so the handlers of Python are restored
/// afterwards.
class Interruptible {
public:
    Interruptible() {
        for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], nullptr, &old_[i]);
        app::catch_interrupts(false);  // so that a second interrupt does not end the interpreter
    }
    Interruptible(const Interruptible&) = delete;
    Interruptible& operator=(const Interruptible&) = delete;
    ~Interruptible() {
        for (std::size_t i = 0; i < kSignals.size(); ++i) sigaction(kSignals[i], &old_[i], nullptr);
    }

private:
    static constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP, SIGPIPE};
    std::array<struct sigaction, kSignals.size()> old_{};
};

void raise_if(bool interrupted) {
    if (!interrupted) return;
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
}

app::RunOptions run_options(const fs::path& data, const std::optional<fs::path>& output,
                            py::dict& options) {
    app::RunOptions o;
    o.output = output ? *output : app::default_output();
    o.config = config_options(options.attr("pop")("config", py::none()));
    pop_option(options, "threads", o.threads);
    pop_switch(options, "refine", o.refine);
    pop_option(options, "overwrite", o.overwrite);
    pop_option(options, "resume", o.resume);
    o.catches = false;
    o.quiet = true;
    pop_option(options, "quiet", o.quiet);
    std::optional<double> online;
    pop_option(options, "online", online);
    refuse_threads(o.threads);
    if (!(online.value_or(0.0) >= 0.0)) {
        throw py::value_error("online: expected a multiple of the sensor's rate, 0 or more");
    }
    o.recordings = {data};
    pop_option(options, "update", o.update);
    pop_option(options, "keep_evidence", o.keeps_evidence);
    o.online = online.has_value();
    o.speed = online.value_or(0.0);
    o.data = data_options(data, options);
    refuse_unknown("run", options);
    return o;
}

py::tuple run(const fs::path& data, const std::optional<fs::path>& output, py::dict options) {
    const app::RunOptions o = run_options(data, output, options);
    int code = 0;
    std::string metrics, timing;
    {
        const py::gil_scoped_release others_go_on;
        const Interruptible guard;
        code = app::run(o).exit_code;
        if (code != app::kInterrupted) {
            if (!output) app::link_latest(*o.output);
            metrics = io::read_file(*o.output / "metrics.json");
            timing = io::read_file(*o.output / "timing.json");
        }
    }
    raise_if(code == app::kInterrupted);
    return py::make_tuple(*o.output, metrics, timing);
}

std::string evaluate(const fs::path& truth, const std::optional<fs::path>& labels,
                     const std::optional<fs::path>& map, double voxel, double min_range,
                     double max_range, const std::string& box, py::dict options) {
    if (labels.has_value() == map.has_value()) {
        throw py::type_error("evaluate() takes either labels or map");
    }
    if (!(voxel >= 0.01 && voxel <= 10.0)) throw py::value_error("voxel: expected 0.01 to 10 m");
    if (!(min_range >= 0.0 && max_range > min_range)) {
        throw py::value_error("min_range: expected 0 m or more, and less than max_range");
    }
    const app::EvalOptions o{.truth = data_options(truth, options),
                             .labels = labels,
                             .map = map,
                             .json = std::nullopt,
                             .voxel = voxel,
                             .part = {min_range, max_range, app::box_of(box)}};
    refuse_unknown("evaluate", options);
    const py::gil_scoped_release others_go_on;
    const app::Evaluation e = app::scores_of(o);
    nlohmann::ordered_json json = app::to_json(e);
    json["scans"] = e.to_score - e.left_out.size();
    json["left_out"] = e.left_out.size();
    json["without_truth"] = e.scans - e.to_score;
    return app::text_of(json);
}

void convert(const fs::path& data, const fs::path& output, py::dict options) {
    app::ConvertOptions o;
    o.output = output;
    o.quiet = true;
    pop_option(options, "labels", o.labels);
    pop_option(options, "to", o.to);
    pop_option(options, "origin", o.origin);
    pop_option(options, "crs", o.crs);
    pop_option(options, "box", o.box);
    pop_option(options, "only", o.only);
    pop_option(options, "storey", o.storey);
    pop_option(options, "normals", o.normals);
    pop_option(options, "ground", o.ground);
    pop_option(options, "moving_class", o.moving_class);
    if (o.moving_class && (*o.moving_class < 3 || *o.moving_class > 255)) {
        throw py::value_error("moving_class: expected 3 to 255");
    }
    pop_option(options, "overwrite", o.overwrite);
    pop_option(options, "quiet", o.quiet);
    app::visit_numbers(o, [&](const app::NumberOption& option, double& value) {
        if (!options.contains(option.name)) return;
        pop_option(options, option.name, value);
        if (value >= option.low && value <= option.high) return;
        throw py::value_error(
            fmt::format("{}: expected {} to {}", option.name, option.low, option.high));
    });
    if (!o.only.empty() && o.only != "static" && o.only != "dynamic") {
        throw ConfigError("only: '" + o.only + "' is none of static, dynamic");
    }
    o.data = data_options(data, options);
    refuse_unknown("convert", options);
    int code = 0;
    {
        const py::gil_scoped_release others_go_on;
        const Interruptible guard;
        code = app::convert(o);
    }
    raise_if(code == app::kInterrupted);
}

void diff(const fs::path& old_run, const fs::path& new_run, const fs::path& output, int threads,
          const std::string& memory, bool overwrite, bool quiet) {
    const app::DiffOptions o{.old_run = old_run,
                             .new_run = new_run,
                             .output = output,
                             .threads = threads,
                             .memory = memory,
                             .overwrite = overwrite,
                             .quiet = quiet};
    int code = 0;
    {
        const py::gil_scoped_release others_go_on;
        const Interruptible guard;
        code = app::diff(o);
    }
    raise_if(code == app::kInterrupted);
}

std::string check(const fs::path& data, py::dict options) {
    const app::DataOptions o = data_options(data, options);
    refuse_unknown("check", options);
    const py::gil_scoped_release others_go_on;
    const io::Recording recording = app::open(o);
    const io::Preflight preflight = io::check_recording(recording, io::Depth::thorough);
    nlohmann::ordered_json json{{"findings", nlohmann::json::array()},
                                {"notes", preflight.notes},
                                {"overlays", nlohmann::json::object()},
                                {"unusable", preflight.unusable},
                                {"lost", recording.info().losses}};
    for (const io::Finding& finding : preflight.findings) {
        json["findings"].push_back({{"what", finding.what}, {"advice", finding.advice}});
    }
    for (const io::Overlay& overlay : preflight.overlays) {
        json["overlays"][overlay.reading] = overlay.share;
    }
    return app::text_of(json);
}

std::size_t simulate(const sim::SimulationOptions& options, const fs::path& folder, bool knowable,
                     bool overwrite, bool quiet) {
    std::size_t points = 0;
    bool stopped = false;
    {
        const py::gil_scoped_release others_go_on;
        const Interruptible guard;
        for (const auto& recording : app::simulated_recordings(options, folder)) {
            app::OutputFolder output(recording.folder, app::recording_files(),
                                     app::replaced_if(overwrite));
            points += app::write_simulation(recording.options, output.path(), quiet, knowable);
            stopped = app::interrupted();
            if (stopped) break;
            output.commit();
        }
    }
    raise_if(stopped);
    return points;
}

}  // namespace

void bind_programs(py::module_& module) {
    module.def("run", &run);
    module.def("evaluate", &evaluate);
    module.def("check", &check);
    module.def("diff", &diff);
    module.def("convert", &convert);
    module.def(
        "simulate",
        [](const std::string& scene, const fs::path& output, const std::string& sensor,
           int pedestrians, std::uint64_t seed, std::optional<std::size_t> frames, double rate,
           double pose_noise, double pose_noise_deg, bool sweep, int rounds, double km, int drives,
           const std::optional<std::array<double, 6>>& mount, double delay, bool knowable,
           bool overwrite, bool quiet) {
            sim::SimulationOptions options{scene,  sensor, pedestrians, seed,
                                           frames, rate,   pose_noise,  pose_noise_deg,
                                           sweep,  rounds, km,          drives};
            if (mount)
                options.mount =
                    placed(Eigen::Vector3d(mount->data()), Eigen::Vector3d(&(*mount)[3]));
            options.delay = delay;
            return simulate(options, output, knowable, overwrite, quiet);
        },
        py::arg("scene"), py::arg("output"), py::kw_only(), py::arg("sensor") = "vlp16",
        py::arg("pedestrians") = -1, py::arg("seed") = 1, py::arg("frames") = py::none(),
        py::arg("rate") = 0.0, py::arg("pose_noise") = 0.0, py::arg("pose_noise_deg") = 0.0,
        py::arg("sweep") = false, py::arg("rounds") = 0, py::arg("km") = 0.0, py::arg("drives") = 0,
        py::arg("mount") = py::none(), py::arg("delay") = 0.0, py::arg("knowable") = false,
        py::arg("overwrite") = false, py::arg("quiet") = true,
        R"(Simulates a recording with exact labels, and writes it in KITTI's layout to the folder `output`.

scene: crowd, street, square, hall, jam, queue, platform, slow, mirrors or city. The drives of a city become recordings in
`output`: drive_1 and so on.
sensor: see `dynamicfilter simulate --help`.
pedestrians: number of people; -1: the default of the scene.
seed: the same seed gives the same bytes.
frames: number of scans; None: the whole scene.
rate: scans per second; 0: the default of the scene.
pose_noise [m], pose_noise_deg [deg]: standard deviation of each axis.
sweep: True measures points one after the other while the sensor moves, like a rotating sensor; scans
are then PCD files with a field t [s].
rounds: rounds of the robot in the scene crowd; 0: the default.
km: length [km] of each drive in the scene city; drives: their number; 0: the defaults.
mount: (x, y, z, roll, pitch, yaw) [m, deg] of this sensor in the frame of the scene's own one: another sensor on the
same vehicle. delay: stamp of the first scan [s], so that sensors take turns.
knowable: True also writes what could be known of each point; evaluate() reads it.
overwrite: True replaces an earlier recording. quiet: False shows the progress on stderr.
Returns the number of points. Raises ConfigError (also if there is an earlier recording), OutputError,
and KeyboardInterrupt, after which no files are left but those of finished drives.)");
}

}  // namespace dynamic_filter::python
