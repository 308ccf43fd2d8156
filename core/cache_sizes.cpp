// The sizes of the caches, read from sysfs. hwloc offers them too, but needs at least 15 ms, longer
// than a whole small run. sysconf() is wrong on some processors.
#include "core/cache_sizes.h"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

namespace cascade {
namespace {

namespace fs = std::filesystem;

/// The first word of a file; empty if there is no such file.
std::string word_in(const fs::path& path) {
    std::ifstream file(path);
    std::string word;
    file >> word;
    return word;
}

/// Reads a number of bytes such as "1024K", "32M" or "1G". Returns 0 for other texts.
std::int64_t bytes_of(const std::string& size) {
    std::istringstream text(size);
    std::int64_t number = 0;
    char unit = 0;
    if (!(text >> number) || number <= 0 || number > (std::int64_t{1} << 30)) return 0;
    text >> unit;
    switch (unit) {
        case 0: return number;
        case 'K': return number << 10;
        case 'M': return number << 20;
        case 'G': return number << 30;
        default: return 0;
    }
}

/// The number of integers in a list such as "0-3,8-11"; at least 1.
std::int64_t count_of(const std::string& list) {
    std::istringstream text(list);
    std::int64_t count = 0, first = 0, last = 0;
    while (text >> first) {
        last = first;
        if (text.peek() == '-' && !(text.ignore() >> last)) break;
        count += std::clamp<std::int64_t>(last - first + 1, 0, 1 << 20);
        if (text.get() != ',') break;
    }
    return std::max<std::int64_t>(count, 1);
}

}  // namespace

std::vector<CacheLevel> cache_levels(const fs::path& folder) {
    constexpr int most_caches = 16, most_levels = 9;
    constexpr std::int64_t least = 4096;
    std::vector<CacheLevel> levels;
    for (int index = 0; index < most_caches; ++index) {
        const fs::path cache = folder / ("index" + std::to_string(index));
        const std::string level = word_in(cache / "level");
        if (level.empty()) break;
        const int number = level.size() == 1 ? level[0] - '0' : 0;
        const std::int64_t bytes = bytes_of(word_in(cache / "size"));
        if (word_in(cache / "type") == "Instruction" || number < 1 || number > most_levels ||
            bytes < least) {
            continue;
        }
        levels.push_back({number, bytes, count_of(word_in(cache / "shared_cpu_list"))});
    }
    std::stable_sort(levels.begin(), levels.end(),
                     [](const CacheLevel& a, const CacheLevel& b) { return a.number < b.number; });
    return levels;
}

CacheSizes CacheSizes::described_in(const fs::path& folder) {
    constexpr std::int64_t least = 65536;
    CacheSizes sizes;
    for (const CacheLevel& level : cache_levels(folder)) {
        const std::int64_t share = level.bytes / level.cores;
        if (share < least) continue;
        if (level.number == 2) sizes.second = share;
        if (level.number == 3) sizes.third = share;
    }
    sizes.third = std::max(sizes.third, sizes.second);
    return sizes;
}

const CacheSizes& CacheSizes::here() {
    static const CacheSizes sizes = described_in(described_caches);
    return sizes;
}

}  // namespace cascade
