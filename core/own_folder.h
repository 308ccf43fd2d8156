// Checks whether a user's files may be created in a folder.
#pragma once

#include <filesystem>

namespace cascade {

/// Whether folders may be created at this path: true if the nearest existing folder belongs to the
/// effective user or to root. Under sudo, HOME often still belongs to another user, who could not
/// write to folders that root creates there.
bool may_keep_files_in(const std::filesystem::path& folder);

}  // namespace cascade
