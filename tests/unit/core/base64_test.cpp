// The test vectors of RFC 4648.
#include "core/base64.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

TEST(Base64, PadsToFourDigits) {
    EXPECT_EQ(base64(""), "");
    EXPECT_EQ(base64("f"), "Zg==");
    EXPECT_EQ(base64("fo"), "Zm8=");
    EXPECT_EQ(base64("foo"), "Zm9v");
    EXPECT_EQ(base64("foob"), "Zm9vYg==");
    EXPECT_EQ(base64("\xff\xfe\x3f"), "//4/");
}

}  // namespace
}  // namespace cascade
