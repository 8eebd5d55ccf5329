// SPDX-License-Identifier: MIT
#include "run/mpi/plugin.hpp"

#include <mpi.h>

#include <cstdlib>

#include "run/mpi/mpi_workers.hpp"

namespace {

/// Without its own starter Open MPI would make each process the only one of a run of its own, and
/// all of them would write the same output. So would a starter of another MPI.
bool is_started_by_open_mpi() {
    return std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMIX_RANK");
}

}  // namespace

extern "C" const char* dynamicfilter_mpi_version() { return DYNAMIC_FILTER_VERSION; }

extern "C" dynamic_filter::app::Workers* dynamicfilter_mpi_make(const char** fault) {
    int is_begun = 0;
    MPI_Initialized(&is_begun);
    if (is_begun) {
        *fault = "MPI has been started before in this process";
        return nullptr;
    }
    if (!is_started_by_open_mpi()) {
        *fault =
            "Open MPI did not start this process; start it by `mpirun -n 8 dynamicfilter run ... "
            "--mpi` with the mpirun of Open MPI (package openmpi-bin), or by `srun --mpi=pmix`";
        return nullptr;
    }
    int threads = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &threads);
    if (threads < MPI_THREAD_SERIALIZED) {
        MPI_Finalize();
        *fault = "this Open MPI was built without threads (MPI_THREAD_SERIALIZED)";
        return nullptr;
    }
    return new dynamic_filter::app::mpi::MpiWorkers;
}
