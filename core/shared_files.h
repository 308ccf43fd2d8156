// Files that come with the program and are found when they are needed: examples, and the engine of
// exported pages.
#pragma once

#include <filesystem>

namespace cascade {

/// The path of a file or folder that comes with the program. The file is beside the program or
/// libcascade.so, as in a build tree, or in share/cascade below the prefix of the installation. The
/// path is empty if there is no such file.
std::filesystem::path shared_file(const std::filesystem::path& name);

}  // namespace cascade
