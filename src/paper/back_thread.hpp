// SPDX-License-Identifier: MIT
/// The second thread of the paper's pipeline: it does the work of the back-end while the front-end
/// goes on in the caller's thread (Fig. 2). The class does not depend on what the jobs do.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace dynamic_filter {

/// Does jobs one after the other, in the order in which they are added. Single caller.
class BackThread {
public:
    /// Throws std::system_error if no thread can be started.
    BackThread();
    BackThread(const BackThread&) = delete;
    BackThread& operator=(const BackThread&) = delete;
    /// Does what was added, and ends the thread.
    ~BackThread();

    /// Adds a job, which runs with the caller's number of threads (parallel.hpp). Waits first while
    /// more than two jobs are left, so that the caller is never far ahead. Rethrows the exception
    /// of a job; after one, no further job is done.
    void add(std::function<void()> job);
    /// Waits until all jobs are done. Rethrows the exception of a job.
    void wait() { wait_for(0).unlock(); }

private:
    void run();
    std::unique_lock<std::mutex> wait_for(std::size_t left);

    std::mutex lock_;
    std::condition_variable changed_;         // notified when a member below changed
    std::deque<std::function<void()>> jobs_;  // the first one is running
    bool stopping_ = false;
    std::exception_ptr failure_;
    std::thread thread_;  // must be the last member, because it uses all others
};

}  // namespace dynamic_filter
