// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "base/exit_code.hpp"
#include "base/say.hpp"
#include "commands/all.hpp"
#include "commands/shared_options.hpp"
#include "settings/config_file.hpp"

namespace dynamic_filter::app {

void add_config(Program& program) {
    Command c = program.command("config", "Print all settings as TOML or JSON");
    const auto o = std::make_shared<ConfigOptions>();
    const auto json = std::make_shared<bool>(false);
    add_config_options(c, *o);
    c.flag("--json", *json, "print JSON, with the bounds of each setting");
    c.action([o, json] {
        const Config config = load_config(*o);
        say("{}", *json ? to_json(config) : to_toml(config));
        return kDone;
    });
}

}  // namespace dynamic_filter::app
