// Decoding of UTF-8 by the table of well-formed sequences in RFC 3629, section 4.
#include "core/utf8.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace cascade {

namespace {

struct Interval {
    char32_t first, last;
};

bool is_in(char32_t code_point, const Interval* begin, const Interval* end) {
    return std::any_of(begin, end, [code_point](const Interval& interval) {
        return interval.first <= code_point && code_point <= interval.last;
    });
}

/// The length of the sequence that starts with this byte; 0 if no sequence does.
std::uint32_t announced_size(unsigned char first) {
    if (first < 0x80) return 1;
    if (first >= 0xc2 && first <= 0xdf) return 2;
    if (first >= 0xe0 && first <= 0xef) return 3;
    if (first >= 0xf0 && first <= 0xf4) return 4;
    return 0;
}

/// The smallest code point that needs a sequence of this length.
constexpr std::array<char32_t, 5> smallest_of_size = {0, 0, 0x80, 0x800, 0x10000};

}  // namespace

CodePoint decode_utf8(std::string_view text, std::size_t offset) {
    const auto first = static_cast<unsigned char>(text[offset]);
    const CodePoint invalid{first, 1, false};
    const std::uint32_t size = announced_size(first);
    if (size == 0 || size > text.size() - offset) return invalid;
    if (size == 1) return {first, 1, true};
    char32_t value = first & (0x7fu >> size);
    for (std::uint32_t k = 1; k < size; ++k) {
        const auto byte = static_cast<unsigned char>(text[offset + k]);
        if ((byte & 0xc0) != 0x80) return invalid;
        value = (value << 6) | (byte & 0x3fu);
    }
    const bool is_surrogate = value >= 0xd800 && value <= 0xdfff;
    if (value < smallest_of_size[size] || value > 0x10ffff || is_surrogate) return invalid;
    return {value, size, true};
}

std::size_t count_code_points(std::string_view text) {
    std::size_t count = 0;
    for (std::size_t offset = 0; offset < text.size(); ++count) {
        offset += decode_utf8(text, offset).size;
    }
    return count;
}

std::size_t count_utf16_units(std::string_view text) {
    std::size_t count = 0;
    for (std::size_t offset = 0; offset < text.size();) {
        const CodePoint point = decode_utf8(text, offset);
        count += point.value > 0xffff ? 2 : 1;
        offset += point.size;
    }
    return count;
}

int display_width(char32_t code_point) {
    static constexpr Interval combining[] = {
        {0x300, 0x36f}, {0x1ab0, 0x1aff}, {0x20d0, 0x20ff}, {0xfe00, 0xfe0f}, {0xfe20, 0xfe2f}};
    static constexpr Interval wide[] = {{0x1100, 0x115f},   {0x2e80, 0xa4cf},   {0xac00, 0xd7a3},
                                        {0xf900, 0xfaff},   {0xfe30, 0xfe6f},   {0xff00, 0xff60},
                                        {0xffe0, 0xffe6},   {0x1f300, 0x1f64f}, {0x1f680, 0x1f6ff},
                                        {0x1f900, 0x1faff}, {0x20000, 0x3fffd}};
    if (code_point < 0x300) return 1;
    if (is_in(code_point, std::begin(combining), std::end(combining))) return 0;
    return is_in(code_point, std::begin(wide), std::end(wide)) ? 2 : 1;
}

bool is_unprintable(char32_t code_point) {
    static constexpr Interval intervals[] = {
        {0x00, 0x1f},     {0x7f, 0x9f},     {0xad, 0xad},     {0x200b, 0x200f},  {0x2028, 0x202e},
        {0x2060, 0x206f}, {0xfeff, 0xfeff}, {0xfff0, 0xfffb}, {0xe0000, 0xe0fff}};
    return is_in(code_point, std::begin(intervals), std::end(intervals));
}

}  // namespace cascade
