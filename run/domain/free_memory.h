// The free memory of the machine and of this process's control group, which containers have.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cascade {

/// Bytes that the system can give without swapping: Linux's MemAvailable or, if that is less, the
/// rest below the limit of a control group (version 1 or 2) of this process or of one above it. The
/// group's file cache counts as free, because it is given back. 0 if the system does not say.
/// `root` is the folder of /proc and /sys.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

}  // namespace cascade
