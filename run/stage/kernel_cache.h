// Finds the folder of compiled kernels.
#pragma once

#include <filesystem>

namespace cascade {

/// The folder of compiled kernels. If the environment variable CASCADE_KERNEL_CACHE is set, it
/// names the folder, and an empty value means none. Otherwise the folder is `cascade/kernels` in
/// XDG_CACHE_HOME or else in ~/.cache (XDG Base Directory Specification 0.8). Empty if there is no
/// such folder, for example in the home of another user.
std::filesystem::path usual_kernel_cache();

}  // namespace cascade
