// Checks who owns the nearest existing folder.
#include "core/own_folder.h"

#include <sys/stat.h>
#include <unistd.h>

namespace cascade {

bool may_keep_files_in(const std::filesystem::path& folder) {
    struct stat status {};
    std::filesystem::path nearest = folder;
    while (::stat(nearest.c_str(), &status) != 0) {
        if (!nearest.has_relative_path()) return false;
        nearest = nearest.parent_path();
    }
    return status.st_uid == ::geteuid() || status.st_uid == 0;
}

}  // namespace cascade
