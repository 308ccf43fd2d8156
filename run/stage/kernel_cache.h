// Where compiled kernels are kept.
#pragma once

#include <filesystem>

namespace cascade {

/// Where compiled kernels are kept: the folder that the environment variable CASCADE_KERNEL_CACHE
/// names (none if it is set and empty), else `cascade/kernels` in XDG_CACHE_HOME, else in
/// ~/.cache (XDG Base Directory Specification 0.8). Empty: nowhere, as in a home of another user.
std::filesystem::path usual_kernel_cache();

}  // namespace cascade
