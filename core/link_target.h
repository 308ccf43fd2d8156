// Finds where a file of a given name is really written (internal to core/).
#pragma once

#include <filesystem>

namespace cascade {

/// The folder of a file; "." for a name alone.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// The target of a write to `path`. Follows symbolic links, including one to a missing file, and
/// leaves cycles of links for the system to report.
std::filesystem::path behind_links(const std::filesystem::path& path);

}  // namespace cascade
