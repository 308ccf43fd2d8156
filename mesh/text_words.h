// Reads text files: lines, their words, and numbers in words.
#pragma once

#include "core/result.h"

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// The words between white space.
std::vector<std::string_view> words_of(std::string_view line);

/// A number with an optional sign, fraction and exponent, or "nan" or "inf". Numbers out of range
/// become 0 or infinity. nullopt for any other word.
std::optional<double> number_in(std::string_view word);

/// An integer that fits its type, with an optional sign.
template <typename Integer>
std::optional<Integer> whole_number_in(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    Integer value = 0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || stop != word.data() + word.size()) return std::nullopt;
    return value;
}

/// Whether a text is UTF-16 of either byte order, in which every Latin letter has a byte of 0.
bool is_utf16(std::string_view text);

/// The failure for a model file in UTF-16.
tl::unexpected<Failure> utf16_failure();

/// Iterates over the lines of a text that have words. A '#' starts a comment. Lines end with a line
/// feed, a carriage return, or both.
class LineReader {
public:
    /// Skips a byte order mark of UTF-8.
    explicit LineReader(std::string_view text);

    /// The words of the next line. Empty at the end.
    const std::vector<std::string_view>& next();
    /// The number of the current line, from 1.
    std::size_t number() const { return number_; }

private:
    std::string_view text_;
    std::size_t at_ = 0, number_ = 0;
    std::vector<std::string_view> words_;
};

}  // namespace cascade
