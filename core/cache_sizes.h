// How much the processor's caches hold.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace cascade {

/// Where Linux describes the caches of the first processor (cacheinfo in sysfs).
inline constexpr const char* described_caches = "/sys/devices/system/cpu/cpu0/cache";

/// A cache of data as one processor sees it.
struct CacheLevel {
    int number = 1;  ///< 1 is the first level.
    std::int64_t bytes = 0;
    std::int64_t cores = 1;  ///< Processors that share it, at least 1.

    friend bool operator==(const CacheLevel&, const CacheLevel&) = default;
};

/// The caches of data, nearest first, that a folder such as `described_caches` describes; none
/// where it describes none. What it says of a cache that cannot be, such as a size of no bytes, is
/// passed over.
std::vector<CacheLevel> cache_levels(const std::filesystem::path& folder = described_caches);

/// Bytes of each cache that one thread may take for itself where all that share it are at work.
struct CacheSizes {
    std::int64_t second = std::int64_t{1} << 20;
    std::int64_t third = std::int64_t{4} << 20;  ///< At least `second`.

    /// By `cache_levels`; those above for what they do not say.
    static CacheSizes described_in(const std::filesystem::path& folder);
    /// Those of this machine, read once.
    static const CacheSizes& here();
};

}  // namespace cascade
