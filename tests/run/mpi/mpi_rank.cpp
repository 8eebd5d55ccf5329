// SPDX-License-Identifier: MIT
/// One process of the runs that mpi_workers_test.cpp starts.   mpi_rank SCENARIO
/// Prints whole lines, as mpirun mixes those of all processes.
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "dynamic_filter/error.hpp"
#include "run/workers.hpp"

namespace {

using namespace dynamic_filter;
using app::Workers;
using Clock = std::chrono::steady_clock;

void say(const std::string& line) {
    const std::string whole = line + "\n";
    if (write(STDOUT_FILENO, whole.data(), whole.size()) < 0) std::_Exit(9);
}

void rest(int milliseconds) {
    std::this_thread::sleep_for(std::chrono::milliseconds(milliseconds));
}

double cpu_seconds() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(used.ru_utime) + seconds(used.ru_stime);
}

void compute(int milliseconds) {
    const auto end = Clock::now() + std::chrono::milliseconds(milliseconds);
    volatile unsigned busy = 0;
    while (Clock::now() < end) busy = busy + 1;
}

/// Takes tasks with two threads until none is left.
void work_on_all(Workers& workers, std::size_t count,
                 const std::function<void(std::size_t)>& work) {
    std::array<std::jthread, 2> threads;
    for (auto& thread : threads) {
        thread = std::jthread([&] {
            while (const auto task = workers.next(count)) {
                say(fmt::format("rank {} takes {}", workers.rank(), *task));
                work(*task);
            }
        });
    }
}

int finish(Workers& workers, bool well) {
    const bool all = workers.all_done(well);
    say(fmt::format("rank {} of {}: {}", workers.rank(), workers.size(),
                    all ? "well" : "not well"));
    return all ? 0 : 1;
}

/// Each of 40 tasks goes to somebody, in two rounds, between which no process waits for long.
int all_tasks(Workers& workers) {
    work_on_all(workers, 40, [](std::size_t) { rest(20); });
    if (finish(workers, true) != 0) return 1;
    work_on_all(workers, 25, [](std::size_t) {});
    return finish(workers, true);
}

/// Rank 0 computes one task, in which it calls nothing; the others must get theirs meanwhile.
int busy_rank_0(Workers& workers) {
    if (workers.rank() == 0) {
        const auto task = workers.next(20);
        compute(1500);
        say(fmt::format("rank 0 takes {}", *task));
    } else {
        rest(100);
        while (const auto task = workers.next(20)) {
            say(fmt::format("rank {} takes {}", workers.rank(), *task));
            rest(10);
        }
        say("others have no task left");
    }
    return finish(workers, true);
}

/// The others wait for rank 0 at all_done, and afterwards at the end.
int waiting(Workers& workers) {
    const double before = cpu_seconds();
    if (workers.rank() == 0) rest(2000);
    finish(workers, true);
    say(fmt::format("rank {} used {:.3f} s", workers.rank(), cpu_seconds() - before));
    return 0;
}

/// Rank 1 says that it failed at its first task: the others stop long before the end.
int one_says_no(Workers& workers) {
    if (workers.rank() == 1) {
        finish(workers, false);
        rest(50);  // mpirun must nevertheless end with the code of this process
        return 3;
    }
    work_on_all(workers, 100000, [](std::size_t) { rest(1); });
    return finish(workers, true);
}

/// Rank 1 throws in the midst; nobody waits for it.
int one_throws(Workers& workers) {
    if (workers.rank() == 1) throw std::runtime_error("rank 1 cannot read");
    work_on_all(workers, 100000, [](std::size_t) { rest(1); });
    return finish(workers, true);
}

/// Rank 0 throws while it merges, when the others wait for the end of that.
int merge_throws(Workers& workers) {
    work_on_all(workers, 10, [](std::size_t) {});
    if (finish(workers, true) != 0) return 1;
    if (workers.rank() == 0) throw std::runtime_error("rank 0 cannot merge");
    return finish(workers, true);
}

/// Ends without any call of all_done, and without a fault: the others must not wait.
int leaves(Workers& workers) {
    if (workers.rank() == 1) return 0;
    return finish(workers, true) == 1 ? 0 : 1;
}

int is_killed(Workers& workers) {
    if (workers.rank() == 1) std::raise(SIGKILL);
    rest(20000);
    return finish(workers, true);
}

int run(const std::string& scenario) {
    const std::map<std::string, int (*)(Workers&)> scenarios{
        {"all_tasks", all_tasks},     {"busy_rank_0", busy_rank_0}, {"waiting", waiting},
        {"one_says_no", one_says_no}, {"one_throws", one_throws},   {"merge_throws", merge_throws},
        {"leaves", leaves},           {"is_killed", is_killed}};
    const auto workers = app::mpi_workers();
    const int code = scenarios.at(scenario)(*workers);
    if (scenario == "all_tasks" && workers->rank() == 0) rest(100);  // writes while the others wait
    return code;
}

}  // namespace

int main(int count, char** arguments) {
    try {
        return run(count > 1 ? arguments[1] : "");
    } catch (const ConfigError& error) {
        say(error.what());
        return 2;
    } catch (const std::exception& error) {
        say(error.what());
        return 3;
    }
}
