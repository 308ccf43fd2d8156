// Writes trees of formulas with as few brackets as possible.
#include "import/formula.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace cascade::importing {

namespace {

// The precedences of spec/grammar.md.
constexpr int of_or = 1, of_and = 2, of_not = 3, of_comparison = 4, of_sum = 5, of_product = 6,
              of_sign = 7, of_power = 8, of_operand = 9;

struct SignRule {
    std::string_view sign;
    int precedence;
    /// The lowest precedences that the left and the right operand may have without brackets.
    int left, right;
};
constexpr SignRule sign_rules[] = {
    {"or", of_or, of_or, of_and},           {"and", of_and, of_and, of_not},
    {"<", of_comparison, of_sum, of_sum},   {"<=", of_comparison, of_sum, of_sum},
    {">", of_comparison, of_sum, of_sum},   {">=", of_comparison, of_sum, of_sum},
    {"==", of_comparison, of_sum, of_sum},  {"!=", of_comparison, of_sum, of_sum},
    {"+", of_sum, of_sum, of_product},      {"-", of_sum, of_sum, of_product},
    {"*", of_product, of_product, of_sign}, {"/", of_product, of_product, of_sign},
    {"^", of_power, of_operand, of_sign},
};

const SignRule& rule_of(std::string_view sign) {
    for (const SignRule& rule : sign_rules) {
        if (rule.sign == sign) return rule;
    }
    return sign_rules[0];
}

/// A sign at the beginning of the right operand is put in brackets: `a - (-b)`.
std::string right_operand(const Expression& operand, const SignRule& rule) {
    const bool begins_with_sign =
        operand.kind == Expression::Kind::unary && rule.precedence < of_power;
    return write_formula(operand, begins_with_sign ? of_operand : rule.right);
}

}  // namespace

std::string write_formula(const Expression& formula, int least) {
    std::string text;
    int precedence = of_operand;
    switch (formula.kind) {
        case Expression::Kind::number:
        case Expression::Kind::name: return formula.text;
        case Expression::Kind::call: {
            std::vector<std::string> arguments;
            for (const Expression& each : formula.of) arguments.push_back(write_formula(each));
            return fmt::format("{}({})", formula.text, fmt::join(arguments, ", "));
        }
        case Expression::Kind::unary: {
            const bool is_not = formula.text == "not";
            precedence = is_not ? of_not : of_sign;
            text =
                (is_not ? "not " : "-") + write_formula(formula.of[0], is_not ? of_not : of_power);
            break;
        }
        case Expression::Kind::binary: {
            const SignRule& rule = rule_of(formula.text);
            precedence = rule.precedence;
            const bool is_power = formula.text == "^";
            text = write_formula(formula.of[0], rule.left) +
                   (is_power ? "^" : fmt::format(" {} ", formula.text)) +
                   right_operand(formula.of[1], rule);
            break;
        }
    }
    return precedence < least ? fmt::format("({})", text) : text;
}

}  // namespace cascade::importing
