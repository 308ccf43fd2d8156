// Answers of terminals, and pictures in pixels.
#include "app/terminal_pictures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(TerminalPictures, AnswersAreUnderstood) {
    EXPECT_EQ(understood("").protocol, PictureProtocol::characters);
    EXPECT_EQ(understood("\x1b[?62;22c").protocol, PictureProtocol::characters);
    EXPECT_EQ(understood("\x1b[?62;14;40c").protocol, PictureProtocol::characters);
    EXPECT_EQ(understood("\x1b[?62;4;22c").protocol, PictureProtocol::sixel);
    EXPECT_EQ(understood("typed\x1b[?4c").protocol, PictureProtocol::sixel);
    EXPECT_EQ(understood("\x1b_Gi=31;OK\x1b\\\x1b[?62;4c").protocol, PictureProtocol::kitty);
    EXPECT_EQ(understood("\x1b_Gi=31;EINVAL:no\x1b\\\x1b[?62c").protocol,
              PictureProtocol::characters);
    const TerminalPictures sized = understood("\x1b[6;18;9t\x1b[?62;4c");
    EXPECT_EQ(sized.cell_height, 18);
    EXPECT_EQ(sized.cell_width, 9);
    for (const char* wrong :
         {"\x1b[4;600;800t\x1b[?4c", "\x1b[6;0;9t\x1b[?4c", "\x1b[6t\x1b[?4c"}) {
        EXPECT_EQ(understood(wrong).cell_height, TerminalPictures().cell_height) << wrong;
    }
}

TEST(TerminalPictures, AreAsHighInLinesAsInPixels) {
    Stream out;
    out.is_terminal = out.colour = true;
    out.descriptor = -1;  // Without a window, there are 80 columns and 24 lines.
    TerminalPictures pictures;
    pictures.protocol = PictureProtocol::sixel;
    // Small pictures are enlarged to the size that they have as characters.
    const std::string small = pictures.draw(Image(16, 8), out);
    EXPECT_THAT(small, HasSubstr("\"1;1;160;80#"));
    EXPECT_THAT(small, HasSubstr("\n\n\n\n\x1b[4A\x1b"
                                 "7"));
    // Large pictures are averaged down to the window.
    EXPECT_THAT(pictures.draw(Image(500, 2000), out), HasSubstr("\"1;1;105;420#"));
    pictures.protocol = PictureProtocol::kitty;
    EXPECT_THAT(pictures.draw(Image(16, 8), out, 5), HasSubstr(",i=5,"));
    EXPECT_THAT(pictures.erase(4, 5), HasSubstr("i=5"));
    out.colour = false;
    EXPECT_THAT(pictures.draw(Image(16, 8), out), Not(HasSubstr("\x1b")));
}

TEST(TerminalPictures, NothingIsAskedWithoutATerminal) {
    Stream out;
    out.descriptor = -1;
    EXPECT_EQ(ask_terminal(out).protocol, PictureProtocol::characters);
}

}  // namespace
}  // namespace cascade
