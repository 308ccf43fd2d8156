// The lines of a text file, their words, and the numbers that words are.
#pragma once

#include <charconv>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// What stands between blanks, tabs and other white space.
std::vector<std::string_view> words_of(std::string_view line);

/// A number with or without a sign, a fraction, an exponent; also "nan" and "inf". What is nearer
/// to 0 than any number is 0, what is beyond all numbers is infinite. Nothing for any other word.
std::optional<double> number_in(std::string_view word);

/// A whole number that fits its type, with or without a sign.
template <typename Integer>
std::optional<Integer> whole_number_in(std::string_view word) {
    if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
    Integer value = 0;
    const auto [stop, fault] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (fault != std::errc() || stop != word.data() + word.size()) return std::nullopt;
    return value;
}

/// The lines of a text that hold words, one by one. What follows a '#' is a comment.
class LineReader {
public:
    explicit LineReader(std::string_view text) : text_(text) {}

    /// The words of the next line; none at the end.
    const std::vector<std::string_view>& next();
    /// Of the line read last, from 1.
    std::size_t number() const { return number_; }

private:
    std::string_view text_;
    std::size_t at_ = 0, number_ = 0;
    std::vector<std::string_view> words_;
};

}  // namespace cascade
