#include "run/emit_c/c_comment.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

TEST(CComment, StaysAComment) {
    EXPECT_EQ(c_comment("coat of a β-leopard, u[1]"), "coat of a β-leopard, u[1]");
    EXPECT_EQ(c_comment("x*/ int pwned; /*.npy"), "x* / int pwned; / *.npy");
    EXPECT_EQ(c_comment("**//**/"), "** // ** /");
    EXPECT_EQ(c_comment("a*\n/\r\t\x1b[2J"), "a*?/? ? ?[2J");
    EXPECT_EQ(c_comment("a\\\nb*\\/"), "a? ?b*?/");
    EXPECT_EQ(c_comment("*?\?/"), "*? ?/");
    EXPECT_EQ(c_comment("\xff\u202e"), "? ?");
}

}  // namespace
}  // namespace cascade
