// Divides a formula of another program into words. Internal to read_formula.cpp and to readers of
// programs with several statements.
#pragma once

#include "import/formula.h"

#include <string>
#include <vector>

namespace cascade::importing {

struct FormulaWord {
    enum class Kind : std::uint8_t { number, name, sign, end };
    Kind kind = Kind::end;
    std::string text;
    Span span;
    bool is_whole = false;  ///< Whether the word is a number without a point or an exponent.
};

/// The largest number of words in one formula or list of statements.
inline constexpr std::size_t most_formula_words = 100'000;

/// The words of a text, followed by `end`. Comments of C are left out. If some letter belongs to no
/// word, reports an error and returns an empty optional.
std::optional<std::vector<FormulaWord>> formula_words(Span span, const Sources& sources,
                                                      Diagnostics& diagnostics,
                                                      const Dialect& dialect);

/// Replaces each loop `for (int i = 0; i < 5; i++) { … }` by its statements, written once for each
/// turn. Turns elements of arrays into names: `u[2]` becomes `u_2`. Loops of another form stay as
/// they are.
std::vector<FormulaWord> unroll_loops(std::vector<FormulaWord> words);

/// Reads expressions from words, by operator precedence. After an error, all further results are 0
/// and has_failed() is true.
class FormulaReader {
public:
    FormulaReader(const std::vector<FormulaWord>& words, Diagnostics& diagnostics,
                  const Dialect& dialect)
        : words_(words), diagnostics_(diagnostics), dialect_(dialect) {}

    const FormulaWord& next() const { return words_[place_]; }
    bool at(std::string_view text) const {
        return next().kind != FormulaWord::Kind::end && next().text == text;
    }
    FormulaWord take();
    /// Takes the next word if it is `text`. Returns whether it was taken.
    bool takes(std::string_view text);
    void expect(std::string_view text);
    Expression expression() { return binary(0); }

    bool has_failed() const { return has_failed_; }
    void fail(Span span, std::string message, std::string hint = "");
    /// Ends the reading after an error that has been reported.
    void stop() {
        has_failed_ = true;
        place_ = words_.size() - 1;
    }

private:
    Expression binary(int least);
    Expression operand();
    Expression after_bracket();
    Expression of_name(const FormulaWord& word);
    Expression joined(Expression left, const std::string& sign, Expression right);
    bool implies_product() const;

    const std::vector<FormulaWord>& words_;
    Diagnostics& diagnostics_;
    const Dialect& dialect_;
    std::size_t place_ = 0;
    std::uint32_t depth_ = 0;
    bool has_failed_ = false;
};

}  // namespace cascade::importing
