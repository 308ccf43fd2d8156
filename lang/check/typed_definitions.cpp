// The names that a definition reads are found in its text, before it can be checked.
#include "lang/check/typed_definitions.h"

#include "lang/check/check_blocks.h"
#include "lang/program/order.h"

#include <fmt/format.h>

namespace cascade::checking {

namespace {

using Declarations = IdVector<DefinitionId, const Declaration*>;

std::vector<DefinitionId> order_of(const Declarations& definitions, const NameTable& names) {
    Dependencies reads(definitions.size());
    for (const DefinitionId id : definitions.ids()) {
        if (definitions[id] == nullptr) continue;
        const Declaration& from = *definitions[id];
        const ast::Expression value = from.statement->values[0];
        for (ast::ExprId part = value.first; part <= value.root; ++part) {
            const auto& node = from.script->expressions[part].node;
            const auto* const name = std::get_if<ast::Name>(&node);
            const auto* const own = std::get_if<ast::Bracketed>(&node);
            if (name == nullptr && own == nullptr) continue;
            const Meaning* meaning = find(names, name != nullptr ? name->name : own->name.text);
            if (meaning == nullptr || !meaning->is_definition()) continue;
            reads[id.index()].push_back(std::get<DefinitionId>(meaning->id).index());
        }
    }
    const Order order = topological_order(reads);
    std::vector<DefinitionId> ids;
    for (const std::uint32_t id : order.order) ids.emplace_back(id);
    if (!order.cycles.empty()) {
        ids.clear();
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
    scope.index = declaration.index;
    auto checked = check_expression(work, *declaration.script, statement.values[0], scope);
    Meaning& meaning = work.names[system].find(declaration.name)->second;
    if (!checked) {
        meaning.has_error = true;
        return;
    }
    const ValueType type = checked->type();
    if (type != ValueType::number && type != ValueType::vector) {
        const TypeWords words = words_of(type, true);
        work.diagnostics.error(checked->formula.nodes.back().span,
                               fmt::format("{} is neither a number nor a vector", words.name));
        meaning.has_error = true;
        return;
    }
    mark_reads(work, checked->formula, system);
    meaning.type = type;
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
