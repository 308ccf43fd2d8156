// Where a file of a given name is really written (internal to core/).
#pragma once

#include <filesystem>

namespace cascade {

/// The folder of a file; "." for a name alone.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// The target of a write to `path`: follows symbolic links, including one to a file that does not
/// exist yet. A cycle of links is left for the system to report.
std::filesystem::path behind_links(const std::filesystem::path& path);

}  // namespace cascade
