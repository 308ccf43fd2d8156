// Reads the files that a script, a model, a picture or a saved run may name.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The files that `--allow-read` grants beyond the script's folder.
struct ReadAccess {
    bool everything = false;
    std::vector<std::filesystem::path> folders;

    friend bool operator==(const ReadAccess&, const ReadAccess&) = default;
};

/// Reads files that other files name. All such reads go through this class, which never hands out a
/// path, so every file that is opened has been checked.
class GrantedFiles {
public:
    /// Names are relative to `folder`, and every file below it may be read. Messages call the
    /// folder "the OWNER's folder".
    GrantedFiles(std::filesystem::path folder, ReadAccess access,
                 std::string_view owner = "script");

    /// Grants nothing.
    static GrantedFiles none();

    /// The same grants, but names are relative to the folder of `file`. `file` itself is relative
    /// to the folder of this object. Serves models, which name their files relative to their own
    /// folder.
    GrantedFiles beside(const std::string& file) const;

    /// The content of a regular file. A relative name is looked up in the folder, then in each
    /// folder of `--allow-read`, by the whole name and by its last part. Symbolic links are
    /// followed. A file outside all granted folders is refused with the same message whether it
    /// exists or not. Also fails for folders, pipes, devices, unreadable files, and files of more
    /// than `largest` bytes.
    Result<std::string> read(const std::string& name, std::uint64_t largest) const;

private:
    GrantedFiles() = default;
    Result<std::string> read_at(const std::filesystem::path& path, const std::string& name,
                                std::uint64_t largest, bool& is_missing) const;

    std::filesystem::path base_;  ///< Names are relative to this folder.
    /// The granted folders. The owner's folder comes first.
    std::vector<std::filesystem::path> roots_;
    bool everything_ = false;
    std::string owner_;
};

}  // namespace cascade
