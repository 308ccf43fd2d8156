// Opens files named by other files, but only below a given folder.
#pragma once

#include "core/descriptor.h"

#include <filesystem>

namespace cascade {

/// The ways to resolve a path: by the kernel (openat2 of Linux 5.6) if possible and otherwise part
/// by part, or always part by part.
enum class PathWalk { kernel_or_parts, parts };

/// Opens `file` for reading below the open folder. Returns a descriptor or the negative error
/// number. The path `file` is relative, has no "..", and no part of it may be a symbolic link
/// (-ELOOP). The opened file is below the folder even if names change meanwhile. Does not wait for
/// the other end of a pipe.
int open_below(const Descriptor& folder, const std::filesystem::path& file,
               PathWalk walk = PathWalk::kernel_or_parts);

}  // namespace cascade
