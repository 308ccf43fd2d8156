// Which files a script, a model, a picture or a saved run may name, and the only way to their
// bytes.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// What `--allow-read` grants beyond the script's folder.
struct ReadAccess {
    bool everything = false;
    std::vector<std::filesystem::path> folders;

    friend bool operator==(const ReadAccess&, const ReadAccess&) = default;
};

/// Reads files by the names that other files give them. Nobody else opens such a name, and no path
/// leaves this class, so that nothing is opened that was not looked at.
class GrantedFiles {
public:
    /// Names are relative to `folder`, and what lies below it may be read. `owner` is whose folder
    /// it is, in messages: "script".
    GrantedFiles(std::filesystem::path folder, ReadAccess access,
                 std::string_view owner = "script");

    /// Nothing may be read.
    static GrantedFiles none();

    /// The same grants for names that are relative to the folder of `file`, itself such a name:
    /// those in a model are relative to the model.
    GrantedFiles beside(const std::string& file) const;

    /// All that a plain file holds. It is looked for in the folder, and if it is not there and
    /// `name` is relative, in the folders of `--allow-read`, by the name and by its last part.
    /// Symbolic links are followed; a file that lies, with them followed, below none of the folders
    /// is refused in the same words whether it exists or not. Fails too on folders, pipes and
    /// devices, on what cannot be read, and on more than `largest` bytes.
    Result<std::string> read(const std::string& name, std::uint64_t largest) const;

private:
    GrantedFiles() = default;
    Result<std::string> read_at(const std::filesystem::path& path, const std::string& name,
                                std::uint64_t largest, bool& is_missing) const;

    std::filesystem::path base_;                ///< Names are relative to it.
    std::vector<std::filesystem::path> roots_;  ///< The folder of the owner first.
    bool everything_ = false;
    std::string owner_;
};

}  // namespace cascade
