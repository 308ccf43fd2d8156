// Formulas of other programs as trees, and trees as text of the language.
//
// Every program writes formulas in its own dialect. A reader parses a formula, replaces the names
// and functions by Cascade's, and writes the tree with as few brackets as possible.
#pragma once

#include "core/diagnostics.h"
#include "core/source.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::importing {

/// A part of a formula.
struct Expression {
    enum class Kind : std::uint8_t {
        number,  ///< `text` is the number as written in Cascade.
        name,    ///< `text` is the name.
        call,    ///< `text` is the name of the function, `of` are its arguments.
        unary,   ///< `text` is "-" or "not".
        binary,  ///< `text` is an operator of Cascade, such as "+", "^" or "and".
    };
    Kind kind = Kind::number;
    std::string text = "0";
    std::vector<Expression> of = {};
    Span span = {};         ///< The place in the source.
    bool is_whole = false;  ///< Whether C computes the formula with integers, so that 1/2 is 0.
    std::uint32_t depth = 1;

    bool is_number(std::string_view value) const { return kind == Kind::number && text == value; }
    bool is_name(std::string_view value) const { return kind == Kind::name && text == value; }
};

/// The largest depth of a tree. Deeper formulas are refused, because trees are traversed
/// recursively.
inline constexpr std::uint32_t deepest_formula = 1000;

/// The style in which a program writes formulas.
struct Dialect {
    bool is_c = false;              ///< Has casts, suffixes of numbers, and integer division.
    bool caret_is_power = false;    ///< `^` and `**` are powers.
    bool implies_products = false;  ///< `2u` and `k(1 - u)` are products.
    bool ignores_case = false;      ///< Names are converted to small letters.
};

Expression number(double value);
Expression name(std::string text);
Expression call(std::string function, std::vector<Expression> arguments);
Expression negated(Expression operand);
/// Joins two operands by an operator. Simplifies sums with 0, and products and quotients with 1.
Expression operation(Expression left, std::string_view sign, Expression right);

/// A number as text of the language, with up to nine digits.
std::string number_text(double value);

/// Reads the formula at `span` of a source. If it is not a formula, reports an error and returns an
/// empty optional. In XML texts `&lt;`, `&gt;` and `&amp;` are read as the signs that they mean.
std::optional<Expression> read_formula(Span span, const Sources& sources, Diagnostics& diagnostics,
                                       const Dialect& dialect);

/// The tree as text, in brackets if the precedence of its operator is below `least`. Precedences of
/// the language go from 1 (`or`) to 9 (operands).
std::string write_formula(const Expression& formula, int least = 0);

/// Replaces each name and each call by what `replace` returns for it. The arguments of a call are
/// replaced before the call. If `replace` returns an empty optional, the name or call stays.
using Replace = std::function<std::optional<Expression>(const Expression&)>;
Expression replaced(const Expression& formula, const Replace& replace);

/// A function of another program. `meaning` is a formula of Cascade, in which A, B, C and D are the
/// arguments.
struct ForeignFunction {
    std::string_view name;
    std::size_t arguments;
    std::string_view meaning;
};
/// Replaces a call by its meaning in a table. Empty if the table lacks the function.
std::optional<Expression> meaning_of(const Expression& function,
                                     std::span<const ForeignFunction> table);

/// Evaluates a formula of numbers and functions of numbers. Empty if it contains a name or another
/// function.
std::optional<double> value_of(const Expression& formula);

/// Whether `formula` contains the name.
bool mentions(const Expression& formula, std::string_view name);

}  // namespace cascade::importing
