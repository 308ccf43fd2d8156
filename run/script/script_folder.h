// Where the files of a script lie that comes out of a picture or a saved run, and what these say of
// it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace cascade {

/// A path as it is written into pictures and saved runs, for anybody to see: as it is where it is
/// relative and leads down only, else its last part.
std::string portable_path(const std::string& path);

/// The folder of the script of a run that was saved in `saved`: where a file of that name has that
/// very text still, in the current folder or in the one that `saved` lies in; otherwise `saved`
/// itself. A folder that a saved run names is not trusted: it would grant the right to read there.
std::filesystem::path find_script_folder(const std::filesystem::path& saved,
                                         const std::string& name, const std::string& text);

/// Where one looks for it, is there a file of that name, but none with that text? The first of
/// such.
std::optional<std::filesystem::path> find_edited_script(const std::filesystem::path& saved,
                                                        const std::string& name,
                                                        const std::string& text);

}  // namespace cascade
