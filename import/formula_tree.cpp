// Builds trees of formulas, and replaces their names and functions.
#include "import/formula.h"

#include "core/check.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::importing {

namespace {

Expression with_operands(Expression node) {
    for (const Expression& operand : node.of) {
        node.depth = std::max(node.depth, operand.depth + 1);
        if (node.span.begin == node.span.end) node.span = operand.span;
    }
    return node;
}

}  // namespace

std::string number_text(double value) {
    return fmt::format("{}", value);  // The fewest digits that read back as this number.
}

Expression number(double value) {
    if (value < 0) return negated(number(-value));
    Expression node;
    node.text = number_text(value);
    return node;
}

Expression name(std::string text) {
    Expression node;
    node.kind = Expression::Kind::name;
    node.text = std::move(text);
    return node;
}

Expression call(std::string function, std::vector<Expression> arguments) {
    Expression node = name(std::move(function));
    node.kind = Expression::Kind::call;
    node.of = std::move(arguments);
    return with_operands(std::move(node));
}

Expression negated(Expression operand) {
    if (operand.is_number("0")) return operand;
    Expression node = name("-");
    node.kind = Expression::Kind::unary;
    node.is_whole = operand.is_whole;
    node.of.push_back(std::move(operand));
    return with_operands(std::move(node));
}

namespace {

/// `formula` without the minus sign at its beginning, such as a / b for -a / b. Empty if there is
/// no such sign.
std::optional<Expression> without_sign(const Expression& formula) {
    if (formula.kind == Expression::Kind::unary && formula.text == "-") return formula.of[0];
    const bool is_product =
        formula.kind == Expression::Kind::binary && (formula.text == "*" || formula.text == "/");
    if (!is_product) return std::nullopt;
    auto first = without_sign(formula.of[0]);
    if (!first) return std::nullopt;
    Expression made = formula;
    made.of[0] = std::move(*first);
    return made;
}

}  // namespace

Expression operation(Expression left, std::string_view sign, Expression right) {
    const bool is_sum = sign == "+" || sign == "-";
    if (is_sum && !left.is_number("0")) {
        if (auto opposite = without_sign(right)) {
            right = std::move(*opposite);
            sign = sign == "+" ? "-" : "+";
        }
    }
    const bool is_product = sign == "*";
    if (is_sum && right.is_number("0")) return left;
    if (sign == "+" && left.is_number("0")) return right;
    if (sign == "-" && left.is_number("0")) return negated(std::move(right));
    if ((is_product || sign == "/") && right.is_number("1")) return left;
    if (is_product && left.is_number("1")) return right;
    Expression node = name(std::string(sign));
    node.kind = Expression::Kind::binary;
    node.is_whole = left.is_whole && right.is_whole;
    node.of.push_back(std::move(left));
    node.of.push_back(std::move(right));
    return with_operands(std::move(node));
}

Expression replaced(const Expression& formula, const Replace& replace) {
    if (formula.depth > deepest_formula) return formula;
    Expression result = formula;
    for (Expression& operand : result.of) operand = replaced(operand, replace);
    for (const Expression& operand : result.of) {
        result.depth = std::max(result.depth, operand.depth + 1);
    }
    const bool may_change =
        formula.kind == Expression::Kind::name || formula.kind == Expression::Kind::call;
    if (!may_change) return result;
    auto other = replace(result);
    if (!other) return result;
    other->span = formula.span;
    return std::move(*other);
}

namespace {

/// A call with more parts than this is not replaced by its meaning. A meaning may repeat arguments,
/// so nested calls could grow without bound.
constexpr std::size_t largest_call = 20'000;

/// Counts the parts of a formula until there are more than `most`.
std::size_t count_parts(const Expression& formula, std::size_t most) {
    std::size_t count = 1;
    for (const Expression& operand : formula.of) {
        if (count > most) break;
        count += count_parts(operand, most - count);
    }
    return count;
}

}  // namespace

std::optional<Expression> meaning_of(const Expression& function,
                                     std::span<const ForeignFunction> table) {
    if (count_parts(function, largest_call) > largest_call) return std::nullopt;
    const auto row = std::find_if(table.begin(), table.end(), [&](const ForeignFunction& each) {
        return each.name == function.text && each.arguments == function.of.size();
    });
    if (row == table.end()) return std::nullopt;
    Sources sources;
    Diagnostics diagnostics;
    const SourceId source = sources.add("meaning", std::string(row->meaning));
    Dialect own;
    own.caret_is_power = true;
    const auto meaning = read_formula({source, 0, static_cast<std::uint32_t>(row->meaning.size())},
                                      sources, diagnostics, own);
    CHECK(meaning, "the meaning of a foreign function is a formula");
    return replaced(*meaning, [&](const Expression& part) -> std::optional<Expression> {
        const bool is_argument = part.kind == Expression::Kind::name && part.text.size() == 1 &&
                                 part.text[0] >= 'A' &&
                                 part.text[0] < static_cast<char>('A' + function.of.size());
        if (!is_argument) return std::nullopt;
        return function.of[static_cast<std::size_t>(part.text[0] - 'A')];
    });
}

std::optional<double> value_of(const Expression& formula) {
    std::vector<double> values;
    for (const Expression& operand : formula.of) {
        const auto value = value_of(operand);
        if (!value) return std::nullopt;
        values.push_back(*value);
    }
    const std::string& text = formula.text;
    switch (formula.kind) {
        case Expression::Kind::number: return std::stod(text);
        case Expression::Kind::name:
            if (text == "pi") return std::numbers::pi;
            return std::nullopt;
        case Expression::Kind::unary:
            if (text == "-") return -values[0];
            return std::nullopt;
        case Expression::Kind::binary:
            if (text == "+") return values[0] + values[1];
            if (text == "-") return values[0] - values[1];
            if (text == "*") return values[0] * values[1];
            if (text == "/") return values[0] / values[1];
            if (text == "^") return std::pow(values[0], values[1]);
            return std::nullopt;
        case Expression::Kind::call:
            if (text == "sqrt" && values.size() == 1) return std::sqrt(values[0]);
            if (text == "exp" && values.size() == 1) return std::exp(values[0]);
            if (text == "floor" && values.size() == 1) return std::floor(values[0]);
            return std::nullopt;
    }
    return std::nullopt;
}

bool mentions(const Expression& formula, std::string_view name) {
    return formula.is_name(name) ||
           std::any_of(formula.of.begin(), formula.of.end(),
                       [&](const Expression& operand) { return mentions(operand, name); });
}

}  // namespace cascade::importing
