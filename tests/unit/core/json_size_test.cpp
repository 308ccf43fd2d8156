#include "core/json_size.h"

#include <gtest/gtest.h>

#include <string>

namespace cascade {
namespace {

TEST(JsonSize, CountsWhatStandsOutsideOfTexts) {
    const JsonSize size = measure_json(R"({"a": [1, 2, {"b,[{": "\"[,"}], "c": []})");
    EXPECT_EQ(size.objects, 4U);
    EXPECT_EQ(size.values, 7U);
    EXPECT_EQ(size.depth, 3U);
    EXPECT_EQ(measure_json("]]}}").depth, 0U);
}

TEST(JsonSize, SettingsAreSmall) {
    EXPECT_TRUE(is_small_json(R"({"script": ")" + std::string(1 << 20, '[') + "\"}"));
    EXPECT_FALSE(is_small_json(std::string(100, '[')));
    EXPECT_FALSE(is_small_json("[" + std::string(300'000, ',')));
}

}  // namespace
}  // namespace cascade
