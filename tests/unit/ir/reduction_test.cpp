// Aggregates of rows and of all rows: values, accuracy and their fixed order.
#include "ir/reduction.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

namespace cascade {
namespace {

float reduced(ReductionKind kind, const std::vector<float>& cells, std::int64_t width) {
    std::vector<double> rows;
    for (std::size_t at = 0; at < cells.size(); at += static_cast<std::size_t>(width)) {
        rows.push_back(reduce_row(kind, cells.data() + at, width));
    }
    return static_cast<float>(reduce_rows(kind, rows, static_cast<std::int64_t>(cells.size())));
}

TEST(Reduction, OfWholeNumbersIsExactForEveryShape) {
    for (const std::int64_t width : {1, 2, 7, 8, 9, 15, 16, 17, 31, 100}) {
        for (const std::int64_t height : {1, 2, 3, 5, 8, 13}) {
            std::vector<float> cells(static_cast<std::size_t>(width * height));
            std::iota(cells.begin(), cells.end(), -5.0f);
            const auto count = static_cast<double>(cells.size());
            const double sum = count * (count - 1) / 2 - 5 * count;
            EXPECT_EQ(reduced(ReductionKind::sum, cells, width), static_cast<float>(sum));
            EXPECT_EQ(reduced(ReductionKind::mean, cells, width), static_cast<float>(sum / count));
            EXPECT_EQ(reduced(ReductionKind::least, cells, width), -5.0f);
            EXPECT_EQ(reduced(ReductionKind::largest, cells, width), cells.back());
        }
    }
}

/// In binary32 the sum of ten million tenths would be wrong by several percent.
TEST(Reduction, RoundsOnce) {
    const std::vector<float> cells(10'000'000, 0.1f);
    const double exact = 1e7 * static_cast<double>(0.1f);
    EXPECT_EQ(reduced(ReductionKind::sum, cells, 1000), static_cast<float>(exact));
    EXPECT_EQ(reduced(ReductionKind::mean, cells, 1000), 0.1f);
}

TEST(Reduction, FindsNaNWhereverItIs) {
    for (std::size_t place = 0; place < 60; ++place) {
        std::vector<float> cells(60, 1.0f);
        cells[place] = std::numeric_limits<float>::quiet_NaN();
        for (const ReductionKind kind : {ReductionKind::sum, ReductionKind::mean,
                                         ReductionKind::least, ReductionKind::largest}) {
            EXPECT_TRUE(std::isnan(reduced(kind, cells, 20))) << place;
        }
    }
}

}  // namespace
}  // namespace cascade
