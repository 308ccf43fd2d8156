// What the machine offers: in a tab one thread, memory without pages, no file system, and
// arithmetic that keeps denormal numbers.
#include "core/cache_sizes.h"
#include "core/check.h"
#include "core/enough_memory.h"
#include "core/floating_point.h"
#include "core/parallel.h"
#include "core/plane.h"
#include "core/transform_planner.h"
#include "run/domain/free_memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace cascade {

RowRange split_rows(std::int64_t rows, int index, int count) {
    CHECK(rows >= 0 && 0 <= index && index < count, "a part of the rows that exists");
    const std::int64_t each = rows / count;
    const std::int64_t rest = rows % count;  // The first `rest` parts have one row more.
    const std::int64_t begin = index * each + std::min<std::int64_t>(index, rest);
    return {begin, begin + each + (index < rest ? 1 : 0)};
}

int hardware_threads() { return 1; }

struct Team::State {};

Team::Team(int) {}
Team::~Team() = default;
int Team::size() const { return 1; }
void Team::run(const std::function<void(int index)>& work) { work(0); }
void Team::run(const std::function<void(int index)>& work, int) { work(0); }
void Team::barrier() {}

TransformPlanner::TransformPlanner() = default;
TransformPlanner::~TransformPlanner() = default;

FlushDenormals::FlushDenormals() : saved_(0) {}
FlushDenormals::~FlushDenormals() = default;
void keep_denormals() {}
bool keeps_denormals() { return true; }

std::vector<CacheLevel> cache_levels(const std::filesystem::path&) { return {}; }
CacheSizes CacheSizes::described_in(const std::filesystem::path&) { return {}; }
const CacheSizes& CacheSizes::here() {
    static const CacheSizes sizes;
    return sizes;
}

void* allocate_plane(std::size_t bytes) {
    constexpr std::size_t cache_line = 64;
    const std::size_t rounded = (bytes + cache_line - 1) / cache_line * cache_line;
    void* const plane = std::aligned_alloc(cache_line, std::max(rounded, cache_line));
    if (plane == nullptr) lack_memory();
    return std::memset(plane, 0, rounded);
}

void free_plane(void* plane) { std::free(plane); }

/// Addresses have 32 bits, and browsers give a module at most 4 GiB.
std::uint64_t available_memory(const std::filesystem::path&) { return std::uint64_t{3} << 30; }

}  // namespace cascade
