// SPDX-License-Identifier: MIT
#include "dynamic_filter/file.hpp"

#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <cstdlib>

#include "base/input.hpp"
#include "support/bytes.hpp"

namespace dynamic_filter::io {
namespace file_test {

namespace fs = std::filesystem;

std::ptrdiff_t count_files(const TemporaryFolder& folder) {
    return std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator());
}

TEST(File, ReadsWhatWasWritten) {
    const TemporaryFolder folder;
    const std::string bytes("a\0b\n", 4);
    write_file(folder / "f", bytes);
    EXPECT_EQ(read_file(folder / "f"), bytes);
    write_file(folder / "f", "");
    EXPECT_EQ(read_file(folder / "f"), "");
    EXPECT_EQ(count_files(folder), 1);
}

TEST(File, RefusesWhatIsNoRegularFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
    fs::create_symlink(folder / "loop", folder / "loop");
    EXPECT_HAS(error_of([&] { read_file(folder.path()); }), "folder");
    EXPECT_HAS(error_of([&] { read_file(folder / "pipe"); }), "pipe");
    EXPECT_HAS(error_of([] { read_file("/dev/zero"); }), "device");
    EXPECT_HAS(error_of([&] { read_file(folder / "none"); }), "No such file");
    EXPECT_HAS(error_of([&] { read_file(folder / "loop"); }), "cannot be opened");
}

TEST(InputFile, ReadsPartsAndNothingBeyondTheEnd) {
    const TemporaryFolder folder;
    const InputFile file(folder.put("f", "0123456789"));
    EXPECT_EQ(as_text(file.read(3, 4)), "3456");
    EXPECT_TRUE(file.read(10, 0).empty());
    const std::pair<std::uint64_t, std::uint64_t> beyond[] = {{8, 3}, {11, 0}, {1, UINT64_MAX}};
    for (const auto& [offset, count] : beyond) {
        EXPECT_HAS(error_of([&, o = offset, c = count] { (void)file.read(o, c); }), "ends at 10");
    }
    EXPECT_HAS(error_of([&] { InputFile none(folder.path()); }), "folder");
}

TEST(InputFile, AFileThatShrinksMeanwhileIsAnError) {
    const TemporaryFolder folder;
    const InputFile file(folder.put("f", "0123456789"));
    fs::resize_file(folder / "f", 4);
    EXPECT_HAS(error_of([&] { (void)file.read(2, 8); }), "(byte 4): became shorter");
}

TEST(File, NothingIsLeftWithoutCommit) {
    const TemporaryFolder folder;
    folder.put("f", "old");
    {
        AtomicFile file(folder / "f");
        file.write("new");
        AtomicFile moved(std::move(file));
        moved.write(std::string(3U << 20U, 'x'));
        EXPECT_EQ(count_files(folder), 2);
    }
    EXPECT_EQ(count_files(folder), 1);
    EXPECT_EQ(slurp(folder / "f"), "old");
}

TEST(File, RewritesBufferedAndFlushedBytes) {
    const TemporaryFolder folder;
    AtomicFile file(folder / "f");
    const std::string much(3U << 20U, 'x');
    file.write("0123");
    file.rewrite(1, "ab");
    file.write(much);
    file.write("tail");
    file.rewrite(much.size() + 2, "cdef");
    error_of<OutputError>([&] { file.rewrite(much.size() + 6, "ghi"); });
    file.commit();
    std::string expected = "0ab3" + much + "tail";
    expected.replace(much.size() + 2, 4, "cdef");
    EXPECT_TRUE(slurp(folder / "f") == expected);
    EXPECT_EQ(count_files(folder), 1);
}

TEST(File, SaysWhyItCannotWrite) {
    const TemporaryFolder folder;
    folder.put("f", "");
    EXPECT_HAS(error_of<OutputError>([] { AtomicFile file("/proc/none/f"); }), "No such file");
    EXPECT_HAS(error_of<OutputError>([&] { AtomicFile file(folder / "f/g"); }), "Not a directory");
    EXPECT_HAS(error_of<OutputError>([&] { AtomicFile file(folder.path()); }), "folder");
    EXPECT_HAS(error_of<OutputError>([] { AtomicFile file("/dev/full"); }), "device");
}

/// In a process of its own, whose files may not grow beyond 1,000 bytes.
TEST(AtomicFile, AFullDiskLeavesTheOldFileAndNothingElse) {
    const TemporaryFolder folder;
    folder.put("f", "old");
    const auto write_much = [&] {
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{1000, 1000};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        EXPECT_HAS(error_of<OutputError>([&] { write_file(folder / "f", std::string(5000, 'x')); }),
                   "File too large");
        std::_Exit(testing::Test::HasFailure() ? 1 : 0);
    };
    EXPECT_EXIT(write_much(), testing::ExitedWithCode(0), "");
    EXPECT_EQ(slurp(folder / "f"), "old");
    EXPECT_EQ(count_files(folder), 1);
}

TEST(AtomicFile, WhatCannotBePutInPlaceIsTakenAway) {
    const TemporaryFolder folder;
    {
        AtomicFile file(folder / "f");
        fs::create_directories(folder / "f");
        EXPECT_HAS(error_of<OutputError>([&] { file.commit(); }), "renamed into place");
    }
    EXPECT_EQ(count_files(folder), 1);
    EXPECT_TRUE(fs::is_directory(folder / "f"));
}

TEST(AtomicFile, ALinkStaysAndItsTargetIsReplaced) {
    const TemporaryFolder folder;
    folder.put("real", "old");
    std::filesystem::create_symlink("real", folder / "link");
    write_file(folder / "link", "new");
    EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
    EXPECT_EQ(slurp(folder / "real"), "new");
    std::filesystem::create_symlink("nothing", folder / "dangling");
    EXPECT_THROW(write_file(folder / "dangling", "x"), OutputError);
}

}  // namespace file_test
}  // namespace dynamic_filter::io
