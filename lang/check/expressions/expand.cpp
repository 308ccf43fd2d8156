// Expands with an explicit stack of tasks, so that deeply nested calls cannot overflow the stack.
#include "lang/check/expressions/expander.h"

#include "lang/check/expressions/check_expression.h"
#include "lang/check/names/domain_lengths.h"
#include "lang/syntax/operator_polynomials.h"
#include "lang/vocabulary/subscripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace cascade::checking {

namespace {

constexpr std::size_t most_parts = 1'000'000;

}  // namespace

Expanded Expander::run(ast::ExprId root) {
    const Span span = expr(root).span;
    push(TaskKind::visit, root);
    while (!tasks_.empty()) {
        if (++work_.parts_written > most_parts) {
            out_ = {};
            results_.clear();
            if (work_.parts_written == most_parts + 1) {
                work_.diagnostics.error(
                    span,
                    "this expression is too large after its functions and families are written out",
                    fmt::format("a script may grow to {} parts", most_parts));
            }
            frames_.resize(1);
            emit(span, ast::Garbage{});
            break;
        }
        const Task task = tasks_.back();
        tasks_.pop_back();
        switch (task.kind) {
            case TaskKind::visit: visit(task.part); break;
            case TaskKind::finish: finish(task); break;
            case TaskKind::call: enter(task.part); break;
            case TaskKind::leave:
                arguments_.resize(frames_.back().first_argument);
                frames_.pop_back();
                break;
            case TaskKind::repeat: repeat(task); break;
            case TaskKind::combine: combine(task); break;
            case TaskKind::apply: apply(task.part); break;
            case TaskKind::swap: std::swap(results_.back(), results_.end()[-2]); break;
            case TaskKind::scale: {
                const ast::ExprId right = take(), left = take();
                emit(expr(task.part).span, ast::Binary{Function::multiply, left, right});
                break;
            }
        }
    }
    out_.root = take();
    return std::move(out_);
}

ast::ExprId Expander::append(Span span, decltype(ast::Expr::node) node) {
    const auto id = static_cast<ast::ExprId>(out_.parts.expressions.size());
    out_.parts.expressions.push_back({span, std::move(node)});
    out_.calls.push_back(frames_.back().call);
    return id;
}

void Expander::visit(ast::ExprId part) {
    const ast::Expr& here = expr(part);
    if (const auto* length = name_of_length(script(), here)) return emit_length(here.span, *length);
    if (const auto* name = std::get_if<ast::Name>(&here.node)) return visit_name(part, *name);
    if (const auto* call = std::get_if<ast::Call>(&here.node)) return visit_call(part, *call);
    if (const auto* component = std::get_if<ast::Component>(&here.node)) {
        push(TaskKind::finish, part);
        return push(TaskKind::visit, component->operand);
    }
    if (const auto* over = std::get_if<ast::Over>(&here.node)) return visit_over(part, *over);
    if (const auto* unary = std::get_if<ast::Unary>(&here.node)) {
        push(TaskKind::finish, part);
        return push(TaskKind::visit, unary->operand);
    }
    if (const auto* binary = std::get_if<ast::Binary>(&here.node)) {
        const bool is_applied = binary->op == Function::multiply && has_laplacians_ &&
                                applies_operator(script(), binary->left) &&
                                !is_operator(script(), binary->right);
        push(is_applied ? TaskKind::apply : TaskKind::finish, is_applied ? binary->left : part);
        push(TaskKind::visit, binary->right);
        if (!is_applied) push(TaskKind::visit, binary->left);
        return;
    }
    if (const auto* member = std::get_if<ast::Indexed>(&here.node)) {
        ++open_indices_;
        push(TaskKind::finish, part, static_cast<std::int64_t>(out_.parts.expressions.size()));
        if (member->second) push(TaskKind::visit, *member->second);
        return push(TaskKind::visit, member->index);
    }
    emit(here.span, here.node);
}

/// Expands a length of the domain, such as domain.x.
void Expander::emit_length(Span span, const ast::Word& name) {
    const auto length = domain_length(work_, scope_, name);
    if (!length) return emit(span, ast::Garbage{});
    const ast::ExprId factor =
        append_grown(span, append(span, ast::Number{length->factor}), length->axis);
    if (length->builtin.empty()) return results_.push_back(factor);
    const ast::ExprId place = append(span, ast::Name{length->builtin});
    emit(span, ast::Binary{Function::multiply, place, factor});
}

/// The length `length`. If the domain may grow, it is marked as growing along `axis`.
ast::ExprId Expander::append_grown(Span span, ast::ExprId length, int axis) {
    if (!work_.lengths_grow) return length;
    const ast::ExprId along = append(span, ast::Number{static_cast<double>(axis)});
    return append(span, ast::Binary{Function::grown, length, along});
}

/// Expands a name: a parameter of the function, a constant, an index with a value, or any other
/// name.
void Expander::visit_name(ast::ExprId part, const ast::Name& name) {
    const ast::Expr& here = expr(part);
    const Frame& frame = frames_.back();
    if (frame.function != nullptr) {
        const auto parameter = frame.function->parameters.find(name.name);
        if (parameter != frame.function->parameters.end()) {
            results_.push_back(arguments_[frame.first_argument + parameter->second]);
            return;
        }
    }
    if (const UserFunction* constant = find_constant(name.name)) {
        if (constant->has_error) return emit(here.span, ast::Garbage{});
        return push(TaskKind::call, part);
    }
    if (frame.function != nullptr) return visit_subscripted(here.span, name);
    const auto values = values_.find(name.name);
    if (values != values_.end() && !values->second.empty()) {
        return emit(here.span, ast::Number{static_cast<double>(values->second.back())});
    }
    // The error is reported only inside the brackets of an index, because elsewhere the name may be
    // a parameter of the previous stage.
    if (open_indices_ > 0 && find_index(work_, scope_, name.name) != nullptr) {
        Explanation explanation = index_without_value(name.name);
        return error(here.span, std::move(explanation.message), std::move(explanation.hint));
    }
    emit_name(here.span, here.span, name.name, "");
}

void Expander::visit_call(ast::ExprId part, const ast::Call& call) {
    const UserFunction* function = find_function(work_, script(), call.function.text).function;
    if (function != nullptr && function->has_error) return emit(expr(part).span, ast::Garbage{});
    if (function != nullptr && !has_right_count(work_, *function, call, expr(part).span)) {
        return emit(expr(part).span, ast::Garbage{});
    }
    push(function != nullptr ? TaskKind::call : TaskKind::finish, part);
    for (std::uint32_t i = call.argument_count; i > 0; --i) {
        push(TaskKind::visit, script().arguments[call.first_argument + i - 1]);
    }
}

void Expander::enter(ast::ExprId part) {
    const auto* const call = std::get_if<ast::Call>(&expr(part).node);
    const std::size_t count = call != nullptr ? call->argument_count : 0;
    const FoundFunction found =
        call != nullptr
            ? find_function(work_, script(), call->function.text)
            : FoundFunction{find_constant(std::get<ast::Name>(expr(part).node).name), &script()};
    Frame frame{found.script, found.function, arguments_.size(), frames_.back().call};
    if (!frame.call) frame.call = expr(part).span;
    const auto first = results_.end() - static_cast<std::ptrdiff_t>(count);
    arguments_.insert(arguments_.end(), first, results_.end());
    results_.resize(results_.size() - count);
    frames_.push_back(frame);
    push(TaskKind::leave, part);
    push(TaskKind::visit, found.function->body.root);
}

/// Replaces the last result, u, by the result of applying the operator `part` to u
/// (lang/syntax/operator_polynomials.h).
void Expander::apply(ast::ExprId part) {
    const ast::Expr& here = expr(part);
    if (!is_operator(script(), part)) {
        const auto* const number = std::get_if<ast::Number>(&here.node);
        if (number != nullptr && number->value == 1) return;
        push(TaskKind::scale, part);
        push(TaskKind::swap, part);
        return push(TaskKind::visit, part);
    }
    if (std::holds_alternative<ast::Name>(here.node)) {
        const auto first = static_cast<std::uint32_t>(out_.parts.arguments.size());
        out_.parts.arguments.push_back(take());
        return emit(here.span, ast::Call{{here.span, "lap"}, first, 1});
    }
    if (const auto* unary = std::get_if<ast::Unary>(&here.node)) {
        push(TaskKind::finish, part);
        return push(TaskKind::apply, unary->operand);
    }
    const auto& binary = std::get<ast::Binary>(here.node);
    switch (binary.op) {
        case Function::multiply:
            push(TaskKind::apply, binary.left);
            return push(TaskKind::apply, binary.right);
        case Function::divide:
            push(TaskKind::finish, part);
            push(TaskKind::visit, binary.right);
            return push(TaskKind::apply, binary.left);
        case Function::power: {
            const auto* const power = std::get_if<ast::Number>(&expr(binary.right).node);
            const bool is_small = power != nullptr && power->value == std::floor(power->value) &&
                                  power->value >= 1 && power->value <= most_operator_power;
            if (!is_small) {
                take();
                return error(expr(binary.right).span,
                             fmt::format("the power of an operator must be a whole number from 1 "
                                         "to {}",
                                         most_operator_power),
                             "write (1 + lap)^2 u, for example");
            }
            for (int k = 0; k < static_cast<int>(power->value); ++k) {
                push(TaskKind::apply, binary.left);
            }
            return;
        }
        default:  // A sum of operators a + b. u is pushed a second time, and a is applied first.
            results_.push_back(results_.back());
            push(TaskKind::finish, part);
            push(TaskKind::apply, binary.right);
            push(TaskKind::swap, part);
            return push(TaskKind::apply, binary.left);
    }
}

void Expander::finish(const Task& task) {
    const ast::Expr& here = expr(task.part);
    if (const auto* unary = std::get_if<ast::Unary>(&here.node)) {
        return emit(here.span, ast::Unary{unary->op, take()});
    }
    if (const auto* binary = std::get_if<ast::Binary>(&here.node)) {
        const ast::ExprId right = take();
        const ast::ExprId left = take();
        return emit(here.span, ast::Binary{binary->op, left, right});
    }
    if (const auto* over = std::get_if<ast::Over>(&here.node)) {
        const auto distance = over->distance ? std::optional(take()) : std::nullopt;
        if (!is_integral(*over)) {
            return emit(here.span, ast::Over{over->function, take(), over->index, distance});
        }
        const ast::Word sum{over->function.span, "sum"};
        const ast::ExprId total = append(here.span, ast::Over{sum, take(), over->index, {}});
        ast::ExprId content = append(here.span, ast::Number{content_of_cell(work_.program)});
        const DomainSettings& domain = work_.program.domain;
        // Sums over a surface or a model are integrals, which grow by themselves.
        const Stencil stencil =
            domain.model || domain.surface ? Stencil{false, false} : domain.grid.stencil();
        if (stencil.x) content = append_grown(here.span, content, 0);
        if (stencil.y) content = append_grown(here.span, content, 1);
        if (stencil.z) content = append_grown(here.span, content, 2);
        return emit(here.span, ast::Binary{Function::multiply, total, content});
    }
    if (const auto* call = std::get_if<ast::Call>(&here.node)) return finish_call(here, *call);
    if (const auto* component = std::get_if<ast::Component>(&here.node)) {
        const ast::ExprId vector = take();
        const ast::ExprId number = append(component->name.span, expr(component->axis).node);
        return emit(here.span, ast::Component{vector, number, component->name});
    }
    finish_member(here, std::get<ast::Indexed>(here.node), static_cast<std::size_t>(task.value));
}

void Expander::finish_call(const ast::Expr& here, const ast::Call& call) {
    auto& arguments = out_.parts.arguments;
    const auto first = static_cast<std::uint32_t>(arguments.size());
    arguments.insert(arguments.end(), results_.end() - call.argument_count, results_.end());
    results_.resize(results_.size() - call.argument_count);
    emit(here.span, ast::Call{call.function, first, call.argument_count});
}

bool needs_expansion(Workspace& work, const ast::Script& script, ast::Expression expression,
                     const Scope& scope) {
    const bool has_functions =
        !functions_of(work, script).empty() || work.cell_functions != nullptr;
    for (ast::ExprId id = expression.first; id <= expression.root; ++id) {
        const auto& node = script.expressions[id].node;
        if (std::holds_alternative<ast::Indexed>(node)) return true;
        if (name_of_length(script, script.expressions[id]) != nullptr) return true;
        if (const auto* over = std::get_if<ast::Over>(&node)) {
            if (over->index.text != domain_word || is_integral(*over)) return true;
        } else if (const auto* name = std::get_if<ast::Name>(&node)) {
            const auto is_it = [&](const IndexValue& index) { return index.name == name->name; };
            if (std::ranges::any_of(scope.indices, is_it)) return true;
            if (has_functions && functions_of(work, script).find_constant(name->name)) return true;
            if (name->name == "lap" || subscripted_name(name->name)) return true;
        } else if (const auto* call = std::get_if<ast::Call>(&node)) {
            if (has_functions && find_function(work, script, call->function.text)) return true;
        }
    }
    return false;
}

Expanded expand(Workspace& work, const ast::Script& script, ast::Expression expression,
                const Scope& scope) {
    return Expander(work, script, scope).run(expression.root);
}

}  // namespace cascade::checking
