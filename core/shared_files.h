// Files that come with the program and are found when they are needed: examples, and the engine of
// exported pages.
#pragma once

#include <filesystem>

namespace cascade {

/// The path of a file or folder that comes with the program. It is in the folder of the program or
/// of libcascade.so, as in a build tree, or in share/cascade of the prefix in which they are
/// installed. The path is empty if there is no such file.
std::filesystem::path shared_file(const std::filesystem::path& name);

}  // namespace cascade
