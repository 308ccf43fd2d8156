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

TEST(Base64, IsReadAgain) {
    for (const std::string_view bytes : {"", "f", "fo", "foo", "foob", "\xff\xfe\x3f", "\x80"}) {
        EXPECT_EQ(from_base64(base64(bytes)), bytes);
    }
    for (const std::string_view wrong : {"Z", "Zg", "Zg=", "Z===", "Zm9v\n", "Zg==Zg==", "Zm9-"}) {
        EXPECT_EQ(from_base64(wrong), std::nullopt) << wrong;
    }
}

}  // namespace
}  // namespace cascade
