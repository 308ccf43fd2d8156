// Makes texts for messages about words: reserved words, suggestions of similar names, and lists of
// names.
#include "core/near_name.h"
#include "lang/check/names/check_names.h"
#include "lang/program/cell_items.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

/// After this number of errors, no more suggestions are made.
constexpr std::size_t most_suggestions = 200;
constexpr std::size_t most_names_compared = 1'000'000;
constexpr std::size_t most_listed = 24;

}  // namespace

NameTable names_of(const System& system) {
    NameTable table;
    table.reserve(system.item_count() + system.definitions.size());
    for (const ItemId item : system.items()) {
        table.try_emplace(std::string(system.item_name(item)), Meaning{item});
    }
    for (const DefinitionId id : system.definitions.ids()) {
        const auto& [name, span, formula] = system.definitions[id];
        const bool is_known = !formula.nodes.empty();
        const ValueType type = is_known ? formula.nodes.back().type : ValueType::number;
        table.try_emplace(name, Meaning{id, false, type});
    }
    if (system.cells) {
        table.try_emplace("p", Meaning{system.cells->place, false, ValueType::vector});
    }
    return table;
}

const Meaning* find(const NameTable& table, std::string_view name) {
    const auto found = table.find(std::string(name));
    return found == table.end() ? nullptr : &found->second;
}

std::optional<ItemId> find_species(const Workspace& work, SystemId system, std::string_view name) {
    const Meaning* meaning = find(work.names[system], name);
    const bool is_species = meaning != nullptr && !meaning->is_definition() &&
                            work.program.systems[system].is_species(meaning->item());
    return is_species ? std::optional(meaning->item()) : std::nullopt;
}

std::optional<SideSubject> find_subject(const Workspace& work, SystemId system,
                                        std::string_view name) {
    const Meaning* meaning = find(work.names[system], name);
    if (meaning != nullptr && meaning->is_definition() && meaning->type == ValueType::number) {
        return std::get<DefinitionId>(meaning->id);
    }
    if (const auto species = find_species(work, system, name)) return *species;
    return std::nullopt;
}

bool is_incomplete(const Workspace& work, SystemId system) {
    return system < work.incomplete.next() && work.incomplete[system];
}

bool is_hopeless(const Workspace& work) {
    return work.diagnostics.error_count() > most_suggestions ||
           work.names_compared > most_names_compared;
}

std::string did_you_mean(Workspace& work, std::string_view name,
                         const std::vector<std::string>& candidates) {
    if (is_hopeless(work)) return "";
    work.names_compared += candidates.size();
    const std::string near = nearest_name(name, candidates);
    return near.empty() ? "" : fmt::format("did you mean '{}'?", near);
}

std::string hint_about(Workspace& work, std::string_view word, WordContext context,
                       const std::vector<std::string>& candidates) {
    std::string hint(advice_about(word, context));
    if (hint.empty()) hint = home_of(word);
    return hint.empty() ? did_you_mean(work, word, candidates) : hint;
}

std::string with_number(std::string advice, const ast::Expr& value) {
    const auto* const number = std::get_if<ast::Number>(&value.node);
    const std::size_t colon = advice.rfind(": ");
    if (number == nullptr || colon == advice.npos) return advice;
    const std::size_t begin = colon + 2, end = advice.find_first_not_of("0123456789.", begin);
    const std::string_view rest = std::string_view(advice).substr(std::min(end, advice.size()));
    if (end == begin || (!rest.starts_with("'") && !rest.starts_with(" }'"))) return advice;
    return advice.replace(begin, end - begin, fmt::format("{}", number->value));
}

namespace {

/// Calls `take` with the index of each member of a family, as a text.
template <typename Take>
void each_member(const System& system, std::string_view family, const Take& take) {
    const auto look = [&](const std::string& name) {
        const bool is_member =
            name.size() > family.size() && name.starts_with(family) && name[family.size()] == '[';
        if (is_member) take(std::string_view(name).substr(family.size() + 1));
    };
    for (const Quantity& quantity : system.quantities) look(quantity.name);
    for (const Definition& definition : system.definitions) look(definition.name);
}

}  // namespace

bool has_family(const System& system, std::string_view name) {
    bool has = false;
    each_member(system, name, [&](std::string_view) { has = true; });
    return has;
}

std::optional<Explanation> explain_family(Workspace& work, const System& system,
                                          std::string_view name) {
    if (is_hopeless(work)) return std::nullopt;
    work.names_compared += system.quantities.size() + system.definitions.size();
    const std::string_view family = name.substr(0, name.find('['));
    std::string first, last;
    each_member(system, family, [&](std::string_view number) {
        last = std::string(number.substr(0, number.find(']')));
        if (first.empty()) first = last;
    });
    if (family.size() < name.size() && !first.empty()) {
        return Explanation{fmt::format("'{}' is not a member of its family", name),
                           fmt::format("there are {0}[{1}] to {0}[{2}]", family, first, last)};
    }
    if (family.size() < name.size()) {
        const auto same =
            std::find_if(system.quantities.begin(), system.quantities.end(),
                         [&](const Quantity& quantity) { return quantity.name == family; });
        if (same == system.quantities.end()) return std::nullopt;
        return Explanation{fmt::format("'{}' is not a family", family),
                           fmt::format("write {} without an index", family)};
    }
    if (!first.empty()) {
        const bool is_matrix = first.find(',') != std::string::npos;
        return Explanation{fmt::format("'{}' is a family", name),
                           fmt::format("write {0}[{1}], or {0}[{2}] where {3} a value", name, first,
                                       is_matrix ? "i, j" : "i",
                                       is_matrix ? "i and j have" : "i has")};
    }
    for (const Index& index : system.indices) {
        if (index.name != name) continue;
        return index_without_value(name);
    }
    return std::nullopt;
}

Explanation index_without_value(std::string_view index) {
    return {fmt::format("the index '{}' has no value here", index),
            fmt::format("it has a value in statements of u[{0}] and in sum(… over {0})", index)};
}

void add_call(const Workspace& work, Diagnostic& diagnostic) {
    if (work.call) diagnostic.notes.push_back({*work.call, "the function is called here"});
}

void report(Workspace& work, Span span, std::string message, std::string hint, std::string note) {
    Diagnostic diagnostic;
    diagnostic.span = span;
    diagnostic.message = std::move(message);
    diagnostic.hint = std::move(hint);
    if (!note.empty()) diagnostic.notes.push_back({std::nullopt, std::move(note)});
    add_call(work, diagnostic);
    work.diagnostics.add(std::move(diagnostic));
}

std::vector<std::string> quantity_names(const System& system) {
    std::vector<std::string> names;
    for (const ItemId item : system.quantities.ids()) {
        if (is_component(system, item)) continue;
        names.push_back(system.quantities[item].name);
    }
    if (system.cells) names.emplace_back("p");
    std::sort(names.begin(), names.end());
    return names;
}

std::string describe_cycle(const std::vector<std::string>& names) {
    constexpr std::size_t most_named = 12;
    std::string path;
    for (std::size_t i = 0; i < std::min(names.size(), most_named); ++i) path += names[i] + " -> ";
    if (names.size() > most_named) path += "… -> ";
    return path + names.front();
}

std::string list_names(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i == most_listed) return list + ", …";
        if (i > 0) list += ", ";
        list += names[i];
    }
    return list;
}

void report_twice(Workspace& work, Span second, Span first, std::string message) {
    Diagnostic diagnostic;
    diagnostic.span = second;
    diagnostic.message = std::move(message);
    diagnostic.notes.push_back({first, "the first is here"});
    work.diagnostics.add(std::move(diagnostic));
}

void mark_reads(Workspace& work, const Formula& formula, SystemId system) {
    for (const Node& node : formula.nodes) {
        if (const auto* own = node.as<ItemId>()) work.items_read[system][*own] = true;
        if (const auto* id = node.as<DefinitionId>()) work.definitions_read[system][*id] = true;
        const auto* const sensed = node.as<SensedItem>();
        const auto* const earlier = sensed != nullptr ? &sensed->item : node.as<StageItem>();
        if (earlier != nullptr) {
            const SystemId other = work.program.stages[earlier->stage].system;
            if (other != unknown_system) work.items_read[other][earlier->item] = true;
        }
    }
    for_each_kernel(formula, *work.program.literals, [&](const ConvolutionKernel& kernel) {
        mark_reads(work, kernel.weight, system);
        mark_reads(work, kernel.reach, system);
    });
}

}  // namespace cascade::checking
