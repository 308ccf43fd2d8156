// Reads a formula of another program as a tree, by operator precedence.
#include "import/formula.h"
#include "import/formula_words.h"

#include "core/decimal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade::importing {

namespace {

struct ForeignOperator {
    std::string_view sign;
    int precedence;
    std::string_view meaning;
};
constexpr ForeignOperator foreign_operators[] = {
    {"or", 1, "or"}, {"and", 2, "and"}, {"==", 3, "=="}, {"!=", 3, "!="}, {"<", 4, "<"},
    {">", 4, ">"},   {"<=", 4, "<="},   {">=", 4, ">="}, {"+", 5, "+"},   {"-", 5, "-"},
    {"*", 6, "*"},   {"/", 6, "/"},     {"%", 6, "%"},   {"^", 8, "^"},   {"**", 8, "^"},
};
constexpr int of_foreign_product = 6, of_foreign_power = 8;

const ForeignOperator* operator_of(const FormulaWord& word) {
    if (word.kind == FormulaWord::Kind::number || word.kind == FormulaWord::Kind::end)
        return nullptr;
    for (const ForeignOperator& each : foreign_operators) {
        if (each.sign == word.text) return &each;
    }
    return nullptr;
}

/// The types of OpenCL that a cast or a declaration may name without changing a value.
constexpr std::string_view plain_types[] = {"float", "float4", "double", "double4"};

bool is_plain_type(std::string_view word) {
    return std::find(std::begin(plain_types), std::end(plain_types), word) != std::end(plain_types);
}

/// A number of a formula in the shortest spelling: "2.0" becomes "2". Empty if it is out of range.
std::string short_number(const std::string& text) {
    double value = 0;
    from_decimal(text.data(), text.data() + text.size(), value);
    if (!std::isfinite(value) || value > 3.4e38) return "";
    if (value != 0 && value < 1.18e-38) return "0";
    const auto is_plain = text.find_first_of("eE") == std::string::npos;
    if (!is_plain || text.front() == '.' || text.find('.') == std::string::npos) {
        return is_plain && text.front() != '.' ? text : number_text(value);
    }
    std::string shorter = text;
    while (shorter.back() == '0') shorter.pop_back();
    if (shorter.back() == '.') shorter.pop_back();
    return shorter;
}

}  // namespace

FormulaWord FormulaReader::take() {
    const FormulaWord word = words_[place_];
    if (word.kind != FormulaWord::Kind::end) ++place_;
    return word;
}

bool FormulaReader::takes(std::string_view text) {
    if (!at(text)) return false;
    ++place_;
    return true;
}

void FormulaReader::expect(std::string_view text) {
    if (takes(text)) return;
    fail(next().span, fmt::format("'{}' is missing here", text));
}

void FormulaReader::fail(Span span, std::string message, std::string hint) {
    if (!has_failed_) diagnostics_.error(span, std::move(message), std::move(hint));
    stop();
}

bool FormulaReader::implies_product() const {
    if (!dialect_.implies_products) return false;
    const FormulaWord& word = next();
    const bool is_operator = operator_of(word) != nullptr;
    return !is_operator && (word.kind == FormulaWord::Kind::name ||
                            word.kind == FormulaWord::Kind::number || at("("));
}

Expression FormulaReader::binary(int least) {
    if (++depth_ > 200) fail(next().span, "brackets are nested more than 200 deep");
    Expression left = operand();
    while (!has_failed_) {
        if (at("?") && least == 0) {
            take();
            Expression chosen = binary(0);
            expect(":");
            Expression other = binary(0);
            left = call("if", {std::move(left), std::move(chosen), std::move(other)});
        } else if (const ForeignOperator* const found = operator_of(next());
                   found != nullptr && found->precedence > least) {
            const FormulaWord sign = take();
            const bool is_power = found->precedence == of_foreign_power;
            if (sign.text == "^" && !dialect_.caret_is_power) {
                fail(sign.span,
                     "'^' combines the bits of whole numbers, which has no counterpart in Cascade");
                break;
            }
            // Powers group from the right, and exponents may have a sign.
            Expression right = binary(is_power ? found->precedence - 1 : found->precedence);
            left = joined(std::move(left), std::string(found->meaning), std::move(right));
            left.span = sign.span;
        } else if (of_foreign_product > least && implies_product()) {
            left = joined(std::move(left), "*", binary(of_foreign_product));
        } else {
            break;
        }
        if (left.depth > deepest_formula) {
            fail(next().span,
                 fmt::format("the formula is nested more than {} deep", deepest_formula));
        }
    }
    --depth_;
    return has_failed_ ? Expression{} : left;
}

Expression FormulaReader::joined(Expression left, const std::string& sign, Expression right) {
    const bool are_whole = dialect_.is_c && left.is_whole && right.is_whole;
    if (sign == "%") return call("mod", {std::move(left), std::move(right)});
    if (sign == "/" && are_whole) {
        const auto over = value_of(left), under = value_of(right);
        if (over && under && *under != 0) {
            Expression quotient = number(std::trunc(*over / *under));
            quotient.is_whole = true;
            return quotient;
        }
        fail(left.span, "C divides whole numbers without remainder here");
    }
    return operation(std::move(left), sign, std::move(right));
}

Expression FormulaReader::operand() {
    const FormulaWord word = take();
    if (word.kind == FormulaWord::Kind::number) {
        Expression made;
        made.text = short_number(word.text);
        made.span = word.span;
        made.is_whole = word.is_whole;
        if (made.text.empty()) fail(word.span, "this number is too large");
        return made;
    }
    if (word.text == "-") return negated(binary(of_foreign_product));
    if (word.text == "+") return binary(of_foreign_product);
    if (word.text == "!" || (word.kind == FormulaWord::Kind::name && word.text == "not")) {
        Expression made = negated(Expression{.kind = Expression::Kind::name});
        made.text = "not";
        made.of = {binary(dialect_.is_c ? of_foreign_product : 2)};
        made.depth = made.of[0].depth + 1;
        return made;
    }
    if (word.text == "(" && word.kind == FormulaWord::Kind::sign) return after_bracket();
    if (word.kind == FormulaWord::Kind::name) return of_name(word);
    fail(word.span, word.kind == FormulaWord::Kind::end
                        ? "the formula ends here, where a value is missing"
                        : fmt::format("a value is missing before '{}'", word.text));
    return {};
}

Expression FormulaReader::after_bracket() {
    if (dialect_.is_c && next().kind == FormulaWord::Kind::name &&
        words_[std::min(place_ + 1, words_.size() - 1)].text == ")") {
        const bool is_cast = is_plain_type(next().text);
        if (is_cast) {
            take();
            take();
            return binary(of_foreign_power);
        }
    }
    Expression inner = binary(0);
    if (dialect_.is_c && at(",")) {
        fail(next().span, "a vector of several values has no counterpart in Cascade");
    }
    expect(")");
    if (dialect_.is_c && at("."))
        fail(next().span, "components of vectors have no counterpart in Cascade");
    return inner;
}

Expression FormulaReader::of_name(const FormulaWord& word) {
    Expression made = name(word.text);
    made.span = word.span;
    if (dialect_.is_c && at("."))
        fail(next().span, "components of vectors have no counterpart in Cascade");
    if (at("[") && dialect_.is_c) fail(next().span, "arrays have no counterpart in Cascade");
    const std::string_view close = at("[") ? "]" : ")";
    if (!at("(") && !at("[")) return made;
    // A value at another cell, u[x + 1, y], is read as the call of a function "u[".
    if (at("[")) made.text += "[";
    take();
    made.kind = Expression::Kind::call;
    while (!has_failed_ && !at(close)) {
        made.of.push_back(binary(0));
        made.depth = std::max(made.depth, made.of.back().depth + 1);
        if (!takes(",") && !at(close))
            fail(next().span, fmt::format("'{}' is missing here", close));
    }
    expect(close);
    // Reads XPPAUT's if(a)then(b)else(c).
    if (made.text == "if" && made.of.size() == 1 && takes("then")) {
        made.of.push_back(operand());
        expect("else");
        made.of.push_back(operand());
        for (const Expression& each : made.of) made.depth = std::max(made.depth, each.depth + 1);
    }
    return made;
}

std::optional<Expression> read_formula(Span span, const Sources& sources, Diagnostics& diagnostics,
                                       const Dialect& dialect) {
    const auto words = formula_words(span, sources, diagnostics, dialect);
    if (!words) return std::nullopt;
    FormulaReader reader(*words, diagnostics, dialect);
    Expression formula = reader.expression();
    if (!reader.has_failed() && reader.next().kind != FormulaWord::Kind::end) {
        reader.fail(reader.next().span,
                    fmt::format("the formula should end before '{}'", reader.next().text));
    }
    if (reader.has_failed()) return std::nullopt;
    return formula;
}

}  // namespace cascade::importing
