// Pictures and saved runs store the path of the folder of their script. Finds this folder when they
// are read, and the path to store when they are written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cascade {

/// Returns a path as pictures and saved runs store it. A path is stored unchanged only if it is
/// relative and does not leave its folder, because pictures and saved runs may be published.
/// Otherwise only the last component of the path is stored.
std::string portable_path(const std::string& path);

/// The folder for files that the script of a saved run names. The current folder and then the
/// folder that contains `saved` are searched for a file `name` that still has this text. The result
/// is the folder of this file or, if there is none, `saved` itself. A folder named in a saved run
/// is not trusted, because that would grant the right to read files there.
std::filesystem::path find_script_folder(const std::filesystem::path& saved,
                                         const std::string& name, const std::string& text);

/// The first file `name` in the two folders that find_script_folder() searches. Empty if there is
/// none, or if one of these files has this text.
std::optional<std::filesystem::path> find_edited_script(const std::filesystem::path& saved,
                                                        const std::string& name,
                                                        const std::string& text);

}  // namespace cascade
