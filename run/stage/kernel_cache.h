// Finds the folder of compiled kernels.
#pragma once

#include <filesystem>

namespace cascade {

/// Returns the folder of compiled kernels. If the environment variable CASCADE_KERNEL_CACHE is set,
/// it names the folder, and an empty value means that there is none. If it is not set, the folder
/// is `cascade/kernels` in XDG_CACHE_HOME or, if that is not set, in ~/.cache (XDG Base Directory
/// Specification 0.8). Returns an empty path if there is no such folder, for example in the home of
/// another user.
std::filesystem::path usual_kernel_cache();

}  // namespace cascade
