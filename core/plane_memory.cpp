// Small planes come from the heap. Large ones come from the system, which clears their pages when a
// thread first touches them. Clearing takes longer than filling a picture's plane, so the memory of
// one freed plane is reused for the next plane of the same size.
#include "core/enough_memory.h"
#include "core/plane.h"
#include "core/shared_plane.h"

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <new>

#include <sys/mman.h>

namespace cascade {
namespace {

constexpr std::size_t cache_line = 64;
constexpr std::size_t huge_page = std::size_t{2} << 20;

/// A header before each plane, at the end of a cache line that holds nothing else.
struct Block {
    void* begin;
    std::size_t mapped_bytes;  ///< 0 if the block is on the heap.
    std::atomic<std::size_t> owners{1};
};

Block& block_of(const void* plane) {
    char* const begin = static_cast<char*>(const_cast<void*>(plane));
    return *std::launder(reinterpret_cast<Block*>(begin - sizeof(Block)));
}

/// The offset of a plane in its memory block. If all planes began at the same offset in their
/// pages, equal rows would compete for the same cache sets, which have too few ways for a tile of
/// five planes. The processor would also mistake a load from one plane for a store to another,
/// because it first compares only the low 12 bits of addresses. So each plane is shifted by a
/// different part of 128 KiB (one way of a second-level cache), or of a page if the plane is too
/// small for that. Multiples of 783 are spread evenly over the 2048 cache lines of 128 KiB, and
/// over the 64 lines of a page.
std::size_t next_shift(std::size_t bytes) {
    constexpr std::size_t small_plane = 65536, lines_of_way = 2048, lines_of_page = 64;
    static std::atomic<std::size_t> planes{0};
    std::size_t lines = 1;  // One cache line for the header.
    if (bytes >= small_plane) {
        const std::size_t place = 783 * planes.fetch_add(1, std::memory_order_relaxed);
        lines += place % (bytes >= 2 * huge_page ? lines_of_way : lines_of_page);
    }
    return lines * cache_line;
}

std::size_t round_up(std::size_t bytes, std::size_t unit) {
    return (bytes + unit - 1) / unit * unit;
}

/// Zeroed pages that begin with a huge page; null if the system has none.
void* map_pages(std::size_t bytes) {
    // After the first position aligned for a huge page, at least `bytes` remain.
    const std::size_t reserved = bytes + huge_page;
    void* const all =
        ::mmap(nullptr, reserved, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) return nullptr;
    const std::size_t before =
        (huge_page - reinterpret_cast<std::uintptr_t>(all) % huge_page) % huge_page;
    char* const begin = static_cast<char*>(all) + before;
    if (before > 0) ::munmap(all, before);
    ::munmap(begin + bytes, huge_page - before);
    // Advice only: without huge pages the plane works, but slower.
    ::madvise(begin, bytes, MADV_HUGEPAGE);
    return begin;
}

/// The pages of a freed plane, ready for reuse by the next plane. The object is stored in the first
/// bytes of these pages.
struct SparePages {
    std::size_t bytes;
};
std::atomic<SparePages*> spare_pages = nullptr;
constexpr std::size_t most_spare_bytes = std::size_t{32} << 20;

void unmap_pages(SparePages* pages) {
    if (pages != nullptr) ::munmap(pages, pages->bytes);
}

/// Takes the spare pages if they have this size. Otherwise frees them and returns null.
void* take_spare_pages(std::size_t bytes) {
    SparePages* const pages = spare_pages.exchange(nullptr);
    if (pages != nullptr && pages->bytes == bytes) return pages;
    unmap_pages(pages);
    return nullptr;
}

void free_pages(void* begin, std::size_t bytes) {
    auto* pages = new (begin) SparePages{bytes};
    if (bytes <= most_spare_bytes) pages = spare_pages.exchange(pages);
    unmap_pages(pages);
}

}  // namespace

void* allocate_plane(std::size_t bytes) {
    const bool is_large = bytes >= 2 * huge_page;
    const std::size_t shift = next_shift(bytes);
    const std::size_t rounded = round_up(bytes + shift, is_large ? huge_page : cache_line);
    void* const spare = is_large ? take_spare_pages(rounded) : nullptr;
    void* const begin = spare      ? spare
                        : is_large ? map_pages(rounded)
                                   : std::aligned_alloc(cache_line, rounded);
    if (begin == nullptr) lack_memory();
    char* const plane = static_cast<char*>(begin) + shift;
    new (plane - sizeof(Block)) Block{begin, is_large ? rounded : 0};
    if (spare || !is_large) std::memset(plane, 0, bytes);
    return plane;
}

void free_plane(void* plane) {
    if (plane == nullptr) return;
    Block& block = block_of(plane);
    if (block.owners.fetch_sub(1, std::memory_order_acq_rel) > 1) return;
    if (block.mapped_bytes > 0) free_pages(block.begin, block.mapped_bytes);
    else std::free(block.begin);
}

void add_owner_of_plane(const void* plane) {
    block_of(plane).owners.fetch_add(1, std::memory_order_relaxed);
}

bool has_several_owners(const void* plane) {
    return block_of(plane).owners.load(std::memory_order_acquire) > 1;
}

}  // namespace cascade
