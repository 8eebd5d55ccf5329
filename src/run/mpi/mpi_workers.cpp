// SPDX-License-Identifier: MIT
#include "run/mpi/mpi_workers.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace dynamic_filter::app::mpi {

namespace {

using std::chrono::milliseconds;

enum Tag { kQuestion, kAnswer };

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
constexpr std::uint64_t kFailure = kNone;  ///< in place of a round: this process has failed

/// A task takes seconds, so this delays nobody; and asking 200 times a second costs about 1 % of a
/// core.
constexpr milliseconds kPause{5};
/// While others compute, for minutes.
constexpr milliseconds kLongPause{20};
/// Time for which a process that did not fail waits for one that failed to end first. Then mpirun
/// ends with the exit code of the failed process and does not kill it before it has said why.
constexpr milliseconds kPrecedence{500};

}  // namespace

MpiWorkers::MpiWorkers() {
    MPI_Comm_dup(MPI_COMM_WORLD, &all_);
    MPI_Comm_rank(all_, &rank_);
    MPI_Comm_size(all_, &size_);
    if (rank_ == 0 && size_ > 1) {
        server_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
    }
}

MpiWorkers::~MpiWorkers() {
    if (!agreed_) tell_failure();
    // The others may still come to meetings that this process leaves out.
    while (meet({.well = 0, .leaves = 1}).leaves == 0) {
    }
    if (server_.joinable()) {
        server_.request_stop();
        server_.join();
    }
    MPI_Comm_free(&all_);
    MPI_Finalize();
    if (others_failed_) std::this_thread::sleep_for(kPrecedence);
}

std::optional<std::size_t> MpiWorkers::next(std::size_t count) {
    const std::uint64_t task = ask();
    if (task >= count) return std::nullopt;
    return task;
}

bool MpiWorkers::all_done(bool well) {
    if (!well) tell_failure();
    agreed_ = meet({.well = well, .leaves = 0}).well == 1;
    others_failed_ = well && !agreed_;
    ++round_;
    return agreed_;
}

std::uint64_t MpiWorkers::pop(std::uint64_t round) {
    // A process may be a round ahead of rank 0, so each round has a counter of its own.
    if (taken_.size() <= round) taken_.resize(round + 1);
    return failed_ ? kNone : taken_[round]++;
}

std::uint64_t MpiWorkers::ask() {
    const std::scoped_lock one_question(asking_);
    agreed_ = false;
    if (rank_ == 0) {
        const std::scoped_lock lock(calls_);
        return pop(round_);
    }
    std::uint64_t task = kNone;
    MPI_Request answer = MPI_REQUEST_NULL;
    {
        const std::scoped_lock lock(calls_);
        MPI_Irecv(&task, 1, MPI_UINT64_T, 0, kAnswer, all_, &answer);
        MPI_Send(&round_, 1, MPI_UINT64_T, 0, kQuestion, all_);
    }
    wait_for(answer, kPause);
    return task;
}

void MpiWorkers::tell_failure() {
    const std::scoped_lock lock(calls_);
    if (rank_ == 0) {
        failed_ = true;
    } else {
        MPI_Send(&kFailure, 1, MPI_UINT64_T, 0, kQuestion, all_);
    }
}

MpiWorkers::Vote MpiWorkers::meet(Vote mine) {
    const std::array<int, 2> said{mine.well, mine.leaves};
    std::array<int, 2> least{};
    MPI_Request request = MPI_REQUEST_NULL;
    {
        const std::scoped_lock lock(calls_);
        MPI_Iallreduce(said.data(), least.data(), 2, MPI_INT, MPI_MIN, all_, &request);
    }
    wait_for(request, kLongPause);
    return {.well = least[0], .leaves = least[1]};
}

void MpiWorkers::wait_for(MPI_Request& request, milliseconds longest_pause) {
    for (milliseconds pause{1};; pause = std::min(2 * pause, longest_pause)) {
        int done = 0;
        {
            const std::scoped_lock lock(calls_);
            MPI_Test(&request, &done, MPI_STATUS_IGNORE);
        }
        if (done) return;
        std::this_thread::sleep_for(pause);
    }
}

bool MpiWorkers::answer_one() {
    const std::scoped_lock lock(calls_);
    int is_there = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, kQuestion, all_, &is_there, &status);
    if (!is_there) return false;
    std::uint64_t round = 0;
    MPI_Recv(&round, 1, MPI_UINT64_T, status.MPI_SOURCE, kQuestion, all_, MPI_STATUS_IGNORE);
    if (round == kFailure) {
        failed_ = true;
        return true;
    }
    const std::uint64_t task = pop(round);
    MPI_Send(&task, 1, MPI_UINT64_T, status.MPI_SOURCE, kAnswer, all_);
    return true;
}

void MpiWorkers::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        if (!answer_one()) std::this_thread::sleep_for(kPause);
    }
    while (answer_one()) {  // nobody asks any more, but a failure may still be under way
    }
}

}  // namespace dynamic_filter::app::mpi
