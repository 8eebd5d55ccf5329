// SPDX-License-Identifier: MIT
/// Two threads in line: the first takes one job after another, and what a job leaves to do goes to
/// the second. It knows nothing of what the jobs do.
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

/// All functions but those that say otherwise may be called from any thread.
class TwoStages {
public:
    using Rest = std::function<void()>;  ///< for the second thread; empty: nothing
    using Job = std::function<Rest()>;   ///< for the first thread
    using Lock = std::unique_lock<std::mutex>;

    /// What the owner provides.
    struct Hooks {
        /// The next job; empty: there is none. Called by the first thread, with the lock held.
        std::function<Job()> take;
        /// Whether take() would give one. With the lock held.
        std::function<bool()> has_job;
        /// Called with the lock held when the threads are to stop: nothing is taken any more.
        std::function<void()> give_up;
        /// Runs what it is given, in each thread: the place to set up what a thread needs.
        std::function<void(const std::function<void()>&)> around;
    };

    /// Starts the threads. Throws std::system_error if that is not possible.
    explicit TwoStages(Hooks hooks);
    TwoStages(const TwoStages&) = delete;
    TwoStages& operator=(const TwoStages&) = delete;
    ~TwoStages() { stop(); }

    /// The lock of whatever take() looks at; call changed() after changing it.
    [[nodiscard]] Lock lock() const { return Lock(lock_); }
    void changed() { changed_.notify_all(); }
    /// Waits, holding the lock again at the end, until it is true or a stage has failed.
    template <class Predicate>
    void wait(Lock& hold, const Predicate& predicate) {
        changed_.wait(hold, [&] { return failure_ || predicate(); });
    }
    /// For the first thread: waits until the second has at most so many jobs left.
    void wait_for_second(std::size_t left);
    /// Waits until there is nothing to do; returns holding the lock. Throws what a stage threw, and
    /// Error from one of the two threads, which would wait for itself.
    Lock idle();
    /// Lets the first thread end after its job, the second when it has nothing left. Again:
    /// nothing.
    void stop();

    /// Throws what a stage threw, if one did. With the lock held.
    void rethrow() const {
        if (failure_) std::rethrow_exception(failure_);
    }
    /// The same for what the owner's own thread threw, from now on.
    void fail(std::exception_ptr failure);
    /// Throws Error if the caller is one of the two threads.
    void refuse_own_threads() const;

private:
    void run_first();
    void run_second();
    void guarded(void (TwoStages::*loop)(), bool& busy);

    Hooks hooks_;
    mutable std::mutex lock_;
    std::condition_variable changed_;  // anything below, or what take() looks at
    std::deque<Rest> rests_;
    bool first_busy_ = false, second_busy_ = false, stopping_ = false;
    std::exception_ptr failure_;
    std::array<std::thread::id, 2> own_;
    std::thread first_, second_;  // the last members: they use all others
};

}  // namespace dynamic_filter
