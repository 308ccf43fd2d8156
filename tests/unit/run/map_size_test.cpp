// The width of maps: the least power of 2 that is wide enough for the cells.
#include "run/pictures/map_size.h"

#include <gtest/gtest.h>

#include <cmath>

namespace cascade {
namespace {

TEST(MapSize, CellsAreAtLeastAsWideAsAskedFor) {
    for (const double texels : {0.1, 1.0, 4.0, 33.3}) {
        for (const std::int64_t cells : {1, 500, 16384, 1000000}) {
            for (const double covered : {0.01, 0.6, 1.0}) {
                const std::int64_t side = map_side(texels, cells, covered);
                const auto width = [&](std::int64_t of_side) {
                    return static_cast<double>(of_side) *
                           std::sqrt(covered / static_cast<double>(cells));
                };
                EXPECT_GE(width(side), texels * (1 - 1e-12));
                EXPECT_EQ(side & (side - 1), 0);
                if (side > 1) {
                    EXPECT_LT(width(side / 2), texels);
                }
            }
        }
    }
    EXPECT_EQ(map_side(4, 16384, 1), 512);
}

}  // namespace
}  // namespace cascade
