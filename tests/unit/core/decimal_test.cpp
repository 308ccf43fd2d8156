// Reading and writing decimal numbers.
#include "core/decimal.h"

#include <gtest/gtest.h>

#include <string_view>

namespace cascade {
namespace {

struct Read {
    double number = 77;
    std::size_t used = 0;
    std::errc error{};
};

Read read(std::string_view text) {
    Read read;
    const auto [stop, error] = from_decimal(text.data(), text.data() + text.size(), read.number);
    read.used = static_cast<std::size_t>(stop - text.data());
    read.error = error;
    return read;
}

TEST(Decimal, ReadsTheNearestNumber) {
    EXPECT_EQ(read("0.1").number, 0.1);
    EXPECT_EQ(read("-2.5e-3").number, -2.5e-3);
    EXPECT_EQ(read("9007199254740993").number, 9007199254740992.0);
    EXPECT_EQ(read("2.225073858507201e-308").number, 0x0.fffffffffffffp-1022);
    EXPECT_EQ(read("0.1,").used, 3U);
    EXPECT_EQ(read("0x10").used, 1U);
    EXPECT_EQ(read("1e").used, 1U);
}

TEST(Decimal, RefusesWhatIsNoNumber) {
    for (const std::string_view text : {"", "+1", " 1", "-", "-+1", "- 1", ".", "e5", "a"}) {
        const Read refused = read(text);
        EXPECT_EQ(refused.error, std::errc::invalid_argument) << text;
        EXPECT_EQ(refused.used, 0U) << text;
        EXPECT_EQ(refused.number, 77) << text;
    }
    EXPECT_EQ(read("1e999").error, std::errc::result_out_of_range);
    EXPECT_EQ(read("1e-999").error, std::errc::result_out_of_range);
}

}  // namespace
}  // namespace cascade
