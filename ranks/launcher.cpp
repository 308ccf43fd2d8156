// Loads the module that uses MPI.
#include "ranks/launcher.h"

#include "core/version.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace cascade {
namespace {

[[maybe_unused]] constexpr const char* what_to_install =
    "install libopenmpi-dev and openmpi-bin, and build Cascade again";

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

Result<Messenger*> load_messenger() {
#ifdef CASCADE_MPI_MODULE
    // MPI libraries load plug-ins, which look for the symbols of the library among the global
    // symbols.
    void* const module = ::dlopen(CASCADE_MPI_MODULE, RTLD_NOW | RTLD_GLOBAL);
    if (module == nullptr) {
        const char* const reason = ::dlerror();
        return failure(fmt::format("MPI could not be loaded: {}",
                                   reason ? reason : "unknown reason"),
                       what_to_install);
    }
    const auto entry = reinterpret_cast<MessengerEntry*>(::dlsym(module, messenger_symbol));
    Messenger* const messenger = entry ? entry(std::string(version()).c_str()) : nullptr;
    if (messenger != nullptr) return messenger;
    return failure(fmt::format("{} belongs to another build than this program", CASCADE_MPI_MODULE),
                   "install both again");
#else
    return failure("this build has no MPI", what_to_install);
#endif
}

}  // namespace

std::optional<int> launched_ranks() {
    return number_in(std::array{"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"});
}

int launched_rank() {
    return number_in(std::array{"OMPI_COMM_WORLD_RANK", "PMI_RANK"}).value_or(0);
}

int ranks_on_this_machine() {
    const std::array names = {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS"};
    return std::max(number_in(names).value_or(1), 1);
}

Result<Messenger*> connect_ranks() {
    static const Result<Messenger*> loaded = load_messenger();
    if (!loaded) return loaded;
    const int launched = launched_ranks().value_or(1);
    if ((*loaded)->count() == launched) return loaded;
    return failure(fmt::format("the launcher has started {} ranks, but {} finds {}", launched,
                               mpi_of_this_build().value_or("MPI"), (*loaded)->count()),
                   fmt::format("use the mpiexec of {}, for which Cascade was built",
                               mpi_of_this_build().value_or("MPI")));
}

Result<std::string> mpi_of_this_build() {
#ifdef CASCADE_MPI_NAME
    return CASCADE_MPI_NAME;
#else
    return failure("this build has no MPI", what_to_install);
#endif
}

}  // namespace cascade
