// How much memory is free: on the machine, and in the control group of this process, as containers
// have one.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cascade {

/// Bytes that the system can give without swapping: what Linux calls MemAvailable or, if that is
/// less, what is left below the limit of a control group (version 1 or 2) of this process or of one
/// above it. The group's file cache counts as free, because it is given back. 0 if the system does
/// not say. `root` is the folder of /proc and /sys.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

}  // namespace cascade
