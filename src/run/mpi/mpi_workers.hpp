// SPDX-License-Identifier: MIT
/// Workers that mpirun started. Rank 0 hands out the tasks: a thread of it answers the others, also
/// while its other threads compute for minutes.
#pragma once

#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include "run/workers.hpp"

namespace dynamic_filter::app::mpi {

/// Ends MPI when it is destroyed, so there may be only one in the life of a process.
///
/// Waiting in MPI's own functions costs a whole core, because Open MPI asks its network without a
/// pause. So everything here asks and sleeps in turns. One mutex around every call of MPI suffices,
/// because none of them waits for another process: messages have eight bytes, and MPI sends such
/// without waiting for who receives them. MPI then needs no more than MPI_THREAD_SERIALIZED.
class MpiWorkers final : public Workers {
public:
    MpiWorkers();  ///< after MPI_Init_thread
    ~MpiWorkers() override;

    int rank() const override { return rank_; }
    int size() const override { return size_; }
    std::optional<std::size_t> next(std::size_t count) override;
    bool all_done(bool well) override;

private:
    /// The vote of one process in a meeting. The result has the least value of each member.
    struct Vote {
        int well, leaves;
    };

    std::uint64_t pop(std::uint64_t round);  ///< by rank 0, while calls_ is locked
    std::uint64_t ask();
    void tell_failure();
    Vote meet(Vote mine);
    void wait_for(MPI_Request& request, std::chrono::milliseconds longest_pause);
    bool answer_one();
    void serve(const std::stop_token& stop);

    MPI_Comm all_ = MPI_COMM_NULL;
    int rank_ = 0, size_ = 1;
    std::mutex calls_;   ///< around every call of MPI, and around the two below
    std::mutex asking_;  ///< around a question and its answer, which belongs to one thread
    std::vector<std::uint64_t> taken_;  ///< by round; of rank 0
    bool failed_ = false;               ///< some process failed; of rank 0
    std::uint64_t round_ = 0;           ///< number of calls of all_done so far
    bool agreed_ = false;               ///< the last call of all_done returned true
    bool others_failed_ = false;        ///< and this process did not
    std::jthread server_;               ///< of rank 0
};

}  // namespace dynamic_filter::app::mpi
