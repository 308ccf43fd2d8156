// Reads the text once, and sets marks. Later searches begin at the nearest mark.
#include "lsp/lines.h"

#include "core/utf8.h"

#include <algorithm>

namespace cascade::lsp {
namespace {

constexpr std::size_t between_marks = 1024;

std::size_t units_of(const CodePoint& point, ColumnUnit unit) {
    if (unit == ColumnUnit::utf8) return point.size;
    return point.value > 0xffff ? 2 : 1;
}

bool ends_line(std::string_view text, std::size_t byte) {
    return text[byte] == '\n' || text[byte] == '\r';
}

}  // namespace

Lines::Lines(std::string_view text, ColumnUnit unit) : unit_(unit), marks_{{0, 0, 0}} {
    std::uint32_t line = 0, column = 0;
    std::size_t last = 0;
    for (std::size_t byte = 0; byte < text.size();) {
        const CodePoint point = decode_utf8(text, byte);
        const bool is_end =
            text[byte] == '\n' || (text[byte] == '\r' && !text.substr(byte + 1).starts_with('\n'));
        byte += point.size;
        column += static_cast<std::uint32_t>(units_of(point, unit));
        if (!is_end && byte - last < between_marks) continue;
        if (is_end) {
            ++line;
            column = 0;
        }
        // There is no mark between CR and LF, because a column there means the end of the line,
        // which is before CR.
        if (!is_end && text[byte - 1] == '\r') continue;
        last = byte;
        marks_.push_back({static_cast<std::uint32_t>(byte), line, column});
    }
}

Position Lines::position_of(std::string_view text, std::size_t byte) const {
    byte = std::min(byte, text.size());
    const auto after = std::ranges::upper_bound(marks_, byte, {}, &Mark::byte);
    const Mark& mark = *std::prev(after);
    Position position{mark.line, mark.column};
    for (std::size_t at = mark.byte; at < byte;) {
        const CodePoint point = decode_utf8(text, at);
        if (at + point.size > byte) break;
        at += point.size;
        position.column += units_of(point, unit_);
    }
    return position;
}

std::size_t Lines::byte_at(std::string_view text, Position position) const {
    if (position.line > marks_.back().line) return text.size();
    const auto key = [](const Mark& mark) { return Position{mark.line, mark.column}; };
    const auto after = std::ranges::upper_bound(marks_, position, {}, key);
    const Mark& mark = *std::prev(after);
    std::size_t byte = mark.byte, column = mark.column;
    while (byte < text.size() && !ends_line(text, byte)) {
        const CodePoint point = decode_utf8(text, byte);
        column += units_of(point, unit_);
        if (column > position.column) break;
        byte += point.size;
    }
    return byte;
}

}  // namespace cascade::lsp
