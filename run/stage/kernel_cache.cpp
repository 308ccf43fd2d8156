// Follows the XDG Base Directory Specification unless CASCADE_KERNEL_CACHE is set.
#include "run/stage/kernel_cache.h"

#include "core/own_folder.h"

#include <cstdlib>

namespace cascade {

std::filesystem::path usual_kernel_cache() {
    const auto variable = [](const char* name) { return std::getenv(name); };
    if (const char* folder = variable("CASCADE_KERNEL_CACHE")) return folder;
    const auto in_folder = [](const std::filesystem::path& folder) {
        // The specification says that relative paths are ignored.
        const std::filesystem::path kernels = folder / "cascade" / "kernels";
        return folder.is_absolute() && may_keep_files_in(kernels) ? kernels
                                                                  : std::filesystem::path();
    };
    const char* caches = variable("XDG_CACHE_HOME");
    if (caches && *caches) return in_folder(caches);
    const char* home = variable("HOME");
    return home && *home ? in_folder(std::filesystem::path(home) / ".cache")
                         : std::filesystem::path();
}

}  // namespace cascade
