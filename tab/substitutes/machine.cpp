// Functions of core/ that depend on the machine, for a browser's tab. A tab has one thread, memory
// without pages, no file system, and arithmetic with denormal numbers.
#include "core/cache_sizes.h"
#include "core/enough_memory.h"
#include "core/floating_point.h"
#include "core/parallel.h"
#include "core/plane.h"
#include "core/shared_plane.h"
#include "core/transform_planner.h"
#include "run/domain/free_memory.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace cascade {

int hardware_threads() { return 1; }

struct Team::State {};

Team::Team(int) {}
Team::~Team() = default;
int Team::size() const { return 1; }
void Team::run(const std::function<void(int index)>& work) { work(0); }
void Team::run(const std::function<void(int index)>& work, int) { work(0); }
void Team::barrier() {}
// Never called, because the only thread checks for requests between steps.
void abandon_work() { __builtin_trap(); }
bool complete(const std::function<void()>& work) {
    work();
    return true;
}

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

namespace {

constexpr std::size_t cache_line = 64;
std::size_t bytes_of_planes = 0;

}  // namespace

/// The cache line before a plane stores the plane's size.
void* allocate_plane(std::size_t bytes) {
    const std::size_t size = cache_line + (bytes + cache_line - 1) / cache_line * cache_line;
    char* const block = static_cast<char*>(std::aligned_alloc(cache_line, size));
    if (block == nullptr) lack_memory();
    std::memset(block, 0, size);
    std::memcpy(block, &size, sizeof size);
    bytes_of_planes += size;
    return block + cache_line;
}

void free_plane(void* plane) {
    if (plane == nullptr) return;
    char* const block = static_cast<char*>(plane) - cache_line;
    std::size_t size = 0;
    std::memcpy(&size, block, sizeof size);
    bytes_of_planes -= size;
    std::free(block);
}

/// Always false: in a tab nothing shares the memory of a plane.
bool has_several_owners(const void*) { return false; }

/// Addresses have 32 bits, so a module has at most 4 GiB of memory, in which freed blocks may leave
/// gaps. Returns 1 if memory is full, because 0 means that the amount is unknown.
std::uint64_t available_memory(const std::filesystem::path&) {
    constexpr std::uint64_t most = std::uint64_t{3} << 30;
    return most - std::min<std::uint64_t>(most - 1, bytes_of_planes);
}

}  // namespace cascade
