// How much the processor's caches hold.
#pragma once

#include <cstdint>
#include <filesystem>

namespace cascade {

/// Bytes of each cache that one thread may take for itself where all that share it are at work.
struct CacheSizes {
    std::int64_t second = std::int64_t{1} << 20;
    std::int64_t third = std::int64_t{4} << 20;  ///< At least `second`.

    /// Reads them where Linux describes the caches of a processor (cacheinfo in sysfs); those above for
    /// what it does not say.
    static CacheSizes described_in(const std::filesystem::path& folder);
    /// Those of this machine, read once.
    static const CacheSizes& here();
};

}  // namespace cascade
