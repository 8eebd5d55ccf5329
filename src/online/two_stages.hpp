// SPDX-License-Identifier: MIT
/// Two threads in a pipeline: the first takes one job after another; the work that a job leaves to
/// do goes to the second. The class does not depend on what the jobs do.
#pragma once

#include <array>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>

namespace dynamic_filter {

/// All members may be called from any thread, except where they say otherwise.
class TwoStages {
public:
    using Rest = std::function<void()>;  ///< work for the second thread; empty: none
    using Job = std::function<Rest()>;   ///< work for the first thread
    using Lock = std::unique_lock<std::mutex>;

    /// Functions that the owner provides.
    struct Hooks {
        /// Returns the next job; empty if there is none. The first thread calls it with the lock
        /// held.
        std::function<Job()> take;
        /// True if take() would return a job. Called with the lock held.
        std::function<bool()> has_job;
        /// Called with the lock held when the threads are to stop. After it, no job is taken.
        std::function<void()> give_up;
        /// Called in each thread with the function to run there; it can set up what the thread
        /// needs.
        std::function<void(const std::function<void()>&)> around;
    };

    /// Starts the threads. Throws std::system_error if that is not possible.
    explicit TwoStages(Hooks hooks);
    TwoStages(const TwoStages&) = delete;
    TwoStages& operator=(const TwoStages&) = delete;
    ~TwoStages() { stop(); }

    /// The lock of the data that take() uses; call changed() after changing them.
    [[nodiscard]] Lock lock() const { return Lock(lock_); }
    void changed() { changed_.notify_all(); }
    /// Waits until the predicate is true or a stage has failed; holds the lock again when it
    /// returns.
    template <class Predicate>
    void wait(Lock& hold, const Predicate& predicate) {
        changed_.wait(hold, [&] { return failure_ || predicate(); });
    }
    /// For the first thread: waits until the second thread has at most `left` jobs.
    void wait_for_second(std::size_t left);
    /// Waits until there is no work; returns holding the lock. Rethrows an exception of a stage.
    /// Throws Error if called from one of the two threads, which would wait for itself.
    Lock idle();
    /// Stops the threads: the first one after its job, the second one after all its work. A second
    /// call does nothing.
    void stop();

    /// Rethrows the exception of a stage, if there is one. Call it with the lock held.
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }
    /// Makes all callers get this exception from now on, for an exception in a thread of the owner.
    void fail(std::exception_ptr failure);
    /// Throws Error if the caller is one of the two threads.
    void refuse_own_threads() const;

private:
    void run_first();
    void run_second();
    void guarded(void (TwoStages::*loop)(), bool& busy);

    Hooks hooks_;
    mutable std::mutex lock_;
    std::condition_variable changed_;  // notified when a member below, or data of take(), changed
    std::deque<Rest> rests_;
    bool first_busy_ = false, second_busy_ = false, stopping_ = false;
    std::exception_ptr failure_;
    std::array<std::thread::id, 2> own_;
    std::thread first_, second_;  // must be the last members, because they use all others
};

}  // namespace dynamic_filter
