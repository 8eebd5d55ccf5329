// SPDX-License-Identifier: MIT
// Every file of the corpus through its reader: seeds, and what the fuzzers once found.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "fuzz/targets.hpp"

namespace dynamic_filter::fuzz {
namespace corpus_test {

std::vector<std::uint8_t> bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(Corpus, EveryFileGivesAResultOrAnError) {
    for (const auto& [name, target] : targets()) {
        std::size_t files = 0;
        for (const auto& entry : std::filesystem::directory_iterator(
                 std::filesystem::path(DYNAMIC_FILTER_CORPUS) / name)) {
            SCOPED_TRACE(entry.path().string());
            EXPECT_NO_THROW(target(bytes_of(entry.path())));
            ++files;
        }
        EXPECT_GT(files, 0U) << name;
    }
}

/// Each seed cut off at every byte: what is missing is an error, not a crash.
TEST(Corpus, EveryBeginningOfEveryFileGivesAResultOrAnError) {
    for (const auto& [name, target] : targets()) {
        for (const auto& entry : std::filesystem::directory_iterator(
                 std::filesystem::path(DYNAMIC_FILTER_CORPUS) / name)) {
            SCOPED_TRACE(entry.path().string());
            std::vector<std::uint8_t> bytes = bytes_of(entry.path());
            if (bytes.size() > 4096) continue;
            for (std::size_t length = bytes.size(); length > 0; --length) {
                bytes.resize(length - 1);
                EXPECT_NO_THROW(target(bytes));
            }
        }
    }
}

}  // namespace corpus_test
}  // namespace dynamic_filter::fuzz
