// SPDX-License-Identifier: MIT
/// The commands: each function adds one to the program. A command is one file, and one line in
/// main.cpp.
#pragma once

#include "commands/options.hpp"

namespace dynamic_filter::app {

void add_run(Program& program);
void add_plan(Program& program);
void add_merge(Program& program);
void add_diff(Program& program);
void add_live(Program& program);
void add_eval(Program& program);
void add_simulate(Program& program);
void add_convert(Program& program);
void add_report(Program& program);
void add_render(Program& program);
void add_demo(Program& program);
void add_check(Program& program);
void add_odometry(Program& program);
void add_info(Program& program);
void add_config(Program& program);
void add_bench(Program& program);
void add_serve(Program& program);

}  // namespace dynamic_filter::app
