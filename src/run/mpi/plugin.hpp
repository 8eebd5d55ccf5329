// SPDX-License-Identifier: MIT
/// What the command and its plug-in for MPI know of each other.
#pragma once

namespace dynamic_filter::app {

class Workers;

namespace mpi {

/// Version of the plug-in, which must be that of the command, as they share classes.
using Version = const char*();
/// The processes that mpirun started; the caller owns them. On a fault: nullptr, and a text that
/// stays valid.
using Make = Workers*(const char** fault);

constexpr const char* kVersion = "dynamicfilter_mpi_version";  ///< name of that function
constexpr const char* kMake = "dynamicfilter_mpi_make";        ///< name of that function

}  // namespace mpi

}  // namespace dynamic_filter::app
