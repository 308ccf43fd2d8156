// Checks one expression: turns each node of the syntax tree into a node of a formula, in the same
// order.
#include "lang/check/expressions/expression_checker.h"

#include "core/palette.h"
#include "lang/calculus/algebra.h"
#include "lang/check/expressions/check_directions.h"
#include "lang/check/names/note_uses.h"
#include "lang/program/dependencies.h"
#include "lang/program/order.h"
#include "lang/vocabulary/signs_elsewhere.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

std::optional<CheckedExpression> ExpressionChecker::run() {
    const std::uint32_t count = expression_.root - expression_.first + 1;
    formula_.nodes.reserve(count);
    parts_.reserve(count);
    find_places_of_words();
    in_kernel_ = kernel_parts(script_, expression_);
    bool has_error = false;
    for (const NodeId part : ids_below<NodeId>(count)) {
        formula_.nodes.push_back({0.0, expr(part).span});
        parts_.emplace_back();
        if (expanded_ != nullptr) work_.call = expanded_->calls[part.index()];
        std::visit([this](const auto& kind) { visit(kind); }, expr(part).node);
        has_error = has_error || parts_.back().has_error;
    }
    const NodeId root(expanded_ != nullptr ? expanded_->root : count - 1);
    has_error = has_error || (in_cells() && !has_places(root));
    work_.call = std::nullopt;
    if (has_error) return std::nullopt;
    check_places();
    CheckedExpression checked;
    const bool has_other_nodes = expanded_ != nullptr || has_loose_nodes_;
    checked.formula = has_other_nodes ? formula_of(formula_.nodes, root) : std::move(formula_);
    if (scope_.context == Context::picture && !put_definitions_in(checked.formula)) {
        return std::nullopt;
    }
    if (parts_[root].constant) checked.constant = parts_[root].value;
    return checked;
}

/// Replaces the names of definitions by the formulas of the definitions, for pictures. If a
/// definition is random, reports an error and returns false. If errors have left the system
/// incomplete, returns false without a message.
bool ExpressionChecker::put_definitions_in(Formula& formula) {
    const auto is_definition = [](const Node& node) { return node.is<DefinitionId>(); };
    if (std::ranges::none_of(formula.nodes, is_definition)) return true;
    const System& system = work_.program.systems[scope_.system];
    if (!system.is_complete() || !topological_order(step_dependencies(system)).cycles.empty()) {
        return false;
    }
    const Span first = std::ranges::find_if(formula.nodes, is_definition)->span;
    if (scope_.system < work_.definitions_read.next()) {
        for (const Node& node : formula.nodes) {
            const auto* id = node.as<DefinitionId>();
            if (id != nullptr) work_.definitions_read[scope_.system][*id] = true;
        }
    }
    formula = without_definitions(system, formula);
    if (in_cells() || std::ranges::none_of(formula.nodes, is_draw)) return true;
    work_.diagnostics.error(first, "a picture cannot read a definition with random numbers",
                            "random numbers are drawn anew in every step");
    return false;
}

/// Finds the operands that must be strings (names of palettes and files), and the operands of
/// `along` that name a direction. A bare word where a string is needed is reported as a string
/// without quotes and not as an unknown name. Calls that contain errors are skipped.
void ExpressionChecker::find_places_of_words() {
    wants_text_.assign(expression_.root - expression_.first + 1, false);
    is_direction_ = wants_text_;
    for (ast::ExprId id = expression_.first; id <= expression_.root; ++id) {
        const auto* call = std::get_if<ast::Call>(&script_.expressions[id].node);
        if (call == nullptr) continue;
        const auto function = function_named(call->function.text);
        const std::uint32_t end = call->first_argument + call->argument_count;
        if (function == Function::along && call->argument_count > 0) {
            const NodeId part = part_of(script_.arguments[call->first_argument]);
            const auto* const direction = std::get_if<ast::Call>(&expr(part).node);
            const auto* const name = std::get_if<ast::Name>(&expr(part).node);
            const std::string_view word = direction != nullptr ? direction->function.text
                                          : name != nullptr    ? name->name
                                                               : std::string_view();
            is_direction_[part] = names_direction(word);
        } else if (!function || !info(*function).arity.takes(call->argument_count)) {
            for (std::uint32_t k = call->first_argument; k < end; ++k) {
                const ast::ExprId argument = script_.arguments[k];
                wants_text_[part_of(argument)] =
                    std::holds_alternative<ast::Text>(script_.expressions[argument].node);
            }
        } else if (function == Function::palette) {
            wants_text_[part_of(script_.arguments[end - 1])] = true;
        } else if (reads_file(*function)) {
            wants_text_[part_of(script_.arguments[call->first_argument])] = true;
            // If the number of arguments is even, one argument is a channel.
            const bool has_channel = function == Function::image && call->argument_count % 2 == 0;
            if (has_channel)
                wants_text_[part_of(script_.arguments[call->first_argument + 1])] = true;
        }
    }
}

void ExpressionChecker::visit(const ast::Number& number) {
    formula_.nodes.back().kind = number.value;
    parts_.back() = {false, true, number.value};
}

void ExpressionChecker::visit(const ast::Text& text) {
    Node& node = formula_.nodes.back();
    node.type = ValueType::text;
    if (!wants_text_[NodeId(parts_.size() - 1)]) {
        std::string hint(advice_about(text.value, WordContext::value));
        if (hint.empty()) hint = advice_about_hex_colour(text.value);
        if (text.value.ends_with(".png")) hint = fmt::format("write image(\"{}\")", text.value);
        if (hint.empty()) hint = "for example, palette(v, low, high, \"grey\") or field(\"a.npy\")";
        return error(node.span, "a text in quotes can only name a palette or a file",
                     std::move(hint));
    }
    node.kind = work_.program.literals->id_of(text.value);
}

void ExpressionChecker::visit(const ast::Name& name) {
    const Span span = formula_.nodes.back().span;
    if (wants_text_[NodeId(parts_.size() - 1)]) {
        return error(span, "a text in quotes is expected here", fmt::format("\"{}\"", name.name));
    }
    if (stands_in_kernel() && take_lag(name.name)) return;
    if (is_direction_[NodeId(parts_.size() - 1)]) return take_direction(name.name, {});
    if (scope_.context == Context::picture && scope_.system != unknown_system &&
        find_palette(name.name) != nullptr &&
        find(work_.names[scope_.system], name.name) == nullptr) {
        return error(span, fmt::format("'{}' is a palette", name.name),
                     fmt::format("write palette(u, 0, 1, \"{}\")", name.name));
    }
    // In the body of a function, the name does not mean a parameter of the system in which the
    // function is called.
    if (work_.call && is_of_each_cell(name.name) && !in_cells()) {
        return error(span, fmt::format("'{}' can be used only by cells that crawl", name.name));
    }
    take(resolve_bare(work_, scope_, name.name, span), span);
}

void ExpressionChecker::visit(const ast::Bracketed& bracketed) {
    take(resolve_bracketed(work_, scope_, bracketed.name, formula_.nodes.back().span),
         bracketed.name.span);
}

void ExpressionChecker::visit(const ast::Qualified& qualified) {
    if (wants_text_[NodeId(parts_.size() - 1)]) {
        return error(formula_.nodes.back().span, "a text in quotes is expected here",
                     fmt::format("\"{}.{}\"", qualified.stage.text, qualified.name.text));
    }
    take(resolve_qualified(work_, scope_, qualified, formula_.nodes.back().span),
         qualified.name.span);
}

void ExpressionChecker::visit(const ast::RateOf& rate) {
    take(resolve_rate(work_, scope_, rate.name, formula_.nodes.back().span), rate.name.span);
}

void ExpressionChecker::take(std::optional<Node> node, Span name) {
    if (!node) {
        parts_.back().has_error = true;
        return;
    }
    note_use(work_, scope_, *node, name);
    if (const auto* number = node->as<double>()) parts_.back() = {false, true, *number};
    if (const auto* id = node->as<DefinitionId>(); id != nullptr && work_.on_surface) {
        parts_.back().turned = is_turned(*id);
    }
    formula_.nodes.back() = *node;
}

void ExpressionChecker::visit(const ast::Unary& unary) {
    apply(unary.op, {part_of(unary.operand)}, 1);
}

void ExpressionChecker::visit(const ast::Binary& binary) {
    apply(binary.op, {part_of(binary.left), part_of(binary.right)}, 2);
}

void ExpressionChecker::visit(const ast::Component& component) {
    apply(Function::component, {part_of(component.operand), part_of(component.axis)}, 2);
}

std::optional<CheckedExpression> check_expression(Workspace& work, const ast::Script& script,
                                                  ast::Expression expression, const Scope& scope) {
    if (!needs_expansion(work, script, expression, scope)) {
        return check_parts(work, script, expression, scope);
    }
    const Expanded expanded = expand(work, script, expression, scope);
    return ExpressionChecker(work, script, expanded, scope).run();
}

std::optional<CheckedExpression> check_parts(Workspace& work, const ast::Script& script,
                                             ast::Expression expression, const Scope& scope) {
    return ExpressionChecker(work, script, expression, scope).run();
}

std::optional<CheckedExpression> check_number(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope) {
    auto checked = check_expression(work, script, expression, scope);
    if (!checked || checked->type() == ValueType::number) return checked;
    const TypeWords words = words_of(checked->type(), is_of_cells(work, scope));
    work.diagnostics.error(checked->formula.nodes.back().span,
                           fmt::format("{} is not a number", words.name), std::string(words.hint));
    return std::nullopt;
}

std::optional<CheckedExpression> check_vector(Workspace& work, const ast::Script& script,
                                              ast::Expression expression, const Scope& scope) {
    auto checked = check_expression(work, script, expression, scope);
    if (!checked || checked->type() == ValueType::vector) return checked;
    work.diagnostics.error(checked->formula.nodes.back().span, "a vector is needed here",
                           vectors_are(is_of_cells(work, scope)));
    return std::nullopt;
}

}  // namespace cascade::checking
