// Sources: lines, columns in characters, spans.
#include "core/source.h"
#include "core/utf8.h"

#include <gtest/gtest.h>

#include <ostream>

namespace cascade {

void PrintTo(const Location& location, std::ostream* out) {
    *out << location.line << ":" << location.column;
}
static bool operator==(const Location& a, const Location& b) {
    return a.line == b.line && a.column == b.column;
}

namespace {

TEST(Source, CountsLinesAndColumnsFromOne) {
    const Source source("a", "ab\ncd\n");
    EXPECT_EQ(source.locate(0), (Location{1, 1}));
    EXPECT_EQ(source.locate(1), (Location{1, 2}));
    EXPECT_EQ(source.locate(2), (Location{1, 3}));  // The line end belongs to its line.
    EXPECT_EQ(source.locate(3), (Location{2, 1}));
    EXPECT_EQ(source.locate(6), (Location{3, 1}));
    EXPECT_EQ(source.locate(1000), (Location{3, 1}));
}

TEST(Source, KnowsAllLineEnds) {
    const Source source("a", "1\r\n2\r3\n\n5");
    EXPECT_EQ(source.line(1), "1");
    EXPECT_EQ(source.line(2), "2");
    EXPECT_EQ(source.line(3), "3");
    EXPECT_EQ(source.line(4), "");
    EXPECT_EQ(source.line(5), "5");
    EXPECT_EQ(source.line(6), "");
    EXPECT_EQ(source.line(0), "");
    EXPECT_EQ(source.locate(3), (Location{2, 1}));
    EXPECT_EQ(source.locate(5), (Location{3, 1}));
}

TEST(Source, CountsColumnsInCharacters) {
    const Source source("a", "\xce\xb2: \xe2\x88\x92\x31");  // β: −1
    EXPECT_EQ(source.locate(2), (Location{1, 2}));
    EXPECT_EQ(source.locate(4), (Location{1, 4}));
    EXPECT_EQ(source.locate(7), (Location{1, 5}));
}

TEST(Source, AByteOrderMarkIsNoCharacter) {
    const Source source("a",
                        "\xef\xbb\xbf"
                        "ab");
    EXPECT_EQ(source.line(1), "ab");
    EXPECT_EQ(source.locate(3), (Location{1, 1}));
    EXPECT_EQ(source.locate(4), (Location{1, 2}));
    EXPECT_EQ(source.locate(0), (Location{1, 1}));
}

TEST(Source, AnInvalidByteIsOneColumn) {
    const Source source("a", "\xff\xfe:");
    EXPECT_EQ(source.locate(2), (Location{1, 3}));
}

TEST(Sources, StayWhereTheyAre) {
    Sources sources;
    const SourceId first = sources.add("first", "a: 1");
    const std::string_view text = sources[first].text();
    for (int k = 0; k < 1000; ++k) sources.add("other", "b: 2");
    EXPECT_EQ(text.data(), sources[first].text().data());
    EXPECT_EQ(sources.text({first, 3, 4}), "1");
    EXPECT_EQ(sources.text({first, 3, 400}), "1");
    EXPECT_EQ(sources.size(), 1001u);
}

TEST(Span, JoinCoversBoth) {
    EXPECT_EQ(join({1, 4, 6}, {1, 9, 12}), (Span{1, 4, 12}));
    EXPECT_EQ(join({1, 9, 12}, {1, 4, 6}), (Span{1, 4, 12}));
    EXPECT_EQ(join({1, 2, 12}, {1, 4, 6}), (Span{1, 2, 12}));
}

TEST(SpanDeathTest, JoinOfTwoSourcesIsOurMistake) {
    EXPECT_DEATH(join({0, 1, 2}, {1, 1, 2}), "a span lies in one source");
}

TEST(Utf8, DecodesEverySizeAndRefusesWhatRfc3629Refuses) {
    const auto value = [](std::string_view text) { return decode_utf8(text, 0).value; };
    const auto valid = [](std::string_view text) { return decode_utf8(text, 0).valid; };
    EXPECT_EQ(value("a"), U'a');
    EXPECT_EQ(value("\xce\xb2"), U'\u03b2');
    EXPECT_EQ(value("\xe2\x88\x92"), U'\u2212');
    EXPECT_EQ(value("\xf0\x9f\x90\x86"), U'\U0001f406');
    EXPECT_EQ(value("\xf4\x8f\xbf\xbf"), U'\U0010ffff');
    EXPECT_FALSE(valid("\x80"));
    EXPECT_FALSE(valid("\xc0\xaf"));          // Overlong.
    EXPECT_FALSE(valid("\xe0\x80\xaf"));      // Overlong.
    EXPECT_FALSE(valid("\xf0\x80\x80\xaf"));  // Overlong.
    EXPECT_FALSE(valid("\xed\xa0\x80"));      // A surrogate.
    EXPECT_FALSE(valid("\xf4\x90\x80\x80"));  // Above U+10FFFF.
    EXPECT_FALSE(valid("\xe2\x88"));          // Cut off.
    EXPECT_FALSE(
        valid("\xce"
              "a"));
}

TEST(Utf8, Utf16UnitsAreTheColumnsOfEditors) {
    EXPECT_EQ(count_utf16_units("aβ"), 2U);
    EXPECT_EQ(count_utf16_units("\xf0\x9f\x90\x86 x"), 4U);  // A leopard is two units.
    EXPECT_EQ(count_utf16_units("\xff"), 1U);
}

}  // namespace
}  // namespace cascade
