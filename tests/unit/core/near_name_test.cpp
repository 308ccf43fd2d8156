// "Did you mean …?"
#include "core/near_name.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace cascade {
namespace {

const std::vector<std::string> parameters = {"a", "b", "beta", "diff_a", "diff_b", "ka"};

TEST(NearName, FindsOneEdit) {
    EXPECT_EQ(nearest_name("betta", parameters), "beta");  // One letter too many.
    EXPECT_EQ(nearest_name("bea", parameters), "beta");    // One letter too few.
    EXPECT_EQ(nearest_name("beto", parameters), "beta");   // A wrong letter.
    EXPECT_EQ(nearest_name("btea", parameters), "beta");   // Two swapped letters are one edit.
    EXPECT_EQ(nearest_name("BETA", parameters), "beta");   // Case does not count.
}

TEST(NearName, AllowsAThirdOfTheLength) {
    const std::vector<std::string> names = {"iterations"};
    EXPECT_EQ(nearest_name("itterashons", names), "iterations");  // 3 edits of 11 letters.
    EXPECT_EQ(nearest_name("itterashuns", names), "");            // 4 of 11.
}

TEST(NearName, TakesTheNearest) {
    const std::vector<std::string> names = {"diff_ab", "diff_a", "diff_b"};
    EXPECT_EQ(nearest_name("dif_a", names), "diff_a");
    EXPECT_EQ(nearest_name("diff_c", names), "diff_a");  // The first of equally near names.
}

TEST(NearName, IsSilentWhereNothingIsNear) {
    EXPECT_EQ(nearest_name("temperature", parameters), "");
    EXPECT_EQ(nearest_name("q", parameters), "");  // A different single letter is no misspelling.
    EXPECT_EQ(nearest_name("k", parameters), "ka");
    EXPECT_EQ(nearest_name("", parameters), "");
    EXPECT_EQ(nearest_name("beta", {}), "");
}

TEST(NearName, LeavesLongNamesAlone) {
    const std::vector<std::string> names = {std::string(64, 'a'), std::string(65, 'a')};
    EXPECT_EQ(nearest_name(std::string(64, 'a'), names), names[0]);
    EXPECT_EQ(nearest_name(std::string(65, 'a'), names), "");
}

}  // namespace
}  // namespace cascade
