// Parses rules at sides, and checks their values.
#include "lang/check/side_rules.h"

#include "lang/check/check_blocks.h"
#include "lang/check/declarations.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <unordered_map>

namespace cascade::checking {

namespace {

std::optional<SideKind> kind_of_word(std::string_view word) {
    const auto found = std::find(side_kind_words.begin(), side_kind_words.end(), word);
    if (found == side_kind_words.end()) return std::nullopt;
    return static_cast<SideKind>(found - side_kind_words.begin());
}

}  // namespace

std::optional<WrittenSide> read_side(Workspace& work, const ast::Script& script,
                                     const ast::Statement& statement) {
    if (statement.kind != ast::StatementKind::value) {
        work.diagnostics.error(statement.span, "a side is given with ':'",
                               fmt::format("write {}: …", statement.name.text));
        return std::nullopt;
    }
    if (!has_one_value(work, script, statement)) return std::nullopt;
    const ast::Expression written = statement.values[0];
    const ast::Expr& value = script.expressions[written.root];
    if (std::holds_alternative<ast::Garbage>(value.node)) return std::nullopt;
    const auto* name = std::get_if<ast::Name>(&value.node);
    const auto* call = std::get_if<ast::Call>(&value.node);
    const std::string_view word = name   ? name->name
                                  : call ? call->function.text
                                         : std::string_view();
    const auto kind = kind_of_word(word);
    if (!kind) {
        std::string hint(advice_about(word, WordContext::side));
        if (hint.empty()) hint = did_you_mean(work, word, words_taken_by(Setting::sides));
        work.diagnostics.error(value.span, "a side is periodic, noflux, fixed(…) or flux(…)",
                               std::move(hint));
        return std::nullopt;
    }
    if (takes_value(*kind) && (!call || call->argument_count != 1)) {
        work.diagnostics.error(value.span, fmt::format("{} takes one value", word),
                               fmt::format("write {}(0)", word));
        return std::nullopt;
    }
    if (!takes_value(*kind) && call) {
        work.diagnostics.error(value.span, fmt::format("{} takes no value", word),
                               fmt::format("write {}", word));
        return std::nullopt;
    }
    if (!call) return WrittenSide{*kind, std::nullopt};
    // The nodes of the only argument come directly before the call.
    return WrittenSide{*kind,
                       ast::Expression{written.first, script.arguments[call->first_argument]}};
}

std::vector<Side> sides_of_word(std::string_view word) {
    std::vector<Side> sides;
    for (std::size_t side = 0; side < side_count; ++side) {
        if (word == side_names[side] || word == "sides") sides.push_back(static_cast<Side>(side));
    }
    return sides;
}

namespace {

/// The statements with those of `sides` first, since a rule for a single side replaces theirs.
std::vector<const ast::Statement*> in_order(std::span<const ast::Statement> statements) {
    std::vector<const ast::Statement*> ordered;
    for (const ast::Statement& statement : statements) ordered.push_back(&statement);
    std::stable_partition(ordered.begin(), ordered.end(), [](const ast::Statement* statement) {
        return statement->side.text == "sides";
    });
    return ordered;
}

/// The place of what a statement sets: `u.left`.
Span head_of(const ast::Statement& statement) {
    return join(statement.name.span, statement.side.span);
}

/// At a side, t and step are uniform. Whatever needs the values of many cells, or the position of
/// one, is computed once when the stage starts, so it cannot depend on them.
bool is_known_along_side(Workspace& work, const Formula& value) {
    IdVector<NodeId, bool> changes;
    for (const Node& node : value.nodes) {
        bool is_changing = node.is(Builtin::t) || node.is(Builtin::step);
        if (node.is<Call>()) {
            for (const NodeId operand : node.reads()) is_changing |= changes[operand];
            const FunctionInfo& function = info(node.function);
            if (is_changing && (varies_by_cell(node.function) || function.is_aggregate)) {
                work.diagnostics.error(
                    node.span,
                    fmt::format("at a side {} cannot depend on t or step", function.spelling),
                    "put t and step outside: it is computed once, when the stage starts");
                return false;
            }
        }
        changes.push_back(is_changing);
    }
    return true;
}

/// The source to write in a rate instead of a flux that depends on a species: in the cells at the
/// side, since `lap` divides a flux through a face by the spacing.
std::string as_source(std::string_view species, Side side) {
    constexpr std::array<std::string_view, side_count> places{"sx < 1/W", "sx > 1 - 1/W",
                                                              "sy < 1/H", "sy > 1 - 1/H",
                                                              "sz < 1/D", "sz > 1 - 1/D"};
    constexpr std::array<std::string_view, 3> counts{"W columns", "H rows", "D slices"};
    const auto number = static_cast<std::size_t>(side);
    return fmt::format(
        "for flux(E) write noflux, and {0}' += k/h * (E) * ({1}) in the system: "
        "k times lap({0}), cells of side h, {2}",
        species, places[number], counts[number / 2]);
}

}  // namespace

bool reads_no_species(Workspace& work, const System& system, const SpeciesSide& side) {
    const auto& nodes = side.setting.value.nodes;
    const auto read = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) {
        return node.is<ItemId>() && system.is_species(*node.as<ItemId>());
    });
    if (read == nodes.end()) return true;
    const std::string_view name = system.item_name(*read->as<ItemId>());
    work.diagnostics.error(
        read->span, fmt::format("a side cannot follow '{}', which every step changes", name),
        side.setting.kind == SideKind::flux
            ? as_source(system.item_name(side.species), side.side)
            : fmt::format("a parameter keeps what {0} starts with: name: …; {0}: name", name));
    return false;
}

namespace {

/// Collects the rules of statements; later ones replace earlier ones.
class RuleChecker {
public:
    RuleChecker(Workspace& work, const ast::Script& script, const Scope& scope)
        : work_(work), script_(script), scope_(scope), system_(work.program.systems[scope.system]) {
        scope_.knows_time = true;
    }

    std::vector<SpeciesSide> check(std::span<const ast::Statement> statements) {
        for (const ast::Statement* statement : in_order(statements)) {
            for (const Declaration& each :
                 stage_declarations(work_, system_, script_, *statement)) {
                if (!is_replaced(each)) check(each);
            }
        }
        // u[2].left overrides u[i].left.
        std::stable_partition(rules_.begin(), rules_.end(),
                              [](const Rule& rule) { return rule.is_of_family; });
        std::vector<SpeciesSide> sides;
        for (const bool of_all : {true, false}) {
            for (Rule& rule : rules_) {
                if (rule.is_of_all == of_all) sides.push_back(std::move(rule.side));
            }
        }
        return sides;
    }

private:
    struct Rule {
        SpeciesSide side;
        bool is_of_family = false;  ///< Of u[i], not of u[2].
        bool is_of_all = false;     ///< Of `sides`, not of one of them.
    };

    /// A second statement about the same side is an error.
    bool is_replaced(const Declaration& declaration) {
        const std::string side(declaration.statement->side.text);
        const std::string what = declaration.name + "." + side;
        const Span span = head_of(*declaration.statement);
        const auto [first, is_new] = seen_.try_emplace(what + (declaration.index ? "*" : ""), span);
        if (!is_new) {
            report_twice(work_, span, first->second, fmt::format("'{}' is given twice", what));
        }
        return !is_new;
    }

    void check(const Declaration& declaration) {
        const ast::Statement& statement = *declaration.statement;
        const Meaning* meaning = find(work_.names[scope_.system], declaration.name);
        if (meaning != nullptr && meaning->has_error) return;
        const auto species = find_species(work_, scope_.system, declaration.name);
        if (!species) {
            return report_not_species(work_, scope_.system, declaration.name, head_of(statement));
        }
        const auto written = read_side(work_, script_, statement);
        if (!written) return;
        SideSetting setting{written->kind, {}, statement.span};
        if (written->value) {
            Scope scope = scope_;
            scope.index = declaration.index;
            auto checked = check_number(work_, script_, *written->value, scope);
            if (!checked || !is_known_along_side(work_, checked->formula)) return;
            setting.value = std::move(checked->formula);
            mark_reads(work_, setting.value, scope_.system);
            const Side side = sides_of_word(statement.side.text)[0];
            if (!reads_no_species(work_, system_, {*species, side, setting})) return;
        }
        for (const Side side : sides_of_word(statement.side.text)) {
            rules_.push_back({{*species, side, setting},
                              declaration.index.has_value(),
                              statement.side.text == "sides"});
        }
    }

    Workspace& work_;
    const ast::Script& script_;
    Scope scope_;
    const System& system_;
    std::vector<Rule> rules_;
    std::unordered_map<std::string, Span> seen_;
};

}  // namespace

std::vector<SpeciesSide> read_side_rules(Workspace& work, const ast::Script& script,
                                         const Scope& scope,
                                         std::span<const ast::Statement> statements) {
    if (is_of_cells(work, scope)) {
        for (const ast::Statement& statement : statements) {
            work.diagnostics.error(head_of(statement), "cells that crawl have no sides",
                                   "where cells may be, their rates say: p' += …");
        }
        return {};
    }
    return RuleChecker(work, script, scope).check(statements);
}

}  // namespace cascade::checking
