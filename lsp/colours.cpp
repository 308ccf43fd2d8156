// The colours of calls rgb(…) with numbers, and the texts that give other colours.
#include "lsp/answers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade::lsp {
namespace {

/// The value of a number, or of a quotient of numbers such as 28/255.
std::optional<double> number_at(const ast::Script& tree, ast::ExprId id) {
    const auto& node = tree.expressions[id].node;
    if (const auto* number = std::get_if<ast::Number>(&node)) return number->value;
    const auto* quotient = std::get_if<ast::Binary>(&node);
    if (quotient == nullptr || quotient->op != Function::divide) return std::nullopt;
    const auto* over = std::get_if<ast::Number>(&tree.expressions[quotient->left].node);
    const auto* under = std::get_if<ast::Number>(&tree.expressions[quotient->right].node);
    if (over == nullptr || under == nullptr || under->value == 0) return std::nullopt;
    return over->value / under->value;
}

std::optional<std::array<double, 3>> colour_of(const ast::Script& tree, const ast::Call& call) {
    if (call.function.text != "rgb" || call.argument_count != 3) return std::nullopt;
    std::array<double, 3> colour{};
    for (std::uint32_t k = 0; k < 3; ++k) {
        const auto part = number_at(tree, tree.arguments[call.first_argument + k]);
        if (!part) return std::nullopt;
        colour[k] = std::clamp(*part, 0.0, 1.0);
    }
    return colour;
}

}  // namespace

Result<Json> colours(const Asked& asked) {
    Json list = Json::array();
    const ast::Script& tree = asked.document.script().tree;
    for (const ast::Expr& expr : tree.expressions) {
        const auto* call = std::get_if<ast::Call>(&expr.node);
        if (call == nullptr || expr.span.source != own_source) continue;
        const auto colour = colour_of(tree, *call);
        if (!colour) continue;
        list.push_back({{"range", range_of(asked.document, expr.span)},
                        {"color",
                         {{"red", (*colour)[0]},
                          {"green", (*colour)[1]},
                          {"blue", (*colour)[2]},
                          {"alpha", 1}}}});
    }
    return list;
}

Result<Json> colour_texts(const Asked& asked) {
    const Json& colour = member(asked.params, "color");
    std::array<double, 3> parts{};
    constexpr std::array names{"red", "green", "blue"};
    for (std::size_t k = 0; k < 3; ++k) {
        const Json& part = member(colour, names[k]);
        if (!part.is_number()) return failure("a colour needs red, green and blue");
        // With three digits, all 256 levels have different texts.
        parts[k] = std::round(std::clamp(part.get<double>(), 0.0, 1.0) * 1000) / 1000;
    }
    return Json::array({{{"label", fmt::format("rgb({})", fmt::join(parts, ", "))}}});
}

}  // namespace cascade::lsp
