// The indices of a family in a statement: the words i and 2 of `A[i, 2]: e`.
#pragma once

#include "lang/syntax/ast.h"
#include "lang/syntax/token.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace cascade {

/// The words in Statement::index, with their source locations. Empty if there is no index.
inline std::vector<ast::Word> words_of_index(const ast::Word& index) {
    if (index.empty()) return {};
    const std::size_t comma = index.text.find(',');
    if (comma == std::string_view::npos) return {index};
    const ast::Word second{index.span, index.text.substr(comma + 1)};
    std::vector<ast::Word> words{{index.span, index.text.substr(0, comma)}, second};
    words[0].span.end = index.span.begin + static_cast<std::uint32_t>(words[0].text.size());
    words[1].span.begin = index.span.end - static_cast<std::uint32_t>(words[1].text.size());
    return words;
}

/// Whether the word is the number of a member. If it is not, it is the name of an index.
inline bool is_number(const ast::Word& word) {
    return !word.empty() && word.text.front() >= '0' && word.text.front() <= '9';
}

/// Whether a statement with this index applies only to some members of a family.
inline bool is_of_some_members(const ast::Word& index) {
    return std::ranges::any_of(words_of_index(index), is_number);
}

/// Returns the position after an index such as [i] or [i, 2] that begins at token `at`. If no index
/// begins there, returns `at`.
template <typename KindAt>
std::size_t after_index(const KindAt& kind, std::size_t at) {
    if (kind(at) != TokenKind::open_square) return at;
    const std::size_t close = kind(at + 2) == TokenKind::comma ? at + 4 : at + 2;
    return kind(close) == TokenKind::close_square ? close + 1 : at;
}

}  // namespace cascade
