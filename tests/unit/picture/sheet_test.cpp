// Contact sheets: the positions of pictures and labels.
#include "picture/font.h"
#include "picture/image.h"
#include "plain_colours.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

namespace cascade {
namespace {

using test::blue;
using test::red;

/// The smallest box that contains all pixels of a colour.
struct Box {
    std::int64_t left = -1, top = -1, right = -1, bottom = -1;  // Inclusive.
    std::int64_t count = 0;
    std::int64_t width() const { return right - left + 1; }
    std::int64_t height() const { return bottom - top + 1; }
    bool full() const { return count == width() * height(); }
};

template <typename Matches>
Box box_where(const Image& image, Matches matches) {
    Box box;
    for (std::int64_t y = 0; y < image.height; ++y) {
        for (std::int64_t x = 0; x < image.width; ++x) {
            if (!matches(image.at(x, y))) continue;
            if (box.count++ == 0) box = {x, y, x, y, 1};
            box.left = std::min(box.left, x);
            box.right = std::max(box.right, x);
            box.bottom = y;
        }
    }
    return box;
}

Box box_of(const Image& image, Colour colour) {
    return box_where(image, [&](const Colour& pixel) { return pixel == colour; });
}

bool is_ink(const Colour& pixel) { return pixel[0] < 0.3F && pixel[1] < 0.3F && pixel[2] < 0.3F; }

TEST(Font, EveryPrintableCharacterHasItsOwnGlyph) {
    std::set<Glyph> glyphs{glyph_of(U'\u2026'), glyph_of(U'\ufffd')};
    for (char32_t c = U' '; c <= U'~'; ++c) {
        EXPECT_TRUE(glyphs.insert(glyph_of(c)).second) << static_cast<char>(c);
        for (const std::uint8_t row : glyph_of(c)) EXPECT_LT(row, 32);
    }
    EXPECT_EQ(glyph_of(U' '), Glyph{});
}

TEST(Font, TheLetterLIsAnL) {
    const Glyph expected{16, 16, 16, 16, 16, 16, 31};
    EXPECT_EQ(glyph_of(U'L'), expected);
}

TEST(Font, CharactersOfALabel) {
    EXPECT_EQ(label_characters("b 0…7"), U"b 0\u20267");
    EXPECT_EQ(label_characters("größe"), U"gr\ufffd\ufffde");
    EXPECT_EQ(label_characters("\x80\xff"), U"\ufffd");
    EXPECT_EQ(label_characters("\xe2\x80"), U"\ufffd");
}

TEST(Sheet, SmallPicturesAreEnlargedByOneWholeFactor) {
    const std::vector<Panel> panels{{"", Image(64, 64, red)}, {"", Image(32, 64, blue)}};
    const Image sheet = make_sheet(panels, 2);
    const Box first = box_of(sheet, red);
    const Box second = box_of(sheet, blue);
    EXPECT_EQ(first.width(), 192);
    EXPECT_EQ(first.height(), 192);
    EXPECT_TRUE(first.full());
    EXPECT_EQ(second.width(), 96);
    EXPECT_EQ(second.height(), 192);
    EXPECT_TRUE(second.full());
    EXPECT_GT(second.left, first.right + 8);
    EXPECT_EQ(first.top, second.top);
}

TEST(Sheet, LargePicturesKeepTheirSize) {
    const Image sheet = make_sheet(std::vector<Panel>{{"", Image(300, 150, red)}}, 1);
    EXPECT_EQ(box_of(sheet, red).width(), 300);
    EXPECT_EQ(box_of(sheet, red).height(), 150);
}

TEST(Sheet, PixelsOfAPictureStayInPlace) {
    Image image(96, 96, red);
    image.at(95, 0) = blue;
    const Image sheet = make_sheet(std::vector<Panel>{{"", image}}, 1);
    const Box corner = box_of(sheet, blue);
    EXPECT_EQ(corner.width(), 2);
    EXPECT_EQ(corner.height(), 2);
    EXPECT_EQ(corner.top, box_of(sheet, red).top);
    EXPECT_EQ(corner.right, box_of(sheet, red).right);
}

TEST(Sheet, RowsAreFilledFromTheLeft) {
    std::vector<Panel> panels(4, Panel{"x", Image(64, 64, red)});
    panels.push_back({"x", Image(64, 64, blue)});
    const Image sheet = make_sheet(panels, 3);
    EXPECT_GT(sheet.width, 3 * 192);
    EXPECT_LT(sheet.width, 4 * 192);
    const Box fifth = box_of(sheet, blue);
    EXPECT_GT(fifth.left, 192);
    EXPECT_LT(fifth.right, 2 * 192 + 64);
    EXPECT_GT(fifth.top, 192);
}

TEST(Sheet, ColumnsWithoutPanelsTakeNoRoom) {
    const std::vector<Panel> panels(2, Panel{"x", Image(64, 64, red)});
    EXPECT_EQ(make_sheet(panels, 9).width, make_sheet(panels, 2).width);
}

TEST(Sheet, ALineOfCellsBecomesABand) {
    const Image sheet = make_sheet(std::vector<Panel>{{"", Image(60, 1, red)}}, 1);
    EXPECT_EQ(box_of(sheet, red).width(), 180);
    EXPECT_EQ(box_of(sheet, red).height(), 24);
    EXPECT_TRUE(box_of(sheet, red).full());
}

TEST(Sheet, LabelsStandUnderTheirPicture) {
    const Image sheet = make_sheet(std::vector<Panel>{{"L", Image(64, 64, red)}}, 1);
    const Box picture = box_of(sheet, red);
    const Box label = box_where(sheet, is_ink);
    EXPECT_EQ(label.left, picture.left);
    EXPECT_GT(label.top, picture.bottom + 1);
    EXPECT_LT(label.bottom, sheet.height - 8);
    EXPECT_EQ(label.width(), 10);   // Five dots of two pixels,
    EXPECT_EQ(label.height(), 14);  // seven of them high.
    EXPECT_EQ(label.count, 4 * (6 + 5));
}

TEST(Sheet, LettersWithATailReachBelowTheLine) {
    const std::vector<Panel> line{{"L", Image(64, 64, red)}};
    const std::vector<Panel> tail{{"p", Image(64, 64, red)}};
    const Image sheet = make_sheet(tail, 1);
    const Box box = box_where(sheet, is_ink);
    EXPECT_EQ(box.bottom, box_where(make_sheet(line, 1), is_ink).bottom + 2 * 2);
    EXPECT_LT(box.bottom, sheet.height - 8);
}

TEST(Sheet, LongLabelsAreCutAtThePicturesWidth) {
    const std::string label(100, 'L');
    const std::vector<Panel> panels{{label, Image(64, 64, red)}, {"", Image(64, 64, red)}};
    const Image sheet = make_sheet(panels, 2);
    const Box ink = box_where(sheet, is_ink);
    EXPECT_EQ(ink.left, box_of(sheet, red).left);
    EXPECT_LE(ink.width(), 192);
    EXPECT_GT(ink.width(), 192 - 2 * 6);
    // Sixteen characters fit: fifteen L of eleven dots and an ellipsis of three.
    EXPECT_EQ(ink.count, 4 * (15 * 11 + 3));
}

TEST(Sheet, ALabelThatJustFitsIsWhole) {
    const Image sheet = make_sheet(std::vector<Panel>{{std::string(16, 'L'), Image(64, 64)}}, 1);
    EXPECT_EQ(box_where(sheet, is_ink).count, 4 * 16 * 11);
}

TEST(Sheet, NoPanelsAreOurMistake) {
    EXPECT_DEATH((void)make_sheet({}, 2), "panels");
    const std::vector<Panel> panels(1, Panel{"x", Image(1, 1)});
    EXPECT_DEATH((void)make_sheet(panels, 0), "columns");
}

}  // namespace
}  // namespace cascade
