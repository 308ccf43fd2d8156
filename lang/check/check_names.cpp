// Name resolution: from a word in an expression to an item, a definition or a built-in value.
#include "lang/check/check_names.h"

#include "lang/check/cell_stages.h"
#include "lang/vocabulary/words_elsewhere.h"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

namespace cascade::checking {

namespace {

const System& system_at(const Workspace& work, SystemId index) {
    return work.program.systems[index];
}

/// True where an expression cannot read the names of a system.
bool is_constant(const Scope& scope) {
    return scope.context == Context::constant || scope.context == Context::position ||
           scope.context == Context::mask || scope.context == Context::shape;
}

bool is_of_model(std::string_view name) {
    const auto builtin = builtin_named(name);
    return builtin && is_of_model(*builtin);
}

bool varies_by_cell(std::string_view builtin) { return builtin != "t" && builtin != "step"; }

void report_constant(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    if (scope.context == Context::position) {
        report(work, span, fmt::format("a surface cannot read '{}'", name),
               "it is made of numbers, sx, sy, pi and functions of them");
        return;
    }
    if (scope.context == Context::mask) {
        report(work, span, fmt::format("a mask cannot read '{}'", name),
               "it is made of coordinates, numbers, shapes, noise and files");
        return;
    }
    if (scope.context == Context::shape) {
        report(work, span, fmt::format("a shape cannot read '{}'", name),
               "it is made of t, s, part, numbers of its own and functions of them");
        return;
    }
    if (reserved(name) == Reserved::builtin && varies_by_cell(name)) {
        report(work, span,
               fmt::format("{} must be one number, but '{}' varies by cell", scope.subject, name),
               "");
        return;
    }
    report(work, span, fmt::format("{} must be one number", scope.subject),
           "only numbers, operators and functions of them can stand here");
}

std::optional<Node> resolve_builtin(Workspace& work, const Scope& scope, std::string_view name,
                                    Span span) {
    if (name == "pi") return Node{std::numbers::pi, span};
    if (scope.context == Context::constant) {
        report_constant(work, scope, name, span);
        return std::nullopt;
    }
    if (scope.context == Context::bound) {
        report(work, span, "a bound is made of numbers and parameters only", "");
        return std::nullopt;
    }
    if ((scope.context == Context::position || scope.context == Context::mask) &&
        is_of_model(name)) {
        report_constant(work, scope, name, span);
        return std::nullopt;
    }
    if (scope.context == Context::position && !varies_by_cell(name)) {
        report(work, span, fmt::format("a surface cannot depend on '{}'", name),
               "it stays as it is");
        return std::nullopt;
    }
    if (scope.context == Context::mask && !varies_by_cell(name)) {
        report(work, span, fmt::format("a mask cannot depend on '{}'", name), "it stays as it is");
        return std::nullopt;
    }
    if (scope.context == Context::value && !varies_by_cell(name) && !scope.is_side) {
        report(work, span, fmt::format("'{}' has no value when a stage starts", name),
               "it can be read in rates, definitions and pictures");
        return std::nullopt;
    }
    return Node{*builtin_named(name), span};
}

/// Reports words of the language that are not values of a stage.
bool report_reserved(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    const Reserved kind = reserved(name);
    if (is_constant(scope)) {
        report_constant(work, scope, name, span);
        return true;
    }
    if (kind == Reserved::setting && name != "frozen" && name != "speed") {
        report(work, span, fmt::format("the setting '{}' cannot be read", name), "");
        return true;
    }
    return false;
}

std::vector<std::string> readable_names(const System& system, const Scope& scope) {
    std::vector<std::string> names = quantity_names(system);
    if (scope.context == Context::rate || scope.is_side) {
        for (const Definition& definition : system.definitions) names.push_back(definition.name);
    }
    for (const std::string_view name : builtin_names) {
        if (varies_by_cell(name)) names.emplace_back(name);
    }
    for (const char* name : {"pi", "frozen", "speed"}) names.push_back(name);
    return names;
}

std::string not_a_parameter(std::string_view name, const System& system) {
    return fmt::format("'{}' is not a parameter of {}", name, system.name);
}

/// "write 'dxx(u)'" for u_xx, if there is a u.
std::string hint_of_subscript(std::string_view name, const std::vector<std::string>& known) {
    const std::size_t bar = name.rfind('_');
    if (bar == name.npos) return "";
    const std::string_view of = name.substr(0, bar), axes = name.substr(bar + 1);
    const bool is_derivative = !axes.empty() && axes.size() <= 2 &&
                               axes.find_first_not_of("xyz") == axes.npos &&
                               function_named(fmt::format("d{}", axes));
    if (!is_derivative || std::find(known.begin(), known.end(), of) == known.end()) return "";
    return fmt::format("write 'd{}({})'", axes, of);
}

void report_unknown_own(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    const System& system = system_at(work, scope.system);
    if (is_hopeless(work)) return report(work, span, not_a_parameter(name, system), "");
    if (auto explained = explain_family(work, system, name)) {
        return report(work, span, std::move(explained->message), std::move(explained->hint));
    }
    if (is_incomplete(work, scope.system)) return;
    const std::string names = list_names(quantity_names(system));
    std::string hint(advice_about(name, WordContext::value));
    const std::vector<std::string> readable = readable_names(system, scope);
    if (hint.empty()) hint = hint_of_subscript(name, readable);
    if (hint.empty()) hint = did_you_mean(work, name, readable);
    if (hint.empty() && scope.context == Context::rate)
        hint = fmt::format("add {}: 0.1, for example", name);
    if (function_named(name)) hint = fmt::format("'{0}' is a function: {0}(…)", name);
    if (name == "steady") hint = "write steady(0.1)";
    if (cell_value_named(name)) hint = fmt::format("'{}' is known to cells that crawl only", name);
    std::string note = fmt::format("{} has {}", system.name, names);
    if (scope.context == Context::value && scope.stage) {
        note = fmt::format("[name] reads this stage ({}: {})", system.name, names);
        if (reserved(name) == Reserved::builtin) {
            hint = fmt::format("'{}' is built in and needs no brackets", name);
        }
    }
    report(work, span, not_a_parameter(name, system), std::move(hint), std::move(note));
}

/// Rates have the values of definitions; sides and pictures compute them.
bool reads_definitions(const Scope& scope) {
    return scope.context == Context::rate || scope.context == Context::picture || scope.is_side;
}

/// Resolves a name of the system itself, or of the stage that is being set or shown.
std::optional<Node> resolve_own(Workspace& work, const Scope& scope, std::string_view name,
                                Span span) {
    if (scope.system == unknown_system || report_reserved(work, scope, name, span)) {
        return std::nullopt;
    }
    const Meaning* meaning = find(work.names[scope.system], name);
    if (meaning == nullptr) {
        report_unknown_own(work, scope, name, span);
        return std::nullopt;
    }
    if (meaning->has_error) return std::nullopt;
    if (meaning->is_definition()) {
        if (reads_definitions(scope)) {
            return Node{std::get<DefinitionId>(meaning->id), span, meaning->type};
        }
        report(work, span, fmt::format("'{}' is a definition and cannot be read here", name),
               is_of_cells(work, scope) ? "it has no value when a stage starts"
                                        : "definitions can be read in rates and other definitions");
        return std::nullopt;
    }
    if (scope.context == Context::bound &&
        system_at(work, scope.system).is_species(meaning->item())) {
        report(work, span, "a bound is made of numbers and parameters only",
               fmt::format("'{}' is a species", name));
        return std::nullopt;
    }
    return Node{meaning->item(), span, meaning->type};
}

/// Resolves t, s, part, and what a shape declares itself.
std::optional<Node> resolve_in_shape(Workspace& work, const Scope& scope, std::string_view name,
                                     Span span) {
    if (name == "pi") return Node{std::numbers::pi, span};
    const Meaning* meaning = find(work.names[scope.system], name);
    if (meaning == nullptr) {
        if (is_incomplete(work, scope.system)) return std::nullopt;
        const System& system = system_at(work, scope.system);
        std::vector<std::string> names = quantity_names(system);
        for (const Definition& each : system.definitions) names.push_back(each.name);
        const std::string hint = did_you_mean(work, name, names);
        if (hint.empty()) {
            report_constant(work, scope, name, span);
        } else {
            report(work, span, fmt::format("a shape cannot read '{}'", name), hint);
        }
        return std::nullopt;
    }
    if (meaning->has_error) return std::nullopt;
    if (meaning->is_definition()) {
        return Node{std::get<DefinitionId>(meaning->id), span, meaning->type};
    }
    return Node{meaning->item(), span};
}

void report_first_stage(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    std::string hint;
    if (scope.system != unknown_system && !is_hopeless(work)) {
        const System& system = system_at(work, scope.system);
        if (find(work.names[scope.system], name) != nullptr) {
            hint = fmt::format("[{0}] is the '{0}' of this stage", name);
        } else {
            hint = did_you_mean(work, name, readable_names(system, scope));
        }
    }
    report(work, span,
           fmt::format("'{}' reads the previous stage, but this is the first stage", name),
           std::move(hint));
}

void report_unknown_previous(Workspace& work, const Scope& scope, std::string_view name,
                             Span span) {
    const Stage& previous = work.program.stages[*scope.stage - 1];
    const System& system = system_at(work, previous.system);
    if (is_hopeless(work)) return report(work, span, not_a_parameter(name, system), "");
    if (auto explained = explain_family(work, system, name)) {
        return report(work, span, std::move(explained->message), std::move(explained->hint));
    }
    if (is_incomplete(work, previous.system)) return;
    std::string hint;
    if (scope.system != unknown_system && find(work.names[scope.system], name) != nullptr) {
        hint = fmt::format("[{0}] is the '{0}' of this stage", name);
    } else {
        hint = advice_about(name, WordContext::value);
        if (hint.empty()) hint = did_you_mean(work, name, readable_names(system, scope));
    }
    report(work, span, not_a_parameter(name, system), std::move(hint),
           fmt::format("bare names read the previous stage '{}' ({}: {})", previous.name,
                       system.name, list_names(quantity_names(system))));
}

std::optional<Node> resolve_other(Workspace& work, const Scope& scope, std::uint32_t stage,
                                  std::string_view name, Span span) {
    const System& system = system_at(work, work.program.stages[stage].system);
    const Meaning* meaning = find(work.names[work.program.stages[stage].system], name);
    if (meaning == nullptr || meaning->has_error) return std::nullopt;
    if (meaning->is_definition()) {
        report(work, span,
               fmt::format("'{}' is a definition of {}, not a value of its stages", name,
                           system.name),
               "");
        return std::nullopt;
    }
    const StageItem item{stage, meaning->item()};
    if (system.cells) {
        if (!knows_cells(work, scope, item, span)) return std::nullopt;
    } else if (is_of_cells(work, scope)) {
        return Node{SensedItem{item}, span};
    }
    return Node{item, span, meaning->type};
}

std::optional<Node> resolve_previous(Workspace& work, const Scope& scope, std::string_view name,
                                     Span span) {
    if (report_reserved(work, scope, name, span)) return std::nullopt;
    if (*scope.stage == 0) {
        report_first_stage(work, scope, name, span);
        return std::nullopt;
    }
    const std::uint32_t previous = *scope.stage - 1;
    const SystemId system = work.program.stages[previous].system;
    if (system == unknown_system) return std::nullopt;
    if (find(work.names[system], name) == nullptr) {
        report_unknown_previous(work, scope, name, span);
        return std::nullopt;
    }
    return resolve_other(work, scope, previous, name, span);
}

std::vector<std::string> stage_names(const Workspace& work, std::size_t count) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < count && i < work.program.stages.size(); ++i) {
        names.push_back(work.program.stages[i].name);
    }
    return names;
}

/// The stage of `stage.name`; reports an error if it cannot be read.
std::optional<std::uint32_t> find_stage(Workspace& work, const Scope& scope,
                                        const ast::Qualified& qualified) {
    const std::string_view name = qualified.stage.text;
    const auto found = work.stages.find(std::string(name));
    const bool picture = scope.context == Context::picture;
    const std::size_t readable = picture ? scope.last_stage + 1u : *scope.stage;
    if (found == work.stages.end()) {
        std::string hint;
        if (!is_hopeless(work)) hint = did_you_mean(work, name, stage_names(work, readable));
        report(work, qualified.stage.span, fmt::format("there is no stage '{}'", name),
               std::move(hint));
        return std::nullopt;
    }
    if (found->second < readable) {
        note_use(work, qualified.stage.span, work.program.stages[found->second].span);
        return found->second;
    }
    if (picture) {
        report(work, qualified.stage.span, fmt::format("stage '{}' has not run yet", name), "");
    } else if (found->second == *scope.stage) {
        report(work, qualified.stage.span, fmt::format("'{}' is this stage itself", name),
               fmt::format("write [{}]", qualified.name.text));
    } else {
        report(work, qualified.stage.span, fmt::format("stage '{}' runs after this one", name),
               "a stage can read earlier stages only");
    }
    return std::nullopt;
}

}  // namespace

void note_use(Workspace& work, Span use, Span declaration) {
    if (work.uses != nullptr) work.uses->push_back({use, declaration});
}

void note_use(Workspace& work, Span use, SystemId index,
              const std::variant<ItemId, DefinitionId>& id) {
    if (work.uses == nullptr || index == unknown_system) return;
    const System& system = system_at(work, index);
    if (const auto* definition = std::get_if<DefinitionId>(&id)) {
        return note_use(work, use, system.definitions[*definition].span);
    }
    const ItemId item = std::get<ItemId>(id);
    if (item >= system.frozen_item()) return;
    // Quantities that every system of its kind has, such as t of a shape, stand nowhere.
    const Span declaration = system.quantities[item].span;
    if (declaration != system.span) note_use(work, use, declaration);
}

void note_declarations(Workspace& work, SystemId index) {
    const System& system = system_at(work, index);
    note_use(work, system.span, system.span);
    std::vector<SystemId> bases = system.joined;
    if (system.base) bases.push_back(*system.base);
    const auto note = [&](const auto& declared) {
        if (declared.span == system.span) return;
        note_use(work, declared.span, declared.span);
        for (const SystemId base : bases) {
            const Meaning* meaning = find(work.names[base], declared.name);
            if (meaning != nullptr && !meaning->has_error)
                note_use(work, declared.span, base, meaning->id);
        }
    };
    for (const Quantity& quantity : system.quantities) note(quantity);
    for (const Definition& definition : system.definitions) note(definition);
}

void note_use(Workspace& work, const Scope& scope, const Node& node, Span use) {
    if (const auto* item = node.as<ItemId>()) return note_use(work, use, scope.system, *item);
    if (const auto* rate = node.as<Rate>()) return note_use(work, use, scope.system, rate->species);
    if (const auto* id = node.as<DefinitionId>()) return note_use(work, use, scope.system, *id);
    const auto* sensed = node.as<SensedItem>();
    const auto* other = sensed != nullptr ? &sensed->item : node.as<StageItem>();
    if (other == nullptr) return;
    note_use(work, use, work.program.stages[other->stage].system, other->item);
}

std::optional<Node> resolve_bare(Workspace& work, const Scope& scope, std::string_view name,
                                 Span span) {
    if (scope.context == Context::shape) return resolve_in_shape(work, scope, name, span);
    const auto of_cell = cell_value_named(name);
    if (of_cell && !is_constant(scope) && is_of_cells(work, scope)) {
        return resolve_cell_value(work, scope, *of_cell, span);
    }
    if (reserved(name) == Reserved::builtin) return resolve_builtin(work, scope, name, span);
    if (is_constant(scope)) {
        report_reserved(work, scope, name, span);
        return std::nullopt;
    }
    if (scope.context == Context::value && scope.stage) {
        return resolve_previous(work, scope, name, span);
    }
    return resolve_own(work, scope, name, span);
}

std::optional<Node> resolve_bracketed(Workspace& work, const Scope& scope, const ast::Word& name,
                                      Span span) {
    if (is_constant(scope)) {
        report_constant(work, scope, name.text, span);
        return std::nullopt;
    }
    auto node = resolve_own(work, scope, name.text, name.span);
    if (node) node->span = span;
    return node;
}

std::optional<Node> resolve_qualified(Workspace& work, const Scope& scope,
                                      const ast::Qualified& qualified, Span span) {
    if (is_constant(scope)) {
        report_constant(work, scope, qualified.name.text, span);
        return std::nullopt;
    }
    if (!scope.stage && !is_of_cells(work, scope)) {
        const Meaning* own = find(work.names[scope.system], qualified.stage.text);
        if (own != nullptr && own->type == ValueType::vector) {
            report(work, qualified.name.span, "a vector has the components x, y and z",
                   fmt::format("write {}.x", qualified.stage.text));
            return std::nullopt;
        }
        report(work, span, "a system cannot read a stage",
               "a system does not know what ran before it");
        return std::nullopt;
    }
    const auto stage =
        scope.stage ? find_stage(work, scope, qualified) : find_sensed_stage(work, qualified);
    if (!stage) return std::nullopt;
    const SystemId index = work.program.stages[*stage].system;
    if (index == unknown_system) return std::nullopt;
    if (scope.context == Context::picture && stage == scope.stage) {
        return resolve_own(work, scope, qualified.name.text, qualified.name.span);
    }
    if (report_reserved(work, scope, qualified.name.text, qualified.name.span)) {
        return std::nullopt;
    }
    if (find(work.names[index], qualified.name.text) == nullptr) {
        const System& system = system_at(work, index);
        if (auto explained = explain_family(work, system, qualified.name.text)) {
            report(work, qualified.name.span, std::move(explained->message),
                   std::move(explained->hint));
            return std::nullopt;
        }
        const std::vector<std::string> names = quantity_names(system);
        std::string hint = did_you_mean(work, qualified.name.text, names);
        report(work, qualified.name.span, not_a_parameter(qualified.name.text, system),
               std::move(hint),
               fmt::format("stage '{}' has {}", qualified.stage.text, list_names(names)));
        return std::nullopt;
    }
    return resolve_other(work, scope, *stage, qualified.name.text, qualified.name.span);
}

void report_not_species(Workspace& work, SystemId index, std::string_view name, Span span) {
    if (is_incomplete(work, index)) return;
    const System& system = work.program.systems[index];
    if (auto explained = explain_family(work, system, name)) {
        return report(work, span, std::move(explained->message), std::move(explained->hint));
    }
    std::vector<std::string> species;
    for (const Quantity& quantity : system.quantities) {
        if (quantity.is_species) species.push_back(quantity.name);
    }
    report(work, span, fmt::format("'{}' is not a species of {}", name, system.name),
           did_you_mean(work, name, species));
}

std::optional<Node> resolve_rate(Workspace& work, const Scope& scope, const ast::Word& name,
                                 Span span) {
    if (is_constant(scope)) {
        report_constant(work, scope, name.text, span);
        return std::nullopt;
    }
    if (scope.context != Context::rate) {
        report(work, span, fmt::format("the rate {}' cannot be read here", name.text),
               "rates can be read in rates and definitions");
        return std::nullopt;
    }
    const auto& cells = system_at(work, scope.system).cells;
    if (cells && (name.text == "p" || name.text == "turn")) {
        return Node{name.text == "p" ? cells->velocity : cells->spin, span, ValueType::vector};
    }
    const Meaning* meaning = find(work.names[scope.system], name.text);
    if (meaning != nullptr && meaning->has_error) return std::nullopt;
    if (const auto species = find_species(work, scope.system, name.text)) {
        return Node{Rate{*species}, span};
    }
    report_not_species(work, scope.system, name.text, name.span);
    return std::nullopt;
}

}  // namespace cascade::checking
