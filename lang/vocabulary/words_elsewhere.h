// What papers, other programs and other languages call a thing, and what it is called here.
//
// One table answers every word that somebody who comes from elsewhere is likely to try. It is asked
// only about words that have no meaning in a script, so a row takes no name from anybody.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cascade {

/// Where a word stands that has no meaning there.
enum class WordContext : std::uint8_t {
    stage,     ///< `dt: 0.1` in a stage, or of an option such as --set
    domain,    ///< `size: 100` in the domain
    picture,   ///< `palette: "grey"` in the picture
    boundary,  ///< `boundary: neumann`
    side,      ///< `left: neumann`
    function,  ///< `laplacian(u)`
    value,     ///< `time` in an expression
};

/// A row: `words`, with blanks between them, and what to write in their place. The text in quotes
/// after `write` is that word's replacement and passes the checker as it stands
/// (tests/unit/lang/hints_test.cpp); the word of `did you mean` replaces the name alone.
struct WordElsewhere {
    WordContext context;
    std::string_view words;
    std::string_view advice;
};

std::span<const WordElsewhere> words_elsewhere();

/// The advice about a word, in small letters or capitals; empty where there is none.
std::string_view advice_about(std::string_view word, WordContext context);

}  // namespace cascade
