// The sizes of the processor's caches.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace cascade {

/// The folder in which Linux describes the caches of the first processor (cacheinfo in sysfs).
inline constexpr const char* described_caches = "/sys/devices/system/cpu/cpu0/cache";

/// A data cache that a processor has for itself or shares with others.
struct CacheLevel {
    int number = 1;  ///< 1 is the first level.
    std::int64_t bytes = 0;
    std::int64_t cores = 1;  ///< Number of processors that share the cache, at least 1.

    friend bool operator==(const CacheLevel&, const CacheLevel&) = default;
};

/// The data caches described by a folder such as `described_caches`, innermost first. Leaves out
/// caches with impossible values, such as a size of 0.
std::vector<CacheLevel> cache_levels(const std::filesystem::path& folder = described_caches);

/// The bytes that one thread may use of each cache while all processors that share the cache are
/// busy.
struct CacheSizes {
    std::int64_t second = std::int64_t{1} << 20;
    std::int64_t third = std::int64_t{4} << 20;  ///< Never less than `second`.

    /// The sizes that `cache_levels` finds. A missing level keeps the default above.
    static CacheSizes described_in(const std::filesystem::path& folder);
    /// The sizes of this machine's caches, read once.
    static const CacheSizes& here();
};

}  // namespace cascade
