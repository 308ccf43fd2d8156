// Words of papers, other programs and other languages, with their names in Cascade.
//
// One table contains the words that a newcomer is likely to try. Words are looked up only if they
// have no meaning in the script, so the table reserves no names.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace cascade {

/// The kind of place where an unknown word occurs.
enum class WordContext : std::uint8_t {
    stage,      ///< `dt: 0.1` in a stage, or in an option such as --set.
    domain,     ///< `size: 100` in the domain
    picture,    ///< `palette: "grey"` in the picture
    boundary,   ///< `boundary: neumann`
    side,       ///< `left: neumann`
    precision,  ///< `precision: float64`
    function,   ///< `laplacian(u)`
    value,      ///< `time` in an expression
    statement,  ///< `import "a.cascade"` at the beginning of a statement
};

/// A row: `words`, separated by blanks, and the advice on them. If the advice contains `write '…'`,
/// then a script in which the quoted text replaces the word passes the checker without further
/// changes (tests/unit/lang/hints_test.cpp). The word after `did you mean` replaces only the name.
struct WordElsewhere {
    WordContext context;
    std::string_view words;
    std::string_view advice;
};

std::span<const WordElsewhere> words_elsewhere();

/// The species `u` in u_t, u_dot, u_next, u_new, dudt and du_dt, which are names of a rate in other
/// programs. Empty for other names.
std::string_view species_of_rate(std::string_view name);

std::string_view advice_about(std::string_view word, WordContext context);

}  // namespace cascade
