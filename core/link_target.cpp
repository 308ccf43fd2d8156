// Links are followed one by one, since the last link may lead to a file that does not exist.
#include "core/link_target.h"

#include <system_error>

namespace cascade {

namespace fs = std::filesystem;

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

fs::path behind_links(const fs::path& path) {
    fs::path target = path;
    std::error_code error;
    for (int link = 0; link < 40 && fs::is_symlink(target, error); ++link) {
        const fs::path next = fs::read_symlink(target, error);
        if (error) break;
        target = folder_of(target) / next;  // An absolute `next` replaces the folder.
    }
    return target;
}

}  // namespace cascade
