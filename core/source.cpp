// Source texts: the starts of their lines, and locations in them.
#include "core/source.h"

#include "core/check.h"
#include "core/utf8.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace cascade {

namespace {

/// The byte order mark, which some editors write at the start of a file. It does not count as a
/// character.
constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

/// Lines end with LF, CR LF or CR.
std::vector<std::uint32_t> find_line_starts(std::string_view text) {
    std::vector<std::uint32_t> starts;
    starts.push_back(text.starts_with(byte_order_mark) ? 3 : 0);
    for (std::size_t k = 0; k < text.size(); ++k) {
        const bool ends_here =
            text[k] == '\n' || (text[k] == '\r' && !text.substr(k + 1).starts_with('\n'));
        if (ends_here) starts.push_back(static_cast<std::uint32_t>(k + 1));
    }
    return starts;
}

}  // namespace

Span join(Span first, Span last) {
    CHECK(first.source == last.source, "a span lies in one source");
    return {first.source, std::min(first.begin, last.begin), std::max(first.end, last.end)};
}

Source::Source(std::string name, std::string text)
    : name_(std::move(name)), text_(std::move(text)), line_starts_(find_line_starts(text_)) {
    CHECK(text_.size() < std::numeric_limits<std::uint32_t>::max(),
          "spans count bytes in 32 bits; larger files are refused before they are read");
}

Location Source::locate(std::uint32_t offset) const {
    offset = std::min(offset, static_cast<std::uint32_t>(text_.size()));
    const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
    if (after == line_starts_.begin()) return {1, 1};  // Inside the byte order mark.
    const std::uint32_t start = *(after - 1);
    const auto before = std::string_view(text_).substr(start, offset - start);
    return {static_cast<std::uint32_t>(after - line_starts_.begin()),
            static_cast<std::uint32_t>(count_code_points(before)) + 1};
}

std::string_view Source::line(std::uint32_t line) const {
    if (line == 0 || line > line_starts_.size()) return {};
    const std::uint32_t begin = line_starts_[line - 1];
    const std::size_t end = line < line_starts_.size() ? line_starts_[line] : text_.size();
    std::string_view content = std::string_view(text_).substr(begin, end - begin);
    if (content.ends_with('\n')) content.remove_suffix(1);
    if (content.ends_with('\r')) content.remove_suffix(1);
    return content;
}

SourceId Sources::add(std::string name, std::string text) {
    sources_.emplace_back(std::move(name), std::move(text));
    return static_cast<SourceId>(sources_.size() - 1);
}

std::string_view Sources::text(Span span) const {
    CHECK(span.source < sources_.size(), "a span names one of the sources");
    const std::string_view text = sources_[span.source].text();
    const std::size_t begin = std::min<std::size_t>(span.begin, text.size());
    const std::size_t end = std::clamp<std::size_t>(span.end, begin, text.size());
    return text.substr(begin, end - begin);
}

}  // namespace cascade
