// Finds the free memory of the machine and of the control group of this process. Containers limit
// memory by control groups.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cascade {

/// Returns the number of bytes that the system can give without swapping, or 0 if it is unknown.
/// This is Linux's MemAvailable or, if that is less, the memory left below the limit of a control
/// group (version 1 or 2). The limits of this process's group and of all groups above it are
/// considered. A group's file cache counts as free, because the system releases it when needed.
/// `root` is the folder that contains /proc and /sys.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

}  // namespace cascade
