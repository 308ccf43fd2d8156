// Loads the module that uses HDF5.
#include "picture/hdf5.h"

#include "core/version.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade {

namespace {

constexpr const char* without_hdf5 = "use --series NAME.npy, which needs no HDF5";

Result<Hdf5Opener*> load_opener() {
#ifdef CASCADE_HDF5_MODULE
    // The module is never unloaded, because the HDF5 library closes its files when the program
    // ends.
    void* const module = ::dlopen(CASCADE_HDF5_MODULE, RTLD_LAZY | RTLD_LOCAL);
    if (!module) {
        const char* reason = ::dlerror();
        return failure(fmt::format("HDF5 could not be loaded: {}",
                                   reason ? reason : "unknown reason"),
                       without_hdf5);
    }
    const auto entry = reinterpret_cast<Hdf5OpenerEntry*>(::dlsym(module, hdf5_opener_symbol));
    Hdf5Opener* const opener = entry ? entry(version()) : nullptr;
    if (opener) return opener;
    return failure(fmt::format("{} belongs to another build of this program", CASCADE_HDF5_MODULE),
                   "install this program and its modules again");
#else
    return failure("this build has no HDF5",
                   fmt::format("install libhdf5-dev and build Cascade again; {}", without_hdf5));
#endif
}

const Result<Hdf5Opener*>& hdf5_opener() {
    static const Result<Hdf5Opener*> loaded = load_opener();
    return loaded;
}

Failure about_file(const std::filesystem::path& path, const Failure& reason) {
    return {fmt::format("cannot write '{}': {}", path.string(), reason.message), reason.hint};
}

}  // namespace

Result<void> check_hdf5(const std::filesystem::path& path) {
    if (hdf5_opener()) return {};
    return tl::unexpected(about_file(path, hdf5_opener().error()));
}

Result<std::unique_ptr<Hdf5File>> begin_hdf5(const std::filesystem::path& path,
                                             const Hdf5Layout& layout,
                                             const std::filesystem::path& shown) {
    if (auto can = check_hdf5(shown); !can) return tl::unexpected(can.error());
    auto file = (*hdf5_opener())(path, layout);
    if (!file) return tl::unexpected(about_file(shown, file.error()));
    return file;
}

bool is_hdf5_name(std::string_view name) {
    constexpr std::array<std::string_view, 12> taken = {"time",   "t",         "step",   "stage",
                                                        "x",      "y",         "z",      "cell",
                                                        "script", "overrides", "stages", "."};
    return !name.empty() && name.find('/') == std::string_view::npos &&
           std::find(taken.begin(), taken.end(), name) == taken.end();
}

}  // namespace cascade
