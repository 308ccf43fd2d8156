// Known values of hashes, computed by other code.
#include "core/hash.h"

#include <gtest/gtest.h>

#include <bitset>

namespace cascade {
namespace {

// The test vectors of the FNV page of L. C. Noll.
TEST(Fnv1a, KnownValues) {
    EXPECT_EQ(fnv1a(""), 0xcbf29ce484222325ULL);
    EXPECT_EQ(fnv1a("a"), 0xaf63dc4c8601ec8cULL);
    EXPECT_EQ(fnv1a("foobar"), 0x85944171f73967e8ULL);
    EXPECT_EQ(fnv1a("\xff"), 0xaf64724c8602eb6eULL) << "bytes are unsigned";
}

TEST(Fnv1a, SeedChains) { EXPECT_EQ(fnv1a("bar", fnv1a("foo")), fnv1a("foobar")); }

TEST(Pcg4d, KnownValues) {
    using Words = std::array<std::uint32_t, 4>;
    EXPECT_EQ(pcg4d({0, 0, 0, 0}), (Words{0x0f02f829, 0x2d568769, 0x32b0c43b, 0xd32548ea}));
    EXPECT_EQ(pcg4d({1, 2, 3, 4}), (Words{0x3622cd16, 0xf11471d8, 0xe1109b3f, 0x02b94c2f}));
    EXPECT_EQ(pcg4d({0xffffffff, 0x80000000, 12345, 0xdeadbeef}),
              (Words{0x50a95531, 0x1479dfd1, 0x1f12c6c2, 0x26b43426}));
}

// One changed bit of the input changes half of the upper bits, from which numbers are made. The two
// highest bits of a word are left out, since they influence few bits of the products.
TEST(Pcg4d, EveryInputBitMatters) {
    for (std::size_t word = 0; word < 4; ++word) {
        for (int bit = 0; bit < 30; ++bit) {
            std::size_t changed = 0;
            constexpr std::uint32_t trials = 4000;
            for (std::uint32_t trial = 0; trial < trials; ++trial) {
                std::array<std::uint32_t, 4> v = {trial % 64, trial / 64, 0x9abcdef0, 0x12345678};
                const std::uint32_t before = pcg4d(v)[0];
                v[word] ^= 1u << bit;
                changed += std::bitset<8>((before ^ pcg4d(v)[0]) >> 24).count();
            }
            EXPECT_NEAR(static_cast<double>(changed) / trials, 4.0, 0.2)
                << "word " << word << " bit " << bit;
        }
    }
}

}  // namespace
}  // namespace cascade
