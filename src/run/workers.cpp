// SPDX-License-Identifier: MIT
#include "run/workers.hpp"

#include <fmt/format.h>

#include <atomic>

#include "base/plugin.hpp"
#include "dynamic_filter/error.hpp"
#include "run/mpi/plugin.hpp"

namespace dynamic_filter::app {

namespace {

constexpr PluginFile kPlugin{.option = "--mpi",
                             .name = "libdynamicfilter_mpi.so",
                             .package = "dynamicfilter-mpi",
                             .to_build = "libopenmpi-dev",
                             .to_load = "openmpi-bin",
                             .version_of = mpi::kVersion};

class Alone final : public Workers {
public:
    int rank() const override { return 0; }
    int size() const override { return 1; }

    std::optional<std::size_t> next(std::size_t count) override {
        if (failed_) return std::nullopt;
        const std::size_t task = taken_++;
        if (task >= count) return std::nullopt;
        return task;
    }

    bool all_done(bool well) override {
        failed_ = failed_ || !well;
        taken_ = 0;
        return well;
    }

private:
    std::atomic<std::size_t> taken_ = 0;
    std::atomic<bool> failed_ = false;
};

}  // namespace

std::unique_ptr<Workers> alone() { return std::make_unique<Alone>(); }

std::unique_ptr<Workers> mpi_workers() {
    // Open MPI loads parts of itself that expect its symbols among those of the whole process.
    const Plugin plugin(kPlugin, DYNAMIC_FILTER_VERSION, true);
    const char* fault = nullptr;
    std::unique_ptr<Workers> workers(plugin.function<mpi::Make>(mpi::kMake)(&fault));
    if (!workers) throw ConfigError(fmt::format("--mpi: {}", fault));
    return workers;
}

}  // namespace dynamic_filter::app
