// SPDX-License-Identifier: MIT
/// The processes that work on one run together, and how they share out its tasks.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

namespace dynamic_filter::app {

/// One process of a run that several processes may share. All of them must make the same calls of
/// all_done in the same order. If one process fails, all_done() returns false in all others, so
/// that none waits for it. A process fails if an exception destroys the object, or if the object is
/// destroyed before the others call all_done() again. The destructor waits for the destructors of
/// the others. Keep the object until all output is written, because mpirun kills every process as
/// soon as one of them ends with an exit code other than 0.
class Workers {
public:
    Workers() = default;
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    virtual ~Workers() = default;

    virtual int rank() const = 0;  ///< 0 to size() - 1; 0 is the one that merges
    virtual int size() const = 0;  ///< number of processes

    /// The next task that nobody has taken yet, of `count` tasks in the order of their numbers.
    /// Empty: none is left, or a process has said all_done(false). May be called by any thread.
    virtual std::optional<std::size_t> next(std::size_t count) = 0;

    /// Waits until every process is here. False on all of them if any says false, because it failed
    /// or was interrupted. Afterwards next() begins again at task 0. Called by one thread, while no
    /// other is in next().
    virtual bool all_done(bool well) = 0;
};

/// This process alone.
std::unique_ptr<Workers> alone();

/// The processes that mpirun started. Loads the plug-in libdynamicfilter_mpi.so, which is the only
/// part that needs MPI. Throws ConfigError, with what to install or how to start, if there is no
/// plug-in, if it is of another version, or if mpirun did not start this process. To be called at
/// most once in a process.
std::unique_ptr<Workers> mpi_workers();

}  // namespace dynamic_filter::app
