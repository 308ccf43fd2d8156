// Which files a script may read: those below its own folder, and others only where the user says so.
#pragma once

#include "core/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace cascade {

/// What `--allow-read` grants beyond the script's folder.
struct ReadAccess {
    bool everything = false;
    std::vector<std::filesystem::path> folders;

    friend bool operator==(const ReadAccess&, const ReadAccess&) = default;
};

/// The path of a file that a script names, relative to `folder`, the script's own (or absolute).
/// Fails where the file, with symbolic links followed, lies neither below that folder nor below one
/// that `access` grants. The file need not exist.
Result<std::filesystem::path> readable_path(const std::filesystem::path& folder,
                                            const std::string& name, const ReadAccess& access);

}  // namespace cascade
