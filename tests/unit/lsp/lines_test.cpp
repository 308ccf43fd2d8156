// Positions in lines, in UTF-16 and in UTF-8, compared with a plain count.
#include "lsp/lines.h"

#include "core/utf8.h"

#include <gmock/gmock.h>

#include <string>

namespace cascade::lsp {
namespace {

TEST(Lines, CountsUtf16Units) {
    const std::string text = "ä🐆x\r\nβ\rz\n";
    const Lines lines(text, ColumnUnit::utf16);
    EXPECT_EQ(lines.position_of(text, text.find('x')), (Position{0, 3}));
    EXPECT_EQ(lines.byte_at(text, {0, 3}), text.find('x'));
    EXPECT_EQ(lines.byte_at(text, {0, 2}), text.find("🐆")) << "inside of a pair";
    EXPECT_EQ(lines.byte_at(text, {0, 99}), text.find('\r')) << "the end of the line";
    EXPECT_EQ(lines.position_of(text, text.find("β")), (Position{1, 0}));
    EXPECT_EQ(lines.position_of(text, text.find('z')), (Position{2, 0}));
    EXPECT_EQ(lines.position_of(text, text.size()), (Position{3, 0}));
    EXPECT_EQ(lines.byte_at(text, {3, 0}), text.size());
    EXPECT_EQ(lines.byte_at(text, {99, 5}), text.size());
}

TEST(Lines, CountsBytes) {
    const std::string text = "ä🐆x";
    const Lines lines(text, ColumnUnit::utf8);
    EXPECT_EQ(lines.position_of(text, 6), (Position{0, 6}));
    EXPECT_EQ(lines.byte_at(text, {0, 6}), 6u);
    EXPECT_EQ(lines.byte_at(text, {0, 4}), 2u) << "inside of a character";
}

TEST(Lines, OfNoText) {
    const Lines lines("", ColumnUnit::utf16);
    EXPECT_EQ(lines.position_of("", 5), (Position{0, 0}));
    EXPECT_EQ(lines.byte_at("", {4, 4}), 0u);
}

/// For long lines, positions are stored from which counting continues.
TEST(Lines, AgreeWithACountInLongLines) {
    std::string text;
    for (int k = 0; k < 700; ++k) text += k % 97 == 0 ? "\r\n" : k % 5 == 0 ? "🐆" : "βc";
    text += '\r';
    for (int k = 0; k < 3000; ++k) text += k % 3 == 0 ? "é" : "\t";
    text.insert(1023, "\r\n");
    for (const ColumnUnit unit : {ColumnUnit::utf16, ColumnUnit::utf8}) {
        const Lines lines(text, unit);
        Position expected;
        for (std::size_t byte = 0; byte <= text.size();) {
            ASSERT_EQ(lines.position_of(text, byte), expected) << byte;
            const bool is_within_end = byte > 0 && text[byte - 1] == '\r' && text[byte] == '\n';
            if (!is_within_end) {
                ASSERT_EQ(lines.byte_at(text, expected), byte);
            }
            if (byte == text.size()) break;
            const CodePoint point = decode_utf8(text, byte);
            const bool is_end =
                text[byte] == '\n' || (text[byte] == '\r' && text[byte + 1] != '\n');
            const std::size_t units = point.value > 0xffff ? 2 : 1;
            expected.column += unit == ColumnUnit::utf8 ? point.size : units;
            if (is_end) expected = {expected.line + 1, 0};
            byte += point.size;
        }
    }
}

}  // namespace
}  // namespace cascade::lsp
