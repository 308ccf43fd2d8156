// Finds the folder of compiled kernels.
#pragma once

#include <filesystem>

namespace cascade {

/// The folder of compiled kernels: the one that the environment variable CASCADE_KERNEL_CACHE names
/// (none if it is set and empty), else `cascade/kernels` in XDG_CACHE_HOME, else in ~/.cache (XDG
/// Base Directory Specification 0.8). Empty if there is none, for example in the home of another
/// user.
std::filesystem::path usual_kernel_cache();

}  // namespace cascade
