// The layout of messages.
#include "core/counted.h"
#include "core/diagnostics.h"
#include "core/printable.h"
#include "core/utf8.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace cascade {

namespace {

// The largest number of columns shown of a source line.
constexpr std::size_t widest_excerpt = 100;
constexpr std::size_t columns_in_front =
    60;  // If a span begins further right, the start of its line is left out.
constexpr std::size_t columns_kept = 40;  // The number of characters then shown before the span.
constexpr std::size_t tab_stop = 8;
constexpr std::string_view ellipsis = "\xe2\x80\xa6";  // U+2026.

/// The colours of a message; all empty for output to a file.
struct Colours {
    std::string_view bold, error, warning, note, hint, plain;
};

Colours colours_of(const RenderStyle& style) {
    if (!style.colour) return {};
    return {"\x1b[1m", "\x1b[1;31m", "\x1b[1;35m", "\x1b[1;36m", "\x1b[32m", "\x1b[0m"};
}

/// The shown part of a source line, and the columns underlined in it.
struct Excerpt {
    std::string text;
    std::size_t marker_begin = 0;
    std::size_t marker_width = 0;
};

/// The byte at which the excerpt begins: the line's start, or some characters before the span.
std::size_t excerpt_begin(std::string_view line, std::size_t span_begin) {
    // A character has at most 4 bytes.
    const bool may_be_near = span_begin <= 4 * columns_in_front;
    if (may_be_near && count_code_points(line.substr(0, span_begin)) <= columns_in_front) return 0;
    std::size_t begin = span_begin;
    for (std::size_t k = 0; k < columns_kept && begin > 0; ++k) {
        do {
            --begin;
        } while (begin > 0 && (static_cast<unsigned char>(line[begin]) & 0xc0) == 0x80);
    }
    return begin;
}

/// `span_begin` and `span_end` are byte offsets in the line.
Excerpt make_excerpt(std::string_view line, std::size_t span_begin, std::size_t span_end) {
    Excerpt excerpt;
    std::size_t column = 0;
    std::size_t offset = excerpt_begin(line, span_begin);
    if (offset > 0) {
        excerpt.text = ellipsis;
        column = 1;
    }
    std::size_t marker_end = 0;
    while (offset < line.size() && column < widest_excerpt) {
        if (offset <= span_begin) excerpt.marker_begin = column;
        const CodePoint point = decode_utf8(line, offset);
        std::size_t width = 1;
        if (point.value == '\t') {
            width = tab_stop - column % tab_stop;
            excerpt.text.append(width, ' ');
        } else if (!point.valid || is_unprintable(point.value)) {
            excerpt.text += replacement_character;
        } else {
            width = static_cast<std::size_t>(display_width(point.value));
            excerpt.text += line.substr(offset, point.size);
        }
        column += width;
        offset += point.size;
        if (offset <= span_end) marker_end = column;
    }
    if (span_begin >= offset) excerpt.marker_begin = column;
    if (offset < line.size()) excerpt.text += ellipsis;
    excerpt.marker_width = std::max(marker_end, excerpt.marker_begin + 1) - excerpt.marker_begin;
    return excerpt;
}

/// The source line of a span, underlined, followed by the hint.
std::string draw_excerpt(Span span, std::string_view hint, const Sources& sources,
                         const Colours& colours) {
    const Source& source = sources[span.source];
    const Location location = source.locate(span.begin);
    const std::string_view line = source.line(location.line);
    const auto line_begin = static_cast<std::size_t>(line.data() - source.text().data());
    const auto in_line = [&](std::uint32_t offset) {
        return std::min(offset > line_begin ? offset - line_begin : 0, line.size());
    };
    const Excerpt excerpt = make_excerpt(line, in_line(span.begin), in_line(span.end));
    std::string result = fmt::format("{:>5} | {}\n", location.line, excerpt.text);
    result += fmt::format("{:>5} | {}{}^{}", "", std::string(excerpt.marker_begin, ' '),
                          colours.hint, std::string(excerpt.marker_width - 1, '~'));
    if (!hint.empty()) result += " " + printable(hint);
    result += colours.plain;
    return result + "\n";
}

/// `name:line:column: `; empty for a span without a source.
std::string draw_place(Span span, const Sources& sources) {
    if (span.source >= sources.size()) return {};
    const Source& source = sources[span.source];
    const Location location = source.locate(span.begin);
    return fmt::format("{}:{}:{}: ", printable(source.name()), location.line, location.column);
}

std::string draw_note(const Note& note, const Sources& sources, const Colours& colours) {
    std::string result;
    if (note.span) {
        result += colours.bold;
        result += draw_place(*note.span, sources);
        result += colours.plain;
    }
    result += fmt::format("{}note:{} {}\n", colours.note, colours.plain, printable(note.message));
    if (note.span && note.span->source < sources.size()) {
        result += draw_excerpt(*note.span, "", sources, colours);
    }
    return result;
}

}  // namespace

std::string render(const Diagnostic& diagnostic, const Sources& sources, const RenderStyle& style) {
    const Colours colours = colours_of(style);
    const bool is_error = diagnostic.severity == Severity::error;
    std::string result =
        fmt::format("{}{}{}{}:{} {}{}{}\n", colours.bold, draw_place(diagnostic.span, sources),
                    is_error ? colours.error : colours.warning, is_error ? "error" : "warning",
                    colours.plain, colours.bold, printable(diagnostic.message), colours.plain);
    if (diagnostic.span.source < sources.size()) {
        result += draw_excerpt(diagnostic.span, diagnostic.hint, sources, colours);
    } else if (!diagnostic.hint.empty()) {
        result += fmt::format("hint: {}\n", printable(diagnostic.hint));
    }
    for (const Note& note : diagnostic.notes) result += draw_note(note, sources, colours);
    return result;
}

std::string render(const Diagnostics& diagnostics, const Sources& sources,
                   const RenderStyle& style) {
    std::string result;
    std::size_t errors_left = diagnostics.error_count();
    std::size_t warnings_left = diagnostics.warning_count();
    std::size_t drawn = 0;
    for (const Diagnostic& diagnostic : diagnostics.sorted()) {
        if (drawn++ == style.most) break;
        result += render(diagnostic, sources, style);
        --(diagnostic.severity == Severity::error ? errors_left : warnings_left);
    }
    std::string rest;
    if (errors_left > 0) rest = counted(errors_left, "more error");
    if (warnings_left > 0)
        rest += (rest.empty() ? "" : " and ") + counted(warnings_left, "more warning");
    if (!rest.empty()) result += fmt::format("{} not shown\n", rest);
    return result;
}

}  // namespace cascade
