// SPDX-License-Identifier: MIT
#include "online/two_stages.hpp"

#include <algorithm>
#include <utility>

#include "dynamic_filter/error.hpp"

namespace dynamic_filter {

TwoStages::TwoStages(Hooks hooks) : hooks_(std::move(hooks)) {
    Lock hold = lock();  // so that no job is taken before `own_` is set
    first_ = std::thread([this] { guarded(&TwoStages::run_first, first_busy_); });
    try {
        second_ = std::thread([this] { guarded(&TwoStages::run_second, second_busy_); });
    } catch (...) {  // joins the first thread, which uses members of this object
        stopping_ = true;
        hold.unlock();
        first_.join();
        throw;
    }
    own_ = {first_.get_id(), second_.get_id()};
}

void TwoStages::run_first() {
    while (true) {
        Job job;
        {
            Lock hold = lock();
            changed_.wait(hold, [&] { return stopping_ || hooks_.has_job(); });
            if (stopping_) return;
            job = hooks_.take();
            first_busy_ = true;
            changed();
        }
        Rest rest = job();
        const Lock hold = lock();
        first_busy_ = false;
        if (rest) rests_.push_back(std::move(rest));
        changed();
    }
}

void TwoStages::run_second() {
    while (true) {
        Rest rest;
        {
            Lock hold = lock();
            changed_.wait(hold, [&] { return !rests_.empty() || (stopping_ && !first_busy_); });
            if (rests_.empty()) return;  // work left by the first thread is finished in any case
            rest = std::move(rests_.front());
            rests_.pop_front();
            second_busy_ = true;
        }
        rest();
        const Lock hold = lock();
        second_busy_ = false;
        changed();
    }
}

/// If a stage fails, both threads stop and no work stays half done; the next caller gets the
/// exception.
void TwoStages::guarded(void (TwoStages::*loop)(), bool& busy) {
    try {
        hooks_.around([&] { (this->*loop)(); });
    } catch (...) {
        const Lock hold = lock();
        if (!failure_) failure_ = std::current_exception();
        busy = false;
        if (&busy == &second_busy_) rests_.clear();
        stopping_ = true;
        hooks_.give_up();
        changed();
    }
}

void TwoStages::wait_for_second(std::size_t left) {
    Lock hold = lock();
    changed_.wait(hold, [&] { return rests_.size() + (second_busy_ ? 1 : 0) <= left; });
}

TwoStages::Lock TwoStages::idle() {
    refuse_own_threads();
    Lock hold = lock();
    wait(hold,
         [&] { return !hooks_.has_job() && !first_busy_ && rests_.empty() && !second_busy_; });
    rethrow();
    return hold;
}

void TwoStages::stop() {
    {
        const Lock hold = lock();
        stopping_ = true;
        hooks_.give_up();
        changed();
    }
    if (first_.joinable()) first_.join();
    if (second_.joinable()) second_.join();
}

void TwoStages::fail(std::exception_ptr failure) {
    const Lock hold = lock();
    failure_ = std::move(failure);
    changed();
}

void TwoStages::refuse_own_threads() const {
    if (std::find(own_.begin(), own_.end(), std::this_thread::get_id()) == own_.end()) return;
    throw Error("a callback must not wait for the filter that calls it");
}

}  // namespace dynamic_filter
