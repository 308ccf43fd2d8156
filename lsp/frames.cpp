// Reads headers line by line. Unknown fields are ignored, as the protocol requires.
#include "lsp/frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

namespace cascade::lsp {
namespace {

bool is_equal_in_lower_case(std::string_view text, std::string_view lower) {
    return std::ranges::equal(text, lower, [](char a, char b) {
        return a == b || (a >= 'A' && a <= 'Z' && a - 'A' + 'a' == b);
    });
}

std::string_view without_blanks(std::string_view text) {
    const std::size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<std::size_t> number_in(std::string_view text) {
    std::size_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

std::string framed(std::string_view body) {
    return fmt::format("Content-Length: {}\r\n\r\n{}", body.size(), body);
}

void FrameReader::add(std::string_view bytes) {
    if (begin_ > 0) bytes_.erase(0, std::exchange(begin_, 0));
    bytes_ += bytes;
}

/// Reads the header at the start of the bytes, if it is complete.
bool FrameReader::read_header() {
    std::size_t at = begin_;
    std::optional<std::size_t> length;
    for (;;) {
        const std::size_t end = bytes_.find('\n', at);
        if (std::min(end, bytes_.size()) - begin_ > largest_header) {
            fault_ = fmt::format("a header has more than {} bytes", largest_header);
            return false;
        }
        if (end == std::string::npos) return false;
        std::string_view line(bytes_.data() + at, end - at);
        if (line.ends_with('\r')) line.remove_suffix(1);
        at = end + 1;
        if (line.empty()) break;
        const std::size_t colon = line.find(':');
        if (colon == std::string_view::npos) {
            fault_ = "a line of a header has no colon";
            return false;
        }
        if (!is_equal_in_lower_case(line.substr(0, colon), "content-length")) continue;
        length = number_in(without_blanks(line.substr(colon + 1)));
        if (!length) {
            fault_ = "Content-Length is not a number of bytes";
            return false;
        }
    }
    if (!length) {
        fault_ = "a header has no Content-Length";
        return false;
    }
    begin_ = at;
    length_ = length;
    is_dropped_ = *length > largest_message;
    return true;
}

std::optional<FrameReader::Frame> FrameReader::next() {
    if (!fault_.empty()) return std::nullopt;
    if (!length_ && !read_header()) return std::nullopt;
    const std::size_t here = std::min(*length_, bytes_.size() - begin_);
    if (is_dropped_) {
        begin_ += here;
        *length_ -= here;
        if (*length_ > 0) return std::nullopt;
        length_.reset();
        return Frame{"", true};
    }
    if (here < *length_) return std::nullopt;
    Frame frame{bytes_.substr(begin_, here)};
    begin_ += here;
    length_.reset();
    return frame;
}

}  // namespace cascade::lsp
