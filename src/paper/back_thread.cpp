// SPDX-License-Identifier: MIT
#include "paper/back_thread.hpp"

#include <utility>

#include "dynamic_filter/parallel.hpp"

namespace dynamic_filter {

BackThread::BackThread() : thread_([this] { run(); }) {}

BackThread::~BackThread() {
    {
        const std::lock_guard hold(lock_);
        stopping_ = true;
    }
    changed_.notify_all();
    thread_.join();
}

void BackThread::run() {
    std::unique_lock hold(lock_);
    while (true) {
        changed_.wait(hold, [&] { return stopping_ || !jobs_.empty(); });
        if (jobs_.empty()) return;
        const std::function<void()>& job = jobs_.front();  // others are only added behind it
        hold.unlock();
        std::exception_ptr failure;
        try {
            job();
        } catch (...) {
            failure = std::current_exception();
        }
        hold.lock();
        jobs_.pop_front();
        if (failure) {
            failure_ = failure;
            jobs_.clear();
        }
        changed_.notify_all();
    }
}

std::unique_lock<std::mutex> BackThread::wait_for(std::size_t left) {
    std::unique_lock hold(lock_);
    changed_.wait(hold, [&] { return jobs_.size() <= left; });
    if (failure_) std::rethrow_exception(failure_);
    return hold;
}

void BackThread::add(std::function<void()> job) {
    const auto hold = wait_for(2);  // a submap, and what is forgotten after it
    jobs_.emplace_back(
        [job = std::move(job), threads = current_threads()] { with_threads(threads, job); });
    changed_.notify_all();
}

}  // namespace dynamic_filter
