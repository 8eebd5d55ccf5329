// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <cerrno>  // program_invocation_name, of glibc: the command as it was typed

#include "base/exit_code.hpp"
#include "base/progress.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/picture.hpp"
#include "commands/render.hpp"
#include "commands/shared_options.hpp"
#include "commands/write_simulation.hpp"
#include "export/outputs.hpp"
#include "run/run.hpp"
#include "score/report.hpp"

namespace dynamic_filter::app {

namespace {

struct DemoOptions {
    std::filesystem::path output = "demo";
};

constexpr int kPedestrians = 100;

/// Its recording and its result are folders with files of their own.
const FolderFiles kDemoFiles{.files = {"before.png", "after.png"}, .is_of_use_in_part = true};

void print_row(const char* method, double pr, double rr, double f1) {
    say("  {:<34} {:>7.2f} {:>7.2f} {:>6.3f}\n", method, pr, rr, f1);
}

/// Table II of the paper for 100 pedestrians, and this run.
void print_table(const eval::VoxelScore& ours) {
    say("\nCrowd of {} pedestrians, VLP-16, two rounds; voxels of 0.2 m\n", kPedestrians);
    say("  {:<34} {:>7} {:>7} {:>6}\n", "", "PR [%]", "RR [%]", "F1");
    print_row("Removert      (paper, its scene)", 66.48, 57.96, 0.619);
    print_row("ERASOR        (paper, its scene)", 69.16, 71.87, 0.705);
    print_row("DynamicFilter (paper, its scene)", 95.32, 94.26, 0.948);
    say("  {:<34} {:>7} {:>7} {:>6}\n", "this run      (our scene)", percent(ours.pr),
        percent(ours.rr), three_digits(ours.f1));
}

}  // namespace

int demo(const DemoOptions& o) {
    // The folder of an earlier demo is reused; any other that holds something is refused.
    const auto recording = o.output / "recording";
    // So is that of a demo that was interrupted.
    const bool again = std::filesystem::exists(recording / "poses.txt") &&
                       (std::filesystem::exists(o.output / "before.png") ||
                        std::filesystem::exists(o.output / "result" / kRunState));
    OutputFolder output(o.output, kDemoFiles, replaced_if(again));
    OutputFolder recorded(recording, recording_files(), replaced_if(again));
    RunOptions run_options;
    run_options.data.data = recording;
    run_options.data.format = "kitti";
    run_options.output = o.output / "result";
    run_options.overwrite = again;
    run_options.after = "simulate";
    run_options.catches = false;  // Ctrl-C ends the demo: there is little to go on with
    sim::SimulationOptions scene;
    scene.pedestrians = kPedestrians;
    write_simulation(scene, recorded.path());
    recorded.commit();

    const RunResult result = run(run_options);
    if (result.recordings.empty()) return result.exit_code;  // interrupted
    // Seen from where the whole hall is in view.
    RenderOptions picture;
    picture.data.data = o.output / "result";
    picture.width = 1600;
    picture.height = 560;
    picture.azimuth_deg = 85.0;
    picture.elevation_deg = 40.0;
    io::write_png(output.path() / "before.png", picture_of(picture));
    picture.clean = true;
    io::write_png(output.path() / "after.png", picture_of(picture));
    output.commit();

    print_table(result.recordings.front().scores->voxel.at("excluded"));
    say("\npictures {0}/before.png (removed points in red) and {0}/after.png\n"
        "report   {0}/result/report.html (open it in a browser)\n"
        "maps     {0}/result/static_map.pcd and dynamic_points.pcd\n"
        "\nYour own recording, a bag or a folder with scans:\n"
        "  {1} check YOUR_RECORDING\n"
        "  {1} run YOUR_RECORDING -o out\n",
        o.output.string(), program_invocation_name);
    return kDone;
}

void add_demo(Program& program) {
    Command c = program.command(
        "demo", "Simulate a crowd, remove it, score and draw the result; needs no data");
    const auto o = std::make_shared<DemoOptions>();
    c.path("-o,--output", o->output, "output folder");
    c.action([o] { return demo(*o); });
}

}  // namespace dynamic_filter::app
