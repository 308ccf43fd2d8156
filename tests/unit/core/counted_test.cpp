// Numbers with nouns, in singular and plural.
#include "core/counted.h"

#include <gtest/gtest.h>

namespace cascade::test {
namespace {

TEST(Counted, OneIsNotMany) {
    EXPECT_EQ(counted(0, "step"), "0 steps");
    EXPECT_EQ(counted(1, "step"), "1 step");
    EXPECT_EQ(counted(2, "pass"), "2 passes");
    EXPECT_EQ(counted(1, "pass"), "1 pass");
    EXPECT_EQ(counted(1, "face was", "faces were"), "1 face was");
    EXPECT_EQ(counted(1234567, "face was", "faces were"), "1,234,567 faces were");
}

}  // namespace
}  // namespace cascade::test
