// How much memory there is to be had: of the machine, and of the control group that holds this
// process, as containers do.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cascade {

/// Bytes that the system would give without swapping: what Linux calls MemAvailable, or what is
/// left below the limit of a control group (version 1 or 2) of this process or one above it, if
/// that is less. What such a group holds of files counts as free, since it is given back. 0 where
/// the system does not say. `root` is where /proc and /sys are.
std::uint64_t available_memory(const std::filesystem::path& root = "/");

}  // namespace cascade
