// Parses numbers by from_decimal(). Numbers out of range become 0 or infinity.
#include "mesh/text_words.h"

#include "core/decimal.h"

#include <algorithm>
#include <limits>

namespace cascade {

std::vector<std::string_view> words_of(std::string_view line) {
    constexpr std::string_view blank = " \t\r\v\f";
    std::vector<std::string_view> words;
    for (std::size_t at = line.find_first_not_of(blank); at != std::string_view::npos;
         at = line.find_first_not_of(blank, at)) {
        const std::size_t end = std::min(line.find_first_of(blank, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = end;
    }
    return words;
}

std::optional<double> number_in(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    double value = 0;
    const auto [stop, fault] = from_decimal(word.data(), word.data() + word.size(), value);
    if (fault == std::errc::invalid_argument || stop != word.data() + word.size()) {
        return std::nullopt;
    }
    if (fault == std::errc()) return value;
    // from_decimal() does not say whether the number is too large or too small. The sign of the
    // exponent shows this. Without an exponent, the number is too large if it has digits before the
    // point.
    const bool is_negative = word.starts_with('-');
    if (is_negative) word.remove_prefix(1);
    const std::size_t exponent = word.find_first_of("eE");
    const bool is_small = exponent != std::string_view::npos
                              ? word.substr(exponent + 1).starts_with('-')
                              : std::min(word.find_first_not_of('0'), word.size()) ==
                                    std::min(word.find('.'), word.size());
    const double size = is_small ? 0 : std::numeric_limits<double>::infinity();
    return is_negative ? -size : size;
}

bool is_utf16(std::string_view text) {
    if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff")) return true;
    if (text.size() < 4) return false;
    const auto is_zero = [&](std::size_t k) { return text[k] == 0; };
    return is_zero(0) == is_zero(2) && is_zero(1) == is_zero(3) && is_zero(0) != is_zero(1);
}

tl::unexpected<Failure> utf16_failure() {
    return failure("the file is text in UTF-16, which Cascade cannot read", "save it as UTF-8");
}

LineReader::LineReader(std::string_view text) : text_(text) {
    constexpr std::string_view mark = "\xef\xbb\xbf";
    if (text.starts_with(mark)) at_ = mark.size();
}

const std::vector<std::string_view>& LineReader::next() {
    words_.clear();
    while (words_.empty() && at_ < text_.size()) {
        const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
        std::string_view line = text_.substr(at_, end - at_);
        line = line.substr(0, line.find('#'));
        const bool has_both = text_.substr(end, 2) == "\r\n";
        at_ = std::min(end + (has_both ? 2 : 1), text_.size());
        ++number_;
        words_ = words_of(line);
    }
    return words_;
}

}  // namespace cascade
