// Numbers with prefixes and units.
#include "core/quantities.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

TEST(Quantities, AreReadable) {
    EXPECT_EQ(with_prefix(0), "0");
    EXPECT_EQ(with_prefix(7), "7.00");
    EXPECT_EQ(with_prefix(999.4), "999");
    EXPECT_EQ(with_prefix(999.6), "1.00 k");
    EXPECT_EQ(with_prefix(2.2e9), "2.20 G");
    EXPECT_EQ(with_unit(38.04e9, "B/s"), "38.0 GB/s");
    EXPECT_EQ(with_unit(6.36e-5, "s"), "63.6 µs");
    EXPECT_EQ(with_unit(2.5, "s"), "2.50 s");
    EXPECT_EQ(with_unit(1e-12, "s"), "0.00 ns");
}

}  // namespace
}  // namespace cascade::test
