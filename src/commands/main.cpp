// SPDX-License-Identifier: MIT
#include <csignal>

#include "commands/all.hpp"
#include "commands/failure.hpp"
#include "commands/freed_memory.hpp"

int main(int argc, char** argv) {
    using namespace dynamic_filter::app;
    keep_freed_memory();
    std::signal(SIGXFSZ, SIG_IGN);  // a file that may not grow is an error like a full disk
    std::signal(SIGUSR1, SIG_IGN);  // means a map to `live --map` alone, and may reach all of us
    return guarded("dynamicfilter", [&] {
        Program program("dynamicfilter", "Removes moving objects from LiDAR scans and maps.");
        for (const auto add :
             {add_run, add_plan, add_merge, add_diff, add_live, add_eval, add_bench, add_simulate,
              add_convert, add_report, add_serve, add_render, add_demo, add_check, add_odometry,
              add_info, add_config}) {
            add(program);
        }
        return program.run({argv, static_cast<std::size_t>(argc)});
    });
}
