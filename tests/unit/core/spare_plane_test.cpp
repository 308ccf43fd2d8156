// Memory of freed planes is reused: zeroed, and for one plane at a time.
#include "core/plane.h"

#include <algorithm>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <thread>
#include <vector>

namespace cascade {
namespace {

using SpareMemory = std::unique_ptr<std::uint8_t[], decltype(&free_plane)>;

SpareMemory spare_plane(std::size_t bytes) {
    return {static_cast<std::uint8_t*>(allocate_plane(bytes)), free_plane};
}

bool is_filled_with(const SpareMemory& memory, std::size_t bytes, std::uint8_t value) {
    return std::all_of(memory.get(), memory.get() + bytes,
                       [value](std::uint8_t byte) { return byte == value; });
}

/// Sizes that need the same number of pages, and larger ones.
constexpr std::size_t spare_sizes[] = {5'000'000, 5'000'000, 4'500'000, 9'000'000,
                                       5'000'000, 5'000'000, 40'000'000};

TEST(SparePlane, IsZeroWhereverItsMemoryWas) {
    for (int turn = 0; turn < 3; ++turn) {
        for (const std::size_t bytes : spare_sizes) {
            const SpareMemory memory = spare_plane(bytes);
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(memory.get()) % 64, 0U);
            EXPECT_TRUE(is_filled_with(memory, bytes, 0)) << bytes;
            std::fill_n(memory.get(), bytes, std::uint8_t{255});
        }
    }
}

TEST(SparePlane, IsGivenToOneOfThoseThatWantIt) {
    constexpr std::size_t bytes = 5'000'000;
    for (int turn = 0; turn < 3; ++turn) {
        std::vector<SpareMemory> planes;
        for (std::uint8_t k = 0; k < 3; ++k) {
            planes.push_back(spare_plane(bytes));
            EXPECT_TRUE(is_filled_with(planes.back(), bytes, 0));
            std::fill_n(planes.back().get(), bytes, static_cast<std::uint8_t>(k + 1));
        }
        for (std::uint8_t k = 0; k < 3; ++k) {
            EXPECT_TRUE(is_filled_with(planes[k], bytes, static_cast<std::uint8_t>(k + 1)));
        }
    }
}

TEST(SparePlane, IsGivenToOneOfSeveralThreads) {
    std::vector<std::thread> threads;
    std::vector<int> wrong(4);
    for (std::size_t number = 0; number < wrong.size(); ++number) {
        threads.emplace_back([&wrong, number] {
            for (std::size_t turn = 0; turn < 20; ++turn) {
                const std::size_t bytes = turn % 3 == 0 ? 9'000'000 : 5'000'000;
                const SpareMemory memory = spare_plane(bytes);
                if (!is_filled_with(memory, bytes, 0)) ++wrong[number];
                const auto own = static_cast<std::uint8_t>(number + 1);
                std::fill_n(memory.get(), bytes, own);
                if (!is_filled_with(memory, bytes, own)) ++wrong[number];
            }
        });
    }
    for (std::thread& thread : threads) thread.join();
    EXPECT_EQ(wrong, std::vector<int>(wrong.size()));
}

}  // namespace
}  // namespace cascade
