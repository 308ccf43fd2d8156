// Recognises a start by mpiexec, and loads the module that uses MPI.
//
// The module is built if an MPI library is installed. It is loaded only if the program was started
// by a launcher.
#pragma once

#include "core/result.h"
#include "ranks/messenger.h"

#include <optional>
#include <string>

namespace cascade {

/// The number of ranks according to the environment that a launcher of Open MPI or MPICH sets.
/// Empty if no launcher has started this process.
std::optional<int> launched_ranks();
/// The number of this rank according to that environment; 0 without a launcher.
int launched_rank();
/// The number of ranks of this run that are on this machine; at least 1.
int ranks_on_this_machine();

/// The messenger of this process. The first call loads the module and initialises MPI. Fails if
/// this build has no module, if MPI is not installed, or if its number of ranks differs from that
/// of the launcher.
Result<Messenger*> connect_ranks();

/// The name of the MPI library for which the module was built: "Open MPI" or "MPICH". Fails if this
/// build has no module.
Result<std::string> mpi_of_this_build();

}  // namespace cascade
