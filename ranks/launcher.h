// Recognises a start by mpiexec, and loads the module of an MPI library.
//
// A module is built for each MPI library that is installed. One of them is loaded if the program
// was started by a launcher.
#pragma once

#include "core/result.h"
#include "ranks/messenger.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

/// The MPI libraries that have a module. All ranks of a run use the same one: mpiexec of a library
/// only works for programs that use that library.
enum class MpiLibrary : std::uint8_t { open_mpi, mpich };

/// Returns "Open MPI" or "MPICH".
std::string_view name_of(MpiLibrary library);
/// The packages of Debian that provide the library, such as "libmpich-dev and mpich".
std::string_view packages_of(MpiLibrary library);
/// The library that the option `--mpi` names: "openmpi" or "mpich". Empty for other texts.
std::optional<MpiLibrary> mpi_library_named(std::string_view text);

/// The number of ranks according to the environment that a launcher of Open MPI or MPICH sets.
/// Empty if no launcher has started this process.
std::optional<int> launched_ranks();
/// The number of this rank according to the launcher's environment; 0 without a launcher.
int launched_rank();
/// The number of ranks of this run that are on this machine; at least 1.
int ranks_on_this_machine();

/// Chooses the `wanted` library or, if it is empty, the library of the launcher that has started
/// this process. Without a launcher, chooses the first library that has a module. Fails if this
/// build has no module for the chosen library.
Result<MpiLibrary> choose_mpi(std::optional<MpiLibrary> wanted);

/// The name of this machine, or "?" if it is unknown.
std::string this_machine();

/// The messenger of this process. The first call loads the module of the library and initialises
/// MPI. Fails if this build has no such module, if the library is not installed, or if MPI's number
/// of ranks differs from the launcher's.
Result<Messenger*> connect_ranks(MpiLibrary library);

}  // namespace cascade
