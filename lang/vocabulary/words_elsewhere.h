// Terms of papers, other programs and other languages, and what they are called here.
//
// One table holds the words that a newcomer is likely to try. It is consulted only for words that
// have no meaning in a script, so it reserves no names.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cascade {

/// Where an unknown word stands.
enum class WordContext : std::uint8_t {
    stage,      ///< `dt: 0.1` in a stage, or of an option such as --set
    domain,     ///< `size: 100` in the domain
    picture,    ///< `palette: "grey"` in the picture
    boundary,   ///< `boundary: neumann`
    side,       ///< `left: neumann`
    function,   ///< `laplacian(u)`
    value,      ///< `time` in an expression
    statement,  ///< `import "a.cascade"`, where a statement begins
};

/// A row: `words`, separated by blanks, and what to write instead. The text in quotes after `write`
/// replaces the word and passes the checker as it stands (tests/unit/lang/hints_test.cpp); the word
/// after `did you mean` replaces the name alone.
struct WordElsewhere {
    WordContext context;
    std::string_view words;
    std::string_view advice;
};

std::span<const WordElsewhere> words_elsewhere();

/// The advice about a word, regardless of case; empty if there is none.
/// The `u` of u_t, u_dot, dudt and du_dt, the names of a rate in other programs; else empty.
std::string_view species_of_rate(std::string_view name);

std::string_view advice_about(std::string_view word, WordContext context);

}  // namespace cascade
