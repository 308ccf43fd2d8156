// Finds the folder of a script when a picture or saved run with this script is read, and the path
// to store when a picture or saved run is written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cascade {

/// Returns a path as pictures and saved runs store it. A path is stored unchanged only if it is
/// relative and does not leave its folder, because pictures and saved runs may be published.
/// Otherwise only the last component of the path is stored.
std::string portable_path(const std::string& path);

/// Finds the folder of the files that the script of a saved run names. Looks for a file `name` that
/// still has the text `text`, first in the current folder and then in the folder that contains
/// `saved`. Returns the folder of this file or, if there is no such file, `saved` itself. The saved
/// run may name a folder, but that folder is not trusted, because a stranger could then grant the
/// right to read files there.
std::filesystem::path find_script_folder(const std::filesystem::path& saved,
                                         const std::string& name, const std::string& text);

/// Returns the first file `name` in the two folders that find_script_folder() searches. Returns an
/// empty optional if there is no such file, or if one of these files still has the text `text`.
std::optional<std::filesystem::path> find_edited_script(const std::filesystem::path& saved,
                                                        const std::string& name,
                                                        const std::string& text);

}  // namespace cascade
