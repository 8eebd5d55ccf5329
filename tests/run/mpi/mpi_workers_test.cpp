// SPDX-License-Identifier: MIT
/// Starts mpi_rank.cpp by mpirun, as several processes, and reads what they say.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <map>
#include <regex>
#include <string>
#include <vector>

namespace mpi_workers_test {

struct Ended {
    int code = 0;
    std::string said;
};

Ended shell(const std::string& line) {
    Ended ended;
    FILE* const pipe = popen((line + " 2>&1 < /dev/null").c_str(), "r");
    for (int c = 0; (c = std::fgetc(pipe)) != EOF;) ended.said.push_back(static_cast<char>(c));
    ended.code = WEXITSTATUS(pclose(pipe));
    return ended;
}

/// As root, as more processes than cores, and on this machine alone.
Ended mpirun(int processes, const std::string& scenario) {
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    return shell(fmt::format("mpirun --oversubscribe --bind-to none -n {} '{}' {}", processes,
                             MPI_RANK, scenario));
}

/// Task and the number of times that a line of what was said has it.
std::map<int, int> taken(const std::string& said) {
    std::map<int, int> times;
    const std::regex line("rank \\d+ takes (\\d+)");
    for (std::sregex_iterator it(said.begin(), said.end(), line), end; it != end; ++it) {
        ++times[std::stoi((*it)[1])];
    }
    return times;
}

int count(const std::string& said, const std::string& what) {
    int found = 0;
    for (auto at = said.find(what); at != std::string::npos; at = said.find(what, at + 1)) ++found;
    return found;
}

class Processes : public testing::TestWithParam<int> {};

TEST_P(Processes, ShareEveryTaskOnceInEachRound) {
    const Ended ended = mpirun(GetParam(), "all_tasks");
    ASSERT_EQ(ended.code, 0) << ended.said;
    const std::map<int, int> times = taken(ended.said);
    ASSERT_EQ(times.size(), 40u) << ended.said;
    for (const auto& [task, n] : times) EXPECT_EQ(n, task < 25 ? 2 : 1) << "task " << task;
    EXPECT_EQ(count(ended.said, fmt::format("of {}: well", GetParam())), 2 * GetParam());
    for (int rank = 0; rank < GetParam(); ++rank) {
        EXPECT_GT(count(ended.said, fmt::format("rank {} takes", rank)), 0) << ended.said;
    }
}

INSTANTIATE_TEST_SUITE_P(Numbers, Processes, testing::Values(1, 2, 4));

TEST(MpiWorkers, TasksAreHandedOutWhileRank0Computes) {
    const Ended ended = mpirun(2, "busy_rank_0");
    ASSERT_EQ(ended.code, 0) << ended.said;
    EXPECT_EQ(taken(ended.said).size(), 20u) << ended.said;
    EXPECT_LT(ended.said.find("others have no task left"), ended.said.find("rank 0 takes 0"));
}

TEST(MpiWorkers, WaitingCostsHardlyAnyTimeOfACore) {
    const Ended ended = mpirun(3, "waiting");
    ASSERT_EQ(ended.code, 0) << ended.said;
    std::smatch used;
    for (const int rank : {1, 2}) {
        const std::regex line(fmt::format("rank {} used ([0-9.]+) s", rank));
        ASSERT_TRUE(std::regex_search(ended.said, used, line)) << ended.said;
        EXPECT_LT(std::stod(used[1]), 0.4) << "of the 2 s that rank 0 needed";
    }
}

TEST(MpiWorkers, IfOneFailsTheOthersStopAndItsCodeIsThatOfMpirun) {
    const Ended ended = mpirun(3, "one_says_no");
    EXPECT_EQ(ended.code, 3) << ended.said;
    EXPECT_EQ(count(ended.said, "not well"), 3) << ended.said;
    EXPECT_LT(taken(ended.said).size(), 20000u);
}

TEST(MpiWorkers, AnExceptionOfOneProcessEndsAll) {
    const Ended ended = mpirun(3, "one_throws");
    EXPECT_EQ(ended.code, 3) << ended.said;
    EXPECT_EQ(count(ended.said, "rank 1 cannot read"), 1) << ended.said;
    EXPECT_EQ(count(ended.said, "not well"), 2) << ended.said;
}

TEST(MpiWorkers, AnExceptionOfTheMergeEndsThoseThatWaitForIt) {
    const Ended ended = mpirun(3, "merge_throws");
    EXPECT_EQ(ended.code, 3) << ended.said;
    EXPECT_EQ(count(ended.said, "rank 0 cannot merge"), 1) << ended.said;
    EXPECT_EQ(count(ended.said, "of 3: well"), 3) << ended.said;
    EXPECT_EQ(count(ended.said, "not well"), 2) << ended.said;
}

TEST(MpiWorkers, NobodyWaitsForAProcessThatLeaves) {
    const Ended ended = mpirun(3, "leaves");
    EXPECT_EQ(ended.code, 0) << ended.said;
    EXPECT_EQ(count(ended.said, "not well"), 2) << ended.said;
}

TEST(MpiWorkers, AKilledProcessEndsAll) {
    const Ended ended = mpirun(3, "is_killed");
    EXPECT_NE(ended.code, 0) << ended.said;
    EXPECT_EQ(count(ended.said, "well"), 0) << ended.said;
}

TEST(MpiWorkers, WithoutMpirunTheErrorSaysHowToStart) {
    const Ended ended =
        shell(fmt::format("env -u OMPI_COMM_WORLD_SIZE -u PMIX_RANK '{}' waiting", MPI_RANK));
    EXPECT_EQ(ended.code, 2) << ended.said;
    EXPECT_NE(ended.said.find("mpirun -n 8 dynamicfilter run"), std::string::npos) << ended.said;
}

}  // namespace mpi_workers_test
