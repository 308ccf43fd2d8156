// The folder of the files of a script from a picture or a saved run, and the paths stored in these.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cascade {

/// A path as it is stored in pictures and saved runs, which may be published: unchanged if it is
/// relative and leads only down, else its last component.
std::string portable_path(const std::string& path);

/// The folder of the script of a run saved in `saved`: the current folder or the one that contains
/// `saved`, if a file of that name there still has that text; else `saved` itself. A folder named
/// by a saved run is not trusted, since it would grant the right to read there.
std::filesystem::path find_script_folder(const std::filesystem::path& saved,
                                         const std::string& name, const std::string& text);

/// The first file of that name in these folders, if none of them has that text.
std::optional<std::filesystem::path> find_edited_script(const std::filesystem::path& saved,
                                                        const std::string& name,
                                                        const std::string& text);

}  // namespace cascade
