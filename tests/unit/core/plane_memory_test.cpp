// Memory of planes: zeroed, aligned, and accessed only where it is used.
#include "core/plane.h"
#include "core/shared_plane.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <new>
#include <vector>

#include <sys/mman.h>
#include <unistd.h>

namespace cascade {
namespace {

using Memory = std::unique_ptr<std::uint8_t[], decltype(&free_plane)>;

Memory plane_of(std::size_t bytes) {
    return {static_cast<std::uint8_t*>(allocate_plane(bytes)), free_plane};
}

/// Sizes around the limits from which planes are shifted and from which they are allocated by the
/// system.
constexpr std::size_t memory_sizes[] = {0,       1,       63,      65535,    65536,
                                        4194303, 4194304, 6291455, 16777216, 33554433};

TEST(PlaneMemory, IsZeroAndAlignedEvenWhereItWasInUseBefore) {
    for (int turn = 0; turn < 3; ++turn) {
        for (const std::size_t bytes : memory_sizes) {
            const Memory memory = plane_of(bytes);
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.get()) % 64, 0u) << bytes;
            EXPECT_TRUE(std::all_of(memory.get(), memory.get() + bytes, [](std::uint8_t byte) {
                return byte == 0;
            })) << bytes;
            std::fill_n(memory.get(), bytes, std::uint8_t{255});
        }
    }
}

TEST(PlaneMemory, PlanesDoNotOverlap) {
    std::vector<Memory> planes;
    for (const std::size_t bytes : memory_sizes) {
        planes.push_back(plane_of(bytes));
        std::fill_n(planes.back().get(), bytes, static_cast<std::uint8_t>(planes.size()));
    }
    for (std::size_t k = 0; k < planes.size(); ++k) {
        EXPECT_TRUE(std::all_of(planes[k].get(), planes[k].get() + memory_sizes[k],
                                [&](std::uint8_t byte) { return byte == k + 1; }))
            << memory_sizes[k];
        planes[k].reset();
    }
}

/// The number of whole pages of a plane that are in memory.
std::size_t resident_pages(const std::uint8_t* plane, std::size_t bytes) {
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const std::size_t to_page = (page - reinterpret_cast<std::uintptr_t>(plane) % page) % page;
    std::vector<unsigned char> is_resident((bytes - to_page) / page);
    // mincore() takes a non-const address, but does not change the memory.
    void* const first = const_cast<std::uint8_t*>(plane) + to_page;
    if (::mincore(first, is_resident.size() * page, is_resident.data()) != 0) return SIZE_MAX;
    return static_cast<std::size_t>(std::count_if(is_resident.begin(), is_resident.end(),
                                                  [](unsigned char is) { return (is & 1) != 0; }));
}

TEST(PlaneMemory, OfALargePlaneIsTouchedWhereItIsUsed) {
    constexpr std::size_t bytes = std::size_t{64} << 20, huge_page = std::size_t{2} << 20;
    const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const Memory memory = plane_of(bytes);
    EXPECT_LE(resident_pages(memory.get(), bytes), huge_page / page) << "the start alone";
    memory[bytes / 2] = 1;
    EXPECT_LE(resident_pages(memory.get(), bytes), 2 * huge_page / page);
    std::fill_n(memory.get(), bytes, std::uint8_t{1});
    EXPECT_EQ(resident_pages(memory.get(), bytes), bytes / page - 1);
}

TEST(PlaneMemory, ThatDoesNotExistIsRefused) {
    // More than an address can reach.
    EXPECT_THROW(plane_of(std::size_t{1} << 60), std::bad_alloc);
}

TEST(PlaneMemory, LivesUntilItsLastOwnerIsGone) {
    for (const std::int64_t width : {8, 2048}) {
        Grid grid;
        grid.width = grid.height = width;
        Field field{PlaneLayout(grid)};
        field.at(3, 2) = 7;
        const float* const cell = field.row(2) + 3;
        auto kept = share(field);
        EXPECT_TRUE(is_shared(field));
        auto also_kept = share(field);
        also_kept.reset();
        EXPECT_TRUE(is_shared(field));
        field = Field(PlaneLayout(grid));
        EXPECT_FALSE(is_shared(field));
        EXPECT_EQ(*cell, 7);
        kept = share(field);
        kept.reset();
        EXPECT_FALSE(is_shared(field));
    }
}

}  // namespace
}  // namespace cascade
