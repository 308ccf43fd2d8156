// Collects the declarations of a `system` or `cells` block.
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_cycles.h"
#include "lang/check/names/note_uses.h"
#include "lang/check/systems/system_checker.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

void SystemChecker::run() {
    for (const Index& index : system().indices) declared_.emplace(index.name, index.span);
    if (is_cells()) add_cell_quantities();
    for (const Declaration& declaration : declarations_) declare(declaration);
    find_unknowns();
    note_declarations(work_, index_);
    report_families();
    work_.names[index_] = names_of(system());
    rates_.resize(system().quantities.size());
    for (const Declaration* declaration : rate_statements_) collect_rate(*declaration);
    if (rate_statements_.empty() && !is_incomplete(work_, index_) && !is_cells()) {
        report_no_rates();
    }
    work_.items_read[index_].assign(system().item_count(), false);
    work_.definitions_read[index_].assign(system().definitions.size(), false);
    check_values();
    check_definitions();
    check_rates();
    check_invariants();
    check_settings();
    report_cycles_of_defaults(work_, index_);
    order_steps(work_, index_);
    if (is_cells()) check_rules_of_cells();
}

/// Reports a system without rates. In papers, `u_t = …` is a rate. In Cascade it is a definition.
void SystemChecker::report_no_rates() {
    const auto is_paper_rate = [&](const Declaration* each) {
        return each && !species_of_rate(each->name).empty();
    };
    const auto found = std::find_if(definitions_.begin(), definitions_.end(), is_paper_rate);
    if (found == definitions_.end()) {
        work_.diagnostics.error(system().span,
                                fmt::format("system '{}' has no rates", system().name),
                                "a rate is written name' = …");
        return;
    }
    for (auto each = found; each != definitions_.end(); ++each) {
        if (!is_paper_rate(*each)) continue;
        const std::string_view name = (*each)->name;
        work_.diagnostics.error((*each)->span(), fmt::format("'{}' is not a rate", name),
                                fmt::format("write {}' = …", species_of_rate(name)));
    }
}

bool SystemChecker::can_declare(const Declaration& declaration) {
    const std::string_view name = declaration.statement->name.text;
    const Reserved kind = reserved(name);
    if (kind == Reserved::builtin) {
        work_.diagnostics.error(declaration.span(),
                                fmt::format("'{}' is built in and cannot be declared", name));
        return false;
    }
    const bool is_member = !declaration.statement->index.empty();
    if (kind == Reserved::setting && is_member) {
        work_.diagnostics.error(declaration.span(),
                                fmt::format("'{}' is a setting, not a family", name));
        return false;
    }
    if (kind == Reserved::setting && declaration.kind() == ast::StatementKind::definition) {
        work_.diagnostics.error(declaration.span(),
                                fmt::format("'{}' is a setting, not a definition", name),
                                fmt::format("write {}: …", name));
        return false;
    }
    if (is_cells() && !can_declare_in_cells(declaration)) return false;
    const auto [first, is_new] = declared_.try_emplace(declaration.name, declaration.span());
    if (is_new) return true;
    report_twice(work_, declaration.span(), first->second,
                 fmt::format("'{}' is given a value twice", declaration.name));
    return false;
}

/// Whether the declaration gives a string to a quantity. If so, reports the declaration, and
/// suggests a text of the system (such as `title`) that has a similar name.
bool SystemChecker::is_misspelt_text(const Declaration& declaration) {
    const ast::ExprId value = declaration.value().root;
    if (!std::holds_alternative<ast::Text>(declaration.script->expressions[value].node))
        return false;
    std::string hint = did_you_mean(work_, declaration.name, settings_of({SettingBlock::system}));
    if (hint.empty()) return false;
    work_.diagnostics.error(declaration.span(),
                            fmt::format("'{}' cannot have a text in quotes as its value",
                                        declaration.name),
                            std::move(hint));
    return true;
}

void SystemChecker::declare_value(const Declaration& declaration) {
    if (!can_declare(declaration)) return;
    if (take_text(system(), declaration) || is_misspelt_text(declaration)) return;
    if (reserved(declaration.name) == Reserved::setting) {
        settings_.push_back(&declaration);
        return;
    }
    values_.push_back(&declaration);
    Quantity quantity;
    quantity.name = declaration.name;
    quantity.span = declaration.span();
    quantity.doc = declaration.doc;
    system().quantities.push_back(std::move(quantity));
}

void SystemChecker::declare(const Declaration& declaration) {
    if (is_cells() && declare_of_cells(declaration)) return;
    switch (declaration.kind()) {
        case ast::StatementKind::value: return declare_value(declaration);
        case ast::StatementKind::definition:
            if (!can_declare(declaration)) return;
            definitions_.push_back(&declaration);
            system().definitions.push_back({declaration.name, declaration.span(), {}});
            return;
        case ast::StatementKind::index:
        case ast::StatementKind::constraint: return;
        case ast::StatementKind::rate:
        case ast::StatementKind::rate_term: rate_statements_.push_back(&declaration); return;
        case ast::StatementKind::at_least:
        case ast::StatementKind::at_most: invariants_.push_back(&declaration); return;
    }
}

/// Reports a family that has the same name as a quantity or an index.
void SystemChecker::report_families() {
    for (const Declaration& declaration : declarations_) {
        const ast::Statement& statement = *declaration.statement;
        const bool declares = declaration.kind() == ast::StatementKind::value ||
                              declaration.kind() == ast::StatementKind::definition;
        if (statement.index.empty() || !declares) continue;
        const auto plain = declared_.find(std::string(statement.name.text));
        if (plain == declared_.end()) continue;
        Diagnostic diagnostic;
        diagnostic.span = statement.name.span;
        diagnostic.message =
            fmt::format("'{}' cannot be both a family and a single quantity", statement.name.text);
        diagnostic.notes.push_back({plain->second, "the other is here"});
        work_.diagnostics.add(std::move(diagnostic));
    }
}

/// Reports a name that is a definition and has a rate, as if the author wrote `u = 1` for `u: 1`.
/// In a derived system, the later of the two statements is reported.
void SystemChecker::report_rate_of_definition(const Declaration& rate) {
    const auto definition =
        std::find_if(definitions_.begin(), definitions_.end(),
                     [&](const Declaration* each) { return each && each->name == rate.name; });
    if (definition != definitions_.end() && (*definition)->level >= rate.level) {
        work_.diagnostics.error((*definition)->span(),
                                fmt::format("'{}' is a species and cannot be a definition",
                                            rate.name),
                                fmt::format("write {}: … for its starting value", rate.name));
        return;
    }
    work_.diagnostics.error(rate.span(),
                            fmt::format("'{}' is a definition and has no rate", rate.name));
}

/// Reports a rate of a name that is not a species. Later uses of this name are not reported.
void SystemChecker::report_no_species(const Declaration& declaration, const Meaning* meaning) {
    const std::string& name = declaration.name;
    if (meaning != nullptr && meaning->is_definition()) {
        report_rate_of_definition(declaration);
        return;
    }
    if (reserved(name) != Reserved::no) {
        work_.diagnostics.error(declaration.span(), fmt::format("'{}' has no rate", name));
        return;
    }
    if (auto explained = explain_family(work_, system(), name)) {
        work_.diagnostics.error(declaration.span(), std::move(explained->message),
                                std::move(explained->hint));
    } else if (!is_incomplete(work_, index_)) {
        // In an incomplete system, a missing part may declare the name.
        std::string hint;
        if (!is_hopeless(work_)) hint = did_you_mean(work_, name, quantity_names(system()));
        if (hint.empty()) hint = fmt::format("add {}: …", name);
        work_.diagnostics.error(declaration.span(),
                                fmt::format("species '{}' has no starting value", name),
                                std::move(hint));
    }
    work_.names[index_].emplace(name, Meaning{ItemId(), true});
}

void SystemChecker::collect_rate(const Declaration& declaration) {
    if (is_cells() && collect_rate_of_cells(declaration)) return;
    const Meaning* meaning = find(work_.names[index_], declaration.name);
    const bool is_quantity =
        meaning != nullptr && !meaning->is_definition() && meaning->item() < system().frozen_item();
    if (meaning != nullptr && meaning->has_error) return;
    if (!is_quantity) return report_no_species(declaration, meaning);
    system().quantities[meaning->item()].is_species = true;
    note_use(work_, declaration.span(), index_, meaning->id);
    add_statement_of_rate(rates_[meaning->item()], declaration);
}

void SystemChecker::add_statement_of_rate(RateStatements& rate, const Declaration& declaration) {
    if (declaration.kind() == ast::StatementKind::rate_term) {
        rate.terms.push_back(&declaration);
    } else if (rate.assignment == nullptr) {
        rate.assignment = &declaration;
    } else {
        report_twice(work_, declaration.span(), rate.assignment->span(),
                     fmt::format("the rate of '{}' is given twice", declaration.name));
    }
}

SystemId check_system(Workspace& work, const DerivedSystem& derived, std::optional<SystemId> base,
                      std::vector<SystemId> joined) {
    const ast::Block& block = *derived.from.block;
    const SystemId index = work.program.systems.next();
    System system;
    system.name = std::string(block.name.text);
    system.span = block.name.span;
    system.built_in = derived.from.built_in;
    system.base = base;
    system.doc = block.doc;
    const SystemId number = derived.is_known ? index : unknown_system;
    const auto [found, is_new] = work.systems.try_emplace(system.name, number);
    if (!is_new && !block.name.empty()) {
        const bool is_known = found->second != unknown_system;
        if (is_known && work.program.systems[found->second].built_in) {
            // If a system of the script has the same name as a library system, the system of the
            // script takes precedence.
            found->second = number;
        } else {
            report_twice(work, block.name.span,
                         is_known ? work.program.systems[found->second].span : block.name.span,
                         fmt::format("there are two systems '{}'", system.name));
        }
    }
    if (!derived.is_known) return unknown_system;
    if (block.is_cells) {
        system.cells.emplace();
        system.joined = std::move(joined);
    }
    work.draft->systems.push_back(std::move(system));
    work.names.emplace_back();
    work.items_read.emplace_back();
    work.definitions_read.emplace_back();
    bool is_damaged = block.is_damaged || (base && is_incomplete(work, *base));
    for (const SystemId each : work.program.systems[index].joined) {
        is_damaged = is_damaged || is_incomplete(work, each);
    }
    work.incomplete.push_back(is_damaged);
    SystemChecker(work, derived, index).run();
    return index;
}

}  // namespace cascade::checking
