// SPDX-License-Identifier: MIT
#include "dynamic_filter/parallel.hpp"

#include <algorithm>

#ifdef DYNAMIC_FILTER_STD_THREADS  // the tsan preset, which needs locks that TSan can see
#include <exception>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>
#else
#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#endif

namespace dynamic_filter {

#ifdef DYNAMIC_FILTER_STD_THREADS

namespace {
thread_local int thread_limit = 0;
}

int available_threads() { return std::max(1U, std::thread::hardware_concurrency()); }

int current_threads() { return thread_limit > 0 ? thread_limit : available_threads(); }

void with_threads(int threads, const std::function<void()>& work) {
    struct Restore {
        int before;
        ~Restore() { thread_limit = before; }
    } const restore{std::exchange(thread_limit, threads)};
    work();
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    const auto limit = static_cast<std::size_t>(current_threads());
    const std::size_t chunks =
        std::clamp<std::size_t>(count / std::max<std::size_t>(1, grain), 1, limit);
    std::mutex mutex;
    std::exception_ptr failure;
    {
        std::vector<std::jthread> workers;
        for (std::size_t c = 0; c < chunks; ++c) {
            workers.emplace_back([&, c] {
                try {
                    const std::size_t begin = count * c / chunks, end = count * (c + 1) / chunks;
                    if (begin < end) body(begin, end);
                } catch (...) {
                    const std::lock_guard lock(mutex);
                    if (!failure) failure = std::current_exception();
                }
            });
        }
    }
    if (failure) std::rethrow_exception(failure);
}

#else

int available_threads() { return tbb::info::default_concurrency(); }

int current_threads() { return tbb::this_task_arena::max_concurrency(); }

void with_threads(int threads, const std::function<void()>& work) {
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute(work);
}

void parallel_for(std::size_t count, std::size_t grain,
                  const std::function<void(std::size_t, std::size_t)>& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, std::max<std::size_t>(1, grain)),
                      [&](const auto& range) { body(range.begin(), range.end()); });
}

#endif

}  // namespace dynamic_filter
