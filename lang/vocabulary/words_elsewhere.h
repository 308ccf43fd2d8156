// Words that papers, other programs and other languages use, and what to write in Cascade.
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
    stage,      ///< `dt: 0.1` in a stage or in an option such as --set
    domain,     ///< `size: 100` in a domain
    picture,    ///< `palette: "grey"` in a picture
    boundary,   ///< `boundary: neumann`
    side,       ///< `left: neumann`
    precision,  ///< `precision: float64`
    function,   ///< `laplacian(u)`
    value,      ///< `time` in an expression
    statement,  ///< `import "a.cascade"` at the beginning of a statement
};

/// A row of the table: `words`, separated by blanks, and the advice on each of these words. If the
/// advice contains `write '…'`, a script in which the quoted text replaces the word passes the
/// checker without further changes (tests/unit/lang/hints_test.cpp). If the advice contains `did
/// you mean '…'`, the quoted word replaces only the name.
struct WordElsewhere {
    WordContext context;
    std::string_view words;
    std::string_view advice;
};

std::span<const WordElsewhere> words_elsewhere();

/// The species `u` in u_t, u_dot, u_next, u_new, dudt or du_dt, as other programs name a rate or a
/// next value. Empty for other names.
std::string_view species_of_rate(std::string_view name);

std::string_view advice_about(std::string_view word, WordContext context);

}  // namespace cascade
