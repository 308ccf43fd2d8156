// Reports unknown names. Hints come from tables of words of other programs. If these tables do not
// contain the word, hints come from similar names.
#include "lang/check/names/unknown_names.h"

#include "lang/vocabulary/units.h"
#include "lang/vocabulary/words_elsewhere.h"
#include "lang/library/library.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace cascade::checking {

namespace {

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

/// The hint "write 'u * v'" for uv if u and v are known names; else empty.
std::string hint_of_joined(std::string_view name, const std::vector<std::string>& known) {
    for (std::size_t size = 1; size < name.size(); ++size) {
        const std::string_view left = name.substr(0, size), right = name.substr(size);
        const bool is_product = std::ranges::find(known, left) != known.end() &&
                                std::ranges::find(known, right) != known.end();
        if (is_product) return fmt::format("write '{} * {}'", left, right);
    }
    return "";
}

/// The hint "write 'dxx(u)'" for u_xx, or for d2u in d2u/dx2, if u is a known name.
std::string hint_of_subscript(std::string_view name, const std::vector<std::string>& known) {
    if (name.starts_with("d2") && std::ranges::find(known, name.substr(2)) != known.end()) {
        return fmt::format("d2{0}/dx2 is dxx({0})", name.substr(2));
    }
    const auto is_known = [&](std::string_view word) {
        return std::ranges::find(known, word) != known.end();
    };
    // Looks for dudx, and for du in du/dx.
    for (const std::string_view axis : {"dx", "dy", "dz"}) {
        const bool is_whole = name.ends_with(axis) && name.size() > axis.size() + 1;
        const std::string_view of = name.substr(1, name.size() - 1 - (is_whole ? axis.size() : 0));
        const bool is_derivative = name.size() > 1 && name[0] == 'd' && is_known(of);
        if (is_derivative && is_whole) return fmt::format("write '{}({})'", axis, of);
        if (is_derivative) return fmt::format("d{0}/dx is dx({0})", of);
    }
    if (const auto species = species_of_rate(name); is_known(species)) {
        return fmt::format("write {}'", species);
    }
    const std::size_t bar = name.rfind('_');
    if (bar == name.npos) return hint_of_joined(name, known);
    const std::string_view operation = name.substr(0, bar), operand = name.substr(bar + 1);
    const auto function = function_named(operation);
    if (function && info(*function).arity.takes(1) && is_known(operand)) {
        return fmt::format("write '{}({})'", operation, operand);
    }
    const std::string_view of = name.substr(0, bar), axes = name.substr(bar + 1);
    const bool is_derivative = !axes.empty() && axes.size() <= 2 &&
                               axes.find_first_not_of("xyz") == axes.npos &&
                               function_named(fmt::format("d{}", axes));
    if (!is_derivative || std::find(known.begin(), known.end(), of) == known.end()) return "";
    return fmt::format("write 'd{}({})'", axes, of);
}

/// The hint if the name of a stage is written where a name of one of the stage's species is
/// expected.
std::string hint_of_stage(const Workspace& work, std::string_view name) {
    for (const Stage& stage : work.program.stages) {
        if (stage.name != name || stage.system == unknown_system) continue;
        for (const Quantity& quantity : work.program.systems[stage.system].quantities) {
            if (!quantity.is_species) continue;
            return fmt::format("it is a stage: write {}.{}", name, quantity.name);
        }
    }
    return "";
}

}  // namespace

void report_constant(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    if (scope.context == Context::position) {
        report(work, span, fmt::format("a surface cannot read '{}'", name),
               "use numbers, sx, sy, pi and functions of these");
        return;
    }
    if (scope.context == Context::mask) {
        report(work, span, fmt::format("a mask cannot read '{}'", name),
               "use coordinates, numbers, shapes, noise and files");
        return;
    }
    if (scope.context == Context::shape) {
        report(work, span, fmt::format("a shape cannot read '{}'", name),
               "a shape can read only t, s, part and its own numbers");
        return;
    }
    if (scope.is_length) {
        report(work, span, fmt::format("{} cannot read '{}'", scope.subject, name),
               "write a formula of numbers and t, as in extent: 10 * exp(0.01 * t)");
        return;
    }
    if (reserved(name) == Reserved::builtin && varies_by_cell(name)) {
        report(work, span,
               fmt::format("{} must be one number, but '{}' varies by cell", scope.subject, name),
               "");
        return;
    }
    const bool is_growth = name == "t" && scope.subject == "unit";
    report(work, span, fmt::format("{} must be one number", scope.subject),
           is_growth
               ? "write extent: 30 * exp(0.01 * t) for the length of the longest side in units"
               : "use only numbers, operators and functions of numbers");
}

std::string not_a_parameter(std::string_view name, const System& system) {
    return fmt::format("'{}' is not a parameter of {}", name, system.name);
}

void report_unknown_own(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    const System& system = work.program.systems[scope.system];
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
    if (!work.units.empty() && unit_named(name)) {
        hint = "a unit follows its number after one blank and contains none, as in 0.2 /s";
    }
    if (cell_value_named(name))
        hint = fmt::format("'{}' can be used only by cells that crawl", name);
    std::string note = fmt::format("{} has {}", system.name, names);
    if (scope.context == Context::value && scope.stage) {
        note = fmt::format("[name] reads a value of this stage ({}: {})", system.name, names);
        if (reserved(name) == Reserved::builtin) {
            hint = fmt::format("'{}' is built in and needs no brackets", name);
        }
    }
    report(work, span, not_a_parameter(name, system), std::move(hint), std::move(note));
}

void report_first_stage(Workspace& work, const Scope& scope, std::string_view name, Span span) {
    std::string hint;
    if (function_named(name)) {
        hint = fmt::format("'{0}' is a function: {0}(…)", name);
    } else if (scope.system != unknown_system && !is_hopeless(work)) {
        const System& system = work.program.systems[scope.system];
        if (find(work.names[scope.system], name) != nullptr) {
            hint = fmt::format("write [{0}] for the '{0}' of this stage", name);
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
    const System& system = work.program.systems[previous.system];
    if (is_hopeless(work)) return report(work, span, not_a_parameter(name, system), "");
    if (auto explained = explain_family(work, system, name)) {
        return report(work, span, std::move(explained->message), std::move(explained->hint));
    }
    if (is_incomplete(work, previous.system)) return;
    std::string hint;
    if (scope.system != unknown_system && find(work.names[scope.system], name) != nullptr) {
        hint = fmt::format("write [{0}] for the '{0}' of this stage", name);
    } else {
        hint = advice_about(name, WordContext::value);
        if (hint.empty()) hint = hint_of_stage(work, name);
        if (hint.empty()) hint = did_you_mean(work, name, readable_names(system, scope));
    }
    report(work, span, not_a_parameter(name, system), std::move(hint),
           fmt::format("a name without brackets reads the previous stage '{}' ({}: {})",
                       previous.name, system.name, list_names(quantity_names(system))));
}

void report_unknown_system(Workspace& work, const ast::Word& name) {
    std::vector<std::string> names;
    if (!is_hopeless(work)) {
        for (const LibraryText& text : library_texts()) names.emplace_back(text.system_name());
        for (const System& system : work.program.systems) {
            if (!system.built_in) names.push_back(system.name);
        }
    }
    Diagnostic diagnostic;
    diagnostic.span = name.span;
    diagnostic.message = fmt::format("there is no system '{}'", name.text);
    diagnostic.hint = did_you_mean(work, name.text, names);
    diagnostic.notes.push_back(
        {std::nullopt, "'cascade systems' lists the systems of the library"});
    work.diagnostics.add(std::move(diagnostic));
}

void report_unknown_shape(Workspace& work, const ast::Script& script, const ast::Word& name) {
    std::vector<std::string> names;
    for (const LibraryText& text : library_shapes()) names.emplace_back(text.system_name());
    for (const ast::Block& block : script.blocks) {
        if (block.kind == ast::BlockKind::shape) names.emplace_back(block.name.text);
    }
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    const std::string hint = did_you_mean(work, name.text, names);
    work.diagnostics.error(name.span, fmt::format("there is no shape '{}'", name.text),
                           hint.empty() ? "shapes are " + list_names(names) : hint);
}

}  // namespace cascade::checking
