// Loads the modules that use MPI.
#include "ranks/launcher.h"

#include "core/version.h"

#include <dlfcn.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>

namespace cascade {
namespace {

#ifndef CASCADE_OPENMPI_MODULE
#define CASCADE_OPENMPI_MODULE nullptr
#endif
#ifndef CASCADE_MPICH_MODULE
#define CASCADE_MPICH_MODULE nullptr
#endif

struct LibraryEntry {
    MpiLibrary library;
    std::string_view name, option, packages;
    const char* module;  ///< The module's file. Null if it is not built.
    const char* mark;    ///< A variable in the environment of ranks that its launcher has started.
};
// Launchers of Open MPI set variables of MPICH, too, if Slurm starts them.
constexpr std::array entries = {
    LibraryEntry{MpiLibrary::open_mpi, "Open MPI", "openmpi", "libopenmpi-dev and openmpi-bin",
                 CASCADE_OPENMPI_MODULE, "OMPI_COMM_WORLD_SIZE"},
    LibraryEntry{MpiLibrary::mpich, "MPICH", "mpich", "libmpich-dev and mpich",
                 CASCADE_MPICH_MODULE, "PMI_SIZE"},
};

const LibraryEntry& entry_of(MpiLibrary library) {
    return entries[static_cast<std::size_t>(library)];
}

std::string what_to_install(MpiLibrary library) {
    return fmt::format("install {}, and build Cascade again", packages_of(library));
}

/// The value of the first of these environment variables that contains an integer of at least 0.
template <std::size_t count>
std::optional<int> number_in(const std::array<const char*, count>& names) {
    for (const char* const name : names) {
        const char* const text = std::getenv(name);
        if (text == nullptr) continue;
        const std::string_view digits = text;
        int number = 0;
        const auto [end, error] =
            std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error == std::errc() && end == digits.data() + digits.size() && number >= 0)
            return number;
    }
    return std::nullopt;
}

Result<Messenger*> load_messenger(const LibraryEntry& of) {
    // MPI libraries load plug-ins, which look for the symbols of the library among the global
    // symbols.
    void* const module = ::dlopen(of.module, RTLD_NOW | RTLD_GLOBAL);
    if (module == nullptr) {
        const char* const reason = ::dlerror();
        return failure(fmt::format("{} could not be loaded: {}", of.name,
                                   reason ? reason : "unknown reason"),
                       what_to_install(of.library));
    }
    const auto entry = reinterpret_cast<MessengerEntry*>(::dlsym(module, messenger_symbol));
    Messenger* const messenger = entry ? entry(std::string(version()).c_str()) : nullptr;
    if (messenger != nullptr) return messenger;
    return failure(fmt::format("{} belongs to another build than this program", of.module),
                   "install both again");
}

}  // namespace

std::string_view name_of(MpiLibrary library) { return entry_of(library).name; }

std::string_view packages_of(MpiLibrary library) { return entry_of(library).packages; }

std::optional<MpiLibrary> mpi_library_named(std::string_view text) {
    for (const LibraryEntry& each : entries) {
        if (each.option == text) return each.library;
    }
    return std::nullopt;
}

std::optional<int> launched_ranks() {
    return number_in(std::array{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
}

int launched_rank() {
    return number_in(std::array{"OMPI_COMM_WORLD_RANK", "PMI_RANK"}).value_or(0);
}

std::string this_machine() {
    std::array<char, 256> name{};
    return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "?";
}

int ranks_on_this_machine() {
    const std::array names = {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"};
    return std::max(number_in(names).value_or(1), 1);
}

Result<MpiLibrary> choose_mpi(std::optional<MpiLibrary> wanted) {
    if (wanted) {
        if (entry_of(*wanted).module != nullptr) return *wanted;
        return failure(fmt::format("this build has no {}", name_of(*wanted)),
                       what_to_install(*wanted));
    }
    const LibraryEntry* first = nullptr;
    for (const LibraryEntry& each : entries) {
        if (each.module == nullptr) continue;
        if (number_in(std::array{each.mark})) return each.library;
        if (first == nullptr) first = &each;
    }
    if (first != nullptr) return first->library;
    return failure("this build has no MPI", what_to_install(MpiLibrary::open_mpi));
}

Result<Messenger*> connect_ranks(MpiLibrary library) {
    const LibraryEntry& entry = entry_of(library);
    static const Result<Messenger*> loaded = load_messenger(entry);
    if (!loaded) return loaded;
    const int launched = launched_ranks().value_or(1);
    if ((*loaded)->count() == launched) return loaded;
    const LibraryEntry& other =
        entry_of(library == MpiLibrary::mpich ? MpiLibrary::open_mpi : MpiLibrary::mpich);
    return failure(fmt::format("the launcher has started {} ranks, but {} finds {}", launched,
                               entry.name, (*loaded)->count()),
                   fmt::format("use the mpiexec of {}, on Debian mpiexec.{}, or {}", entry.name,
                               entry.option,
                               other.module != nullptr ? fmt::format("--mpi {}", other.option)
                                                       : what_to_install(other.library)));
}

}  // namespace cascade
