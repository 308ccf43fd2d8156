// Searches the text of a definition for the names that it reads, before the definition can be
// checked. If the definition reads a member of a family, the whole family is checked first, because
// the text does not show which member the definition reads.
#include "lang/check/expressions/read_setting.h"
#include "lang/check/systems/typed_definitions.h"

#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_constraint.h"
#include "lang/program/order.h"

#include <fmt/format.h>

#include <string_view>
#include <unordered_map>

namespace cascade::checking {

namespace {

using Declarations = IdVector<DefinitionId, const Declaration*>;

bool is_constraint(const Declaration* declaration) {
    return declaration != nullptr && declaration->kind() == ast::StatementKind::constraint;
}

/// The dependencies between definitions, as a list of nodes. Each definition is a node with the
/// number of its id. Each family is a further node, which depends on all members of the family.
class DefinitionReads {
public:
    DefinitionReads(const Declarations& definitions, const NameTable& names)
        : definitions_(definitions), names_(names), reads_(definitions.size()) {
        for (const DefinitionId id : definitions.ids()) {
            const std::string_view family = family_of(id);
            if (family.empty()) continue;
            const auto [place, is_new] =
                families_.try_emplace(family, static_cast<std::uint32_t>(reads_.size()));
            if (is_new) reads_.emplace_back();
            reads_[place->second].push_back(id.index());
        }
        for (const DefinitionId id : definitions.ids()) find_reads(id);
    }

    const Dependencies& reads() const { return reads_; }

private:
    std::string_view family_of(DefinitionId id) const {
        if (definitions_[id] == nullptr || definitions_[id]->statement->index.empty()) return {};
        return definitions_[id]->statement->name.text;
    }

    void find_reads(DefinitionId id) {
        if (definitions_[id] == nullptr) return;
        const Declaration& from = *definitions_[id];
        const ast::Expression value = from.statement->values[0];
        for (ast::ExprId part = value.first; part <= value.root; ++part) {
            const auto& node = from.script->expressions[part].node;
            if (const auto* name = std::get_if<ast::Name>(&node)) add(id, name->name);
            if (const auto* own = std::get_if<ast::Bracketed>(&node)) add(id, own->name.text);
        }
    }

    /// Adds what a definition reads. If a definition reads its own family, it reads a member that
    /// is declared earlier, so no dependency on the whole family is added.
    void add(DefinitionId reader, std::string_view name) {
        const auto family = families_.find(name);
        if (family != families_.end() && family_of(reader) != name) {
            reads_[reader.index()].push_back(family->second);
        }
        const Meaning* meaning = find(names_, name);
        if (meaning == nullptr || !meaning->is_definition()) return;
        const DefinitionId id = std::get<DefinitionId>(meaning->id);
        // The unknown of a constraint is always a number, so its type does not depend on the
        // definitions that the constraint reads.
        if (is_constraint(definitions_[id])) return;
        reads_[reader.index()].push_back(id.index());
    }

    const Declarations& definitions_;
    const NameTable& names_;
    Dependencies reads_;
    std::unordered_map<std::string_view, std::uint32_t> families_;
};

std::vector<DefinitionId> order_of(const Declarations& definitions, const NameTable& names) {
    const Order order = topological_order(DefinitionReads(definitions, names).reads());
    std::vector<DefinitionId> ids;
    if (order.cycles.empty()) {
        for (const std::uint32_t node : order.order) {
            if (node < definitions.size()) ids.emplace_back(node);
        }
    } else {
        for (const DefinitionId id : definitions.ids()) ids.push_back(id);
    }
    return ids;
}

void check_definition(Workspace& work, SystemId system, Context context, DefinitionId id,
                      const Declaration& declaration) {
    const ast::Statement& statement = *declaration.statement;
    if (!has_one_value(work, *declaration.script, statement)) return;
    Scope scope;
    scope.context = context;
    scope.system = system;
    scope.indices = declaration.indices;
    auto checked = check_expression(work, *declaration.script, statement.values[0], scope);
    Meaning& meaning = work.names[system].find(declaration.name)->second;
    if (!checked) {
        meaning.has_error = true;
        return;
    }
    const ValueType type = checked->type();
    if (type == ValueType::text || type == ValueType::colour) {
        const TypeWords words = words_of(type, true);
        work.diagnostics.error(checked->formula.nodes.back().span,
                               fmt::format("{} is neither a number nor a vector", words.name));
        meaning.has_error = true;
        return;
    }
    mark_reads(work, checked->formula, system);
    meaning.type = type;
    if (declaration.kind() == ast::StatementKind::constraint) {
        return solve_constraint(work, system, id, std::move(checked->formula));
    }
    work.draft->systems[system].definitions[id].formula = std::move(checked->formula);
}

}  // namespace

void check_typed_definitions(Workspace& work, SystemId system, Context context,
                             const Declarations& definitions) {
    for (const DefinitionId id : order_of(definitions, work.names[system])) {
        if (definitions[id] == nullptr) continue;
        check_definition(work, system, context, id, *definitions[id]);
    }
}

}  // namespace cascade::checking
