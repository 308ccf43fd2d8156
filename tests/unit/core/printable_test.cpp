#include "core/printable.h"

#include <gtest/gtest.h>

namespace cascade {
namespace {

constexpr const char* mark = "\xef\xbf\xbd";

TEST(Printable, ReplacesWhatATerminalWouldObey) {
    EXPECT_EQ(printable("coat, β × 2"), "coat, β × 2");
    EXPECT_EQ(printable("\x1b]0;title\x07"), std::string(mark) + "]0;title" + mark);
    EXPECT_EQ(printable("a\nb\tc\r"), std::string("a") + mark + "b" + mark + "c" + mark);
    EXPECT_EQ(printable("\x80\xff"), std::string(mark) + mark);
    EXPECT_EQ(printable("\u009b1m \u202e"),
              std::string(mark) + "1m " + mark);  // CSI of 8 bits; bidi.
    EXPECT_EQ(printable_lines("a\nb\tc\r"), std::string("a\nb\tc") + mark);
}

TEST(Printable, ShortensLongNames) {
    EXPECT_EQ(short_name("abcdefgh", 8), "abcdefgh");
    EXPECT_EQ(short_name("abcdefghi", 8), "abc…fghi");
    EXPECT_EQ(short_name("ββββββββββ", 6), "ββ…βββ");
}

}  // namespace
}  // namespace cascade
