// Resolves names: finds the item, the definition or the built-in value that a word in an expression
// means.
#include "lang/check/names/check_names.h"

#include "lang/check/names/note_uses.h"
#include "lang/check/names/unknown_names.h"
#include "lang/vocabulary/words_elsewhere.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>

namespace cascade::checking {

namespace {

const System& system_at(const Workspace& work, SystemId index) {
    return work.program.systems[index];
}

/// Whether the names of a system cannot be read by an expression in this scope.
bool is_constant(const Scope& scope) {
    return scope.context == Context::constant || scope.context == Context::position ||
           scope.context == Context::mask || scope.context == Context::shape;
}

bool is_of_model(std::string_view name) {
    const auto builtin = builtin_named(name);
    return builtin && is_of_model(*builtin);
}

std::optional<Node> resolve_builtin(Workspace& work, const Scope& scope, std::string_view name,
                                    Span span) {
    if (name == "pi") return Node{std::numbers::pi, span};
    if (scope.context == Context::constant) {
        if (scope.is_length && name == "t") return Node{Builtin::t, span};
        report_constant(work, scope, name, span);
        return std::nullopt;
    }
    if (scope.context == Context::bound) {
        report(work, span, "a bound can contain only numbers and parameters", "");
        return std::nullopt;
    }
    if ((scope.context == Context::position || scope.context == Context::mask) &&
        is_of_model(name)) {
        report_constant(work, scope, name, span);
        return std::nullopt;
    }
    if (scope.context == Context::position && !varies_by_cell(name)) {
        report(work, span, fmt::format("a surface cannot depend on '{}'", name),
               "a surface does not change during a run");
        return std::nullopt;
    }
    if (scope.context == Context::mask && !varies_by_cell(name)) {
        report(work, span, fmt::format("a mask cannot depend on '{}'", name),
               "a mask does not change during a run");
        return std::nullopt;
    }
    if (scope.context == Context::value && !varies_by_cell(name) && !scope.is_side) {
        report(work, span, fmt::format("'{}' has no value when a stage starts", name),
               "read it in rates, definitions and pictures");
        return std::nullopt;
    }
    return Node{*builtin_named(name), span};
}

/// Reports words of the language that do not name values of a stage.
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

/// Whether an expression in this scope can read definitions. In rates, the values of definitions
/// are known. For sides and pictures, definitions are computed.
bool reads_definitions(const Scope& scope) {
    return scope.context == Context::rate || scope.context == Context::picture || scope.is_side;
}

/// Resolves a name of the system itself, or of the stage to which the statement or the picture
/// belongs.
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
               is_of_cells(work, scope) ? "a definition has no value when a stage starts"
                                        : "definitions can be read in rates and other definitions");
        return std::nullopt;
    }
    if (scope.context == Context::bound &&
        system_at(work, scope.system).is_species(meaning->item())) {
        report(work, span, "a bound can contain only numbers and parameters",
               fmt::format("'{}' is a species", name));
        return std::nullopt;
    }
    return Node{meaning->item(), span, meaning->type};
}

/// Resolves t, s, part, and names that a shape declares.
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

/// The stage called `stage` in `stage.name`. Reports an error if the scope cannot read the stage.
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
               "a stage can read only earlier stages");
    }
    return std::nullopt;
}

}  // namespace

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

namespace {

/// Whether F or pi is written as `system.F`, `self.F` or `math.pi`, as in other languages.
bool is_own_name(const Workspace& work, const Scope& scope, const ast::Qualified& qualified) {
    static constexpr std::array<std::string_view, 5> prefixes = {"self", "this", "np", "numpy",
                                                                 "math"};
    const std::string_view prefix = qualified.stage.text, name = qualified.name.text;
    const bool is_prefix = std::ranges::find(prefixes, prefix) != prefixes.end() ||
                           prefix == work.program.systems[scope.system].name;
    return is_prefix && !work.stages.contains(std::string(prefix)) &&
           (name == "pi" || find(work.names[scope.system], name) != nullptr);
}

}  // namespace

std::optional<Node> resolve_qualified(Workspace& work, const Scope& scope,
                                      const ast::Qualified& qualified, Span span) {
    if (is_constant(scope)) {
        report_constant(work, scope, qualified.name.text, span);
        return std::nullopt;
    }
    if (!scope.stage && !is_of_cells(work, scope)) {
        const Meaning* own = find(work.names[scope.system], qualified.stage.text);
        if (own != nullptr && own->type == ValueType::vector) {
            report(work, qualified.name.span, "a vector has only the components x, y and z",
                   fmt::format("write {}.x", qualified.stage.text));
            return std::nullopt;
        }
        if (is_own_name(work, scope, qualified)) {
            report(work, span, "a system must read its own names without a prefix",
                   fmt::format("write '{}'", qualified.name.text));
            return std::nullopt;
        }
        report(work, span, "a system cannot read a stage",
               "read the stage in a value (name: …) of a later stage");
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
    std::string hint = did_you_mean(work, name, species);
    // The name may be u_t, because the parser has turned the u'' of a rate into u_t.
    const std::string_view of = species_of_rate(name);
    if (std::ranges::find(species, of) != species.end()) {
        hint = fmt::format("{0}'' is a second rate; the second derivative along x is dxx({0})", of);
    }
    report(work, span, fmt::format("'{}' is not a species of {}", name, system.name),
           std::move(hint));
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
