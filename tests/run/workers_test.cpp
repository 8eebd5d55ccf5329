// SPDX-License-Identifier: MIT
#include "run/workers.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter::app {
namespace workers_test {

TEST(Alone, ThreadsShareEveryTaskOnce) {
    const auto workers = alone();
    EXPECT_EQ(workers->rank(), 0);
    EXPECT_EQ(workers->size(), 1);
    std::mutex lock;
    std::multiset<std::size_t> taken;
    {
        std::vector<std::jthread> threads(4);
        for (auto& thread : threads) {
            thread = std::jthread([&] {
                while (const auto task = workers->next(1000)) {
                    const std::scoped_lock locked(lock);
                    taken.insert(*task);
                }
            });
        }
    }
    ASSERT_EQ(taken.size(), 1000u);
    std::size_t expected = 0;
    for (const std::size_t task : taken) EXPECT_EQ(task, expected++);
}

TEST(Alone, TasksComeInTheOrderOfTheirNumbersAndBeginAgainAfterAllDone) {
    const auto workers = alone();
    for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(workers->next(2), 0u);
        EXPECT_EQ(workers->next(2), 1u);
        EXPECT_EQ(workers->next(2), std::nullopt);
        EXPECT_TRUE(workers->all_done(true));
    }
    EXPECT_EQ(workers->next(0), std::nullopt);
}

TEST(Alone, AfterAFailureThereAreNoTasks) {
    const auto workers = alone();
    EXPECT_EQ(workers->next(10), 0u);
    EXPECT_FALSE(workers->all_done(false));
    EXPECT_EQ(workers->next(10), std::nullopt);
}

/// The plug-in is not beside this test; a file that is none takes its place.
class Plugin : public testing::Test {
protected:
    const std::filesystem::path file =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "libdynamicfilter_mpi.so";

    void TearDown() override { std::filesystem::remove(file); }

    static std::string fault() {
        try {
            mpi_workers();
        } catch (const ConfigError& error) {
            return error.what();
        }
        return "none";
    }
};

TEST_F(Plugin, WithoutItTheErrorSaysWhatToInstall) {
    const std::string said = fault();
    EXPECT_NE(said.find("apt-get install dynamicfilter-mpi"), std::string::npos) << said;
}

TEST_F(Plugin, AFileThatCannotBeLoadedIsNamed) {
    std::ofstream(file) << "no library";
    const std::string said = fault();
    EXPECT_NE(said.find(file.string()), std::string::npos) << said;
    EXPECT_NE(said.find("openmpi-bin"), std::string::npos) << said;
}

}  // namespace workers_test
}  // namespace dynamic_filter::app
