// A constraint `0 = e` becomes a definition of its unknown: solved(e), where e reads the unknown
// itself. In e, other definitions that depend on the unknown are expanded.
#include "lang/check/systems/check_constraint.h"

#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/system_checker.h"
#include "lang/check/expressions/user_functions.h"
#include "lang/vocabulary/settings.h"
#include "lang/vocabulary/subscripts.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>
#include <vector>

namespace cascade::checking {

namespace {

/// The names in the expression of a statement, except the names of called functions and of
/// families.
std::vector<ast::Word> names_in(const Declaration& declaration) {
    std::vector<ast::Word> names;
    std::unordered_set<ast::ExprId> of_families;
    const ast::Expression value = declaration.statement->values[0];
    const auto& expressions = declaration.script->expressions;
    for (ast::ExprId id = value.first; id <= value.root; ++id) {
        if (const auto* member = std::get_if<ast::Indexed>(&expressions[id].node)) {
            of_families.insert(member->base);
        }
    }
    for (ast::ExprId id = value.first; id <= value.root; ++id) {
        const auto* const name = std::get_if<ast::Name>(&expressions[id].node);
        if (name == nullptr || of_families.contains(id)) continue;
        names.push_back({expressions[id].span, name->name});
    }
    return names;
}

/// The names without duplicates. If several of them are psi or derivatives of psi, such as psi_xx
/// and psi_yy, psi takes the place of all of them.
std::vector<ast::Word> without_derivatives(const std::vector<ast::Word>& names) {
    const auto base_of = [](const ast::Word& name) {
        const auto subscripted = subscripted_name(name.text);
        return subscripted ? subscripted->of : name.text;
    };
    std::vector<ast::Word> result;
    for (const ast::Word& name : names) {
        const std::string_view base = base_of(name);
        const bool is_shared = std::ranges::count(names, base, base_of) > 1;
        const std::string_view text = is_shared ? base : name.text;
        const bool is_new = std::ranges::find(result, text, &ast::Word::text) == result.end();
        if (is_new) result.push_back({name.span, text});
    }
    return result;
}

class Inliner {
public:
    Inliner(const System& system, DefinitionId unknown, std::uint32_t number)
        : system_(system), unknown_(unknown), number_(number) {}

    /// Replaces the definition of the unknown by the unknown itself in a formula, and replaces
    /// definitions that read the unknown by their formulas.
    Formula run(const Formula& formula) {
        Formula result;
        append(formula, result);
        return result;
    }

private:
    NodeId append(const Formula& formula, Formula& to) {
        IdVector<NodeId, NodeId> places;
        for (Node node : formula.nodes) {
            if (const auto* id = node.as<DefinitionId>(); id != nullptr && *id == unknown_) {
                node.kind = Unknown{number_};
            } else if (id != nullptr && depends(*id)) {
                places.push_back(append(system_.definitions[*id].formula, to));
                continue;
            }
            for (NodeId& operand : node.reads()) operand = places[operand];
            places.push_back(to.nodes.next());
            to.nodes.push_back(node);
        }
        return places.back();
    }

    bool depends(DefinitionId id) const {
        IdVector<DefinitionId, bool> seen(system_.definitions.size(), false);
        std::vector<DefinitionId> waiting{id};
        while (!waiting.empty()) {
            const DefinitionId next = waiting.back();
            waiting.pop_back();
            if (next == unknown_) return true;
            if (seen[next]) continue;
            seen[next] = true;
            for (const Node& node : system_.definitions[next].formula.nodes) {
                if (const auto* read = node.as<DefinitionId>()) waiting.push_back(*read);
            }
        }
        return false;
    }

    const System& system_;
    DefinitionId unknown_;
    std::uint32_t number_;
};

/// The first node that is not linear in the unknown; null if there is none.
const Node* nonlinear_part(const Formula& formula) {
    IdVector<NodeId, bool> depends;
    for (const Node& node : formula.nodes) {
        std::size_t count = 0;
        bool is_linear = true;
        for (std::size_t k = 0; k < node.operand_count; ++k) {
            if (!depends[node.operands[k]]) continue;
            ++count;
            is_linear = is_linear && is_linear_in(node.function, k, node.operand_count);
        }
        if (count > 0 && (!is_linear || (count > 1 && !is_jointly_linear(node.function))))
            return &node;
        depends.push_back(node.is<Unknown>() || count > 0);
    }
    return nullptr;
}

}  // namespace

void SystemChecker::find_unknowns() {
    std::vector<Declaration*> constraints;
    for (Declaration& declaration : declarations_) {
        if (declaration.kind() == ast::StatementKind::constraint) {
            constraints.push_back(&declaration);
        }
    }
    if (constraints.empty()) return;
    if (is_cells()) {
        return work_.diagnostics.error(constraints[0]->span(),
                                       "cells that crawl have no constraints",
                                       "constraints work only for fields: system NAME { … }");
    }
    // The first pass finds the fields that constraints name themselves. The second pass finds the
    // fields that constraints read only through definitions.
    std::erase_if(constraints, [&](Declaration* each) { return find_unknown(*each, false); });
    for (Declaration* each : constraints) find_unknown(*each, true);
}

/// The name that a word reads: u for u_xx, if u is declared and u_xx is not.
std::string_view SystemChecker::name_read_by(const ast::Word& word) const {
    const auto subscripted = subscripted_name(word.text);
    const bool is_derivative = subscripted && !declared_.contains(std::string(word.text)) &&
                               declared_.contains(std::string(subscripted->of));
    return is_derivative ? subscripted->of : word.text;
}

/// The names in a constraint that have no value. If `in_definitions` is true, also such names in
/// the definitions that the constraint reads.
std::vector<ast::Word> SystemChecker::names_without_values(const Declaration& constraint,
                                                           bool in_definitions) const {
    std::vector<ast::Word> unknown;
    std::vector<const Declaration*> waiting{&constraint};
    std::unordered_set<const Declaration*> seen;
    const auto wait_for = [&](std::string_view name) {
        for (const Declaration* each : definitions_) {
            if (each && each->name == name) waiting.push_back(each);
        }
    };
    while (!waiting.empty()) {
        const Declaration& from = *waiting.back();
        waiting.pop_back();
        if (!seen.insert(&from).second) continue;
        const FunctionTable& functions = functions_of(work_, *from.script);
        for (const ast::Word& name : names_in(from)) {
            if (in_definitions) wait_for(name.text);
            const bool is_known =
                declared_.contains(std::string(name.text)) || reserved(name.text) != Reserved::no ||
                cell_value_named(name.text) || functions.find(name.text) != nullptr;
            if (!is_known && name_read_by(name) != name.text) {
                if (in_definitions) wait_for(name_read_by(name));
                continue;
            }
            const bool is_new = std::ranges::none_of(unknown, [&](const ast::Word& other) {
                return other.text == name.text;
            });
            if (!is_known && is_new) unknown.push_back(name);
        }
    }
    return without_derivatives(unknown);
}

/// Declares the one name in a constraint that nothing else declares. A constraint of a derived
/// system replaces a constraint of its base that determines the same name. Returns false, without a
/// message, if the constraint itself names no field and `in_definitions` is false.
bool SystemChecker::find_unknown(Declaration& constraint, bool in_definitions) {
    const std::vector<ast::Word> unknown = names_without_values(constraint, in_definitions);
    if (unknown.size() == 1) {
        constraint.name = std::string(unknown[0].text);
        declared_.try_emplace(constraint.name, unknown[0].span);
        definitions_.push_back(&constraint);
        system().definitions.push_back({constraint.name, unknown[0].span, {}});
        return true;
    }
    if (unknown.empty()) {
        for (const ast::Word& name : names_in(constraint)) {
            const auto other = std::ranges::find_if(definitions_, [&](const Declaration* each) {
                return each && each->kind() == ast::StatementKind::constraint &&
                       each->name == name_read_by(name);
            });
            if (other == definitions_.end()) continue;
            if ((*other)->level == constraint.level) {
                report_twice(work_, constraint.span(), (*other)->span(),
                             fmt::format("two constraints determine '{}'", (*other)->name));
                return true;
            }
            constraint.name = (*other)->name;
            *other = &constraint;
            return true;
        }
        if (!in_definitions) return false;
    }
    if (is_incomplete(work_, index_)) return true;
    if (unknown.empty()) {
        work_.diagnostics.error(
            constraint.span(),
            "this constraint determines nothing, because all names on the right already have "
            "values",
            "leave one name without a value, such as phi in 0 = lap(phi) + rho");
        return true;
    }
    std::vector<std::string> names;
    for (const ast::Word& name : unknown) names.emplace_back(name.text);
    work_.diagnostics.error(
        constraint.span(),
        fmt::format("a constraint can determine only one name, but several names have no value: {}",
                    list_names(names)),
        "give values to all but one of these names");
    work_.incomplete[index_] = true;
    return true;
}

void solve_constraint(Workspace& work, SystemId system, DefinitionId id, Formula residual) {
    Definition& definition = work.draft->systems[system].definitions[id];
    const auto fail = [&](Span span, std::string message, std::string hint) {
        work.diagnostics.error(span, std::move(message), std::move(hint));
        work.names[system].find(definition.name)->second.has_error = true;
    };
    const Span span = residual.nodes.back().span;
    if (residual.nodes.back().type != ValueType::number) {
        return fail(span, "the right side of a constraint must be a number",
                    "div(v), dot(v, w) and v.x turn a vector into a number");
    }
    const std::uint32_t number = work.program.literals->add(Constraint{definition.name, span});
    Formula formula = Inliner(work.program.systems[system], id, number).run(residual);
    if (const Node* part = nonlinear_part(formula)) {
        return fail(
            part->span,
            fmt::format("this part of the constraint is not linear in '{}'", definition.name),
            "each term may apply one operator to the unknown name and multiply it by factors "
            "without this name");
    }
    Node solved;
    solved.kind = Call{number};
    solved.function = Function::solved;
    solved.span = definition.span;
    solved.operands = {NodeId(formula.nodes.size() - 1)};
    solved.operand_count = 1;
    formula.nodes.push_back(solved);
    definition.formula = std::move(formula);
}

}  // namespace cascade::checking
