// Expands families and aggregates: finds members by the values of their indices, and replaces a sum
// over an index by its terms.
#include "lang/check/expressions/check_expression.h"
#include "lang/check/expressions/expander.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace cascade::checking {

namespace {

/// Whether the function is an aggregate that can be called over an index.
bool is_reduction(std::string_view name) {
    constexpr std::array<std::string_view, 5> names{"sum", "product", "mean", "min", "max"};
    return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace

void Expander::visit_over(ast::ExprId part, const ast::Over& over) {
    const bool is_neighbours = over.index.text == "touching" || over.index.text == "near";
    if (over.index.text == "domain" || (is_neighbours && is_of_cells(work_, scope_))) {
        push(TaskKind::finish, part);
        if (over.distance) push(TaskKind::visit, *over.distance);
        return push(TaskKind::visit, over.operand);
    }
    const Index* index = find_index(work_, scope_, over.index.text);
    const auto& invalid = work_.invalid_indices;
    if (index == nullptr &&
        std::find(invalid.begin(), invalid.end(), over.index.text) != invalid.end()) {
        return emit(over.index.span, ast::Garbage{});
    }
    if (index == nullptr) {
        constexpr std::array<std::string_view, 9> all_cells = {"space",  "all",   "grid",
                                                               "x",      "y",     "area",
                                                               "volume", "cells", "plane"};
        const bool is_all = std::ranges::find(all_cells, over.index.text) != all_cells.end();
        return error(over.index.span, fmt::format("there is no index '{}'", over.index.text),
                     is_neighbours ? "only cells that crawl have neighbours"
                     : is_all      ? "write 'domain' for all cells"
                                   : "declare the index in the system, as in i: 1..3");
    }
    if (!is_reduction(over.function.text)) {
        return error(over.function.span,
                     fmt::format("{} cannot be taken over an index", over.function.text),
                     "use sum, product, mean, min or max");
    }
    push(TaskKind::repeat, part, index->low);
}

void Expander::repeat(const Task& task) {
    const auto& over = std::get<ast::Over>(expr(task.part).node);
    values_[over.index.text].push_back(task.value);
    push(TaskKind::combine, task.part, task.value);
    push(TaskKind::visit, over.operand);
}

/// Combines the results for the values of the index that have been visited: ((e1 + e2) + e3) + …,
/// min(min(e1, e2), e3), …
void Expander::combine(const Task& task) {
    const ast::Expr& here = expr(task.part);
    const auto& over = std::get<ast::Over>(here.node);
    const Index* index = find_index(work_, scope_, over.index.text);
    values_[over.index.text].pop_back();
    if (task.value > index->low) {
        const ast::ExprId next = take();
        const ast::ExprId before = take();
        const std::string_view name = over.function.text;
        if (name == "min" || name == "max") {
            auto& arguments = out_.parts.arguments;
            const auto first = static_cast<std::uint32_t>(arguments.size());
            arguments.insert(arguments.end(), {before, next});
            emit(here.span, ast::Call{over.function, first, 2});
        } else {
            const auto op = name == "product" ? Function::multiply : Function::add;
            emit(here.span, ast::Binary{op, before, next});
        }
    }
    if (task.value < index->high) return push(TaskKind::repeat, task.part, task.value + 1);
    if (over.function.text != "mean") return;
    const ast::ExprId sum = take();
    const auto count = static_cast<double>(index->high - index->low + 1);
    const ast::ExprId divisor = append(here.span, ast::Number{count});
    emit(here.span, ast::Binary{Function::divide, sum, divisor});
}

/// Evaluates the nodes of the indices, which begin at `before`, to numbers. Then removes these
/// nodes, because only the numbers are needed.
void Expander::finish_member(const ast::Expr& here, const ast::Indexed& member,
                             std::size_t before) {
    --open_indices_;
    std::vector<ast::ExprId> roots{take()}, parts{member.index};
    if (member.second) {
        roots.insert(roots.begin(), take());
        parts.push_back(*member.second);
    }
    std::vector<std::int64_t> values;
    auto first = static_cast<ast::ExprId>(before);
    for (std::size_t k = 0; k < roots.size(); ++k) {
        const auto value = index_value(first, roots[k], expr(parts[k]).span);
        if (value) values.push_back(*value);
        first = roots[k] + 1;
    }
    out_.parts.expressions.resize(before, {{}, ast::Garbage{}});
    out_.calls.resize(before);
    if (values.size() < roots.size()) return emit(here.span, ast::Garbage{});
    const auto named = [&](std::string_view family) -> std::string_view {
        return out_.names.emplace_back(member_name(family, values));
    };
    const ast::Expr& base = expr(member.base);
    if (const auto* name = std::get_if<ast::Name>(&base.node)) {
        return emit_name(here.span, base.span, name->name, member_name("", values));
    }
    if (const auto* own = std::get_if<ast::Bracketed>(&base.node)) {
        return emit(here.span, ast::Bracketed{{here.span, named(own->name.text)}});
    }
    if (const auto* rate = std::get_if<ast::RateOf>(&base.node)) {
        return emit(here.span, ast::RateOf{{here.span, named(rate->name.text)}});
    }
    const auto& other = std::get<ast::Qualified>(base.node);
    emit(here.span, ast::Qualified{other.stage, {here.span, named(other.name.text)}});
}

/// The integer to which the nodes [first, last] evaluate. Reports errors.
std::optional<std::int64_t> Expander::index_value(ast::ExprId first, ast::ExprId last, Span span) {
    Scope constant;
    constant.context = Context::constant;
    constant.subject = "an index";
    const auto checked = check_parts(work_, out_.parts, {first, last}, constant);
    if (!checked) return std::nullopt;
    if (!checked->constant) {
        work_.diagnostics.error(span, "an index must be one number");
        return std::nullopt;
    }
    const double value = *checked->constant;
    if (value == std::floor(value) && std::abs(value) < 1e9) {
        return static_cast<std::int64_t>(value);
    }
    work_.diagnostics.error(span, fmt::format("an index must be a whole number, not {}", value));
    return std::nullopt;
}

const Index* find_index(const Workspace& work, const Scope& scope, std::string_view name) {
    if (scope.context == Context::constant || scope.system == unknown_system) return nullptr;
    for (const Index& index : work.program.systems[scope.system].indices) {
        if (index.name == name) return &index;
    }
    return nullptr;
}

std::string member_name(std::string_view family, const std::vector<std::int64_t>& indices) {
    return fmt::format("{}[{}]", family, fmt::join(indices, ","));
}

}  // namespace cascade::checking
