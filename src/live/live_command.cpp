// SPDX-License-Identifier: MIT
#include "live/live_command.hpp"

#include "live/dds_bus.hpp"
#include "live/live_config.hpp"

namespace dynamic_filter::live {

int live_on_dds(const LiveOptions& options) {
    const LiveConfig config = load_live_config(options, {});  // for the bus alone
    DdsBus bus({.domain = config.bus.domain, .network = config.bus.network});
    return live(bus, options);
}

}  // namespace dynamic_filter::live
