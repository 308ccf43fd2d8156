// Whose folders a user's own files may go to.
#pragma once

#include <filesystem>

namespace cascade {

/// May folders be made at this path without leaving them to the wrong user? So if the nearest
/// folder that is there belongs to the effective user or to the system. With sudo HOME is often
/// still that of another user, who could not write to what is made there.
bool may_keep_files_in(const std::filesystem::path& folder);

}  // namespace cascade
