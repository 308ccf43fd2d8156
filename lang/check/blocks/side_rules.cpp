// Parses rules at sides, and checks their values.
#include "lang/check/blocks/side_rules.h"

#include "lang/calculus/side_values.h"
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/systems/declarations.h"
#include "lang/check/names/note_uses.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
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
        work.diagnostics.error(statement.span, "the rule of a side is written with ':'",
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
        if (const auto* number = std::get_if<ast::Number>(&value.node)) {
            hint = fmt::format("write 'fixed({})'", number->value);
        }
        work.diagnostics.error(value.span,
                               "a side must be periodic, noflux, fixed(…), slope(…) or flux(…)",
                               std::move(hint));
        return std::nullopt;
    }
    const bool is_border = statement.side.text == "border" || statement.name.text == "border";
    if (*kind == SideKind::periodic && is_border) {
        work.diagnostics.error(value.span, "the border of a mask cannot be periodic",
                               "write noflux, fixed(…), slope(…) or flux(…)");
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
    // The call has one argument, whose nodes come directly before the call.
    return WrittenSide{*kind,
                       ast::Expression{written.first, script.arguments[call->first_argument]}};
}

void leave_border(Workspace& work, SideSetting& border) {
    if (takes_value(border.kind)) {
        work.diagnostics.warning(border.span,
                                 "this border is ignored, because the domain has no "
                                 "mask");
    }
    border = {};
}

std::vector<Side> sides_of_word(std::string_view word) {
    std::vector<Side> sides;
    for (std::size_t side = 0; side < wall_count; ++side) {
        const bool is_meant = word == side_names[side] || (word == "sides" && side < side_count);
        if (is_meant) sides.push_back(static_cast<Side>(side));
    }
    return sides;
}

namespace {

/// Moves statements about all `sides` to the front, because rules for single sides replace the
/// rules of these statements.
std::vector<const ast::Statement*> in_order(std::span<const ast::Statement> statements) {
    std::vector<const ast::Statement*> ordered;
    for (const ast::Statement& statement : statements) ordered.push_back(&statement);
    std::stable_partition(ordered.begin(), ordered.end(), [](const ast::Statement* statement) {
        return statement->side.text == "sides";
    });
    return ordered;
}

/// The span of the name that a statement sets, with the side: `u.left`.
Span head_of(const ast::Statement& statement) {
    return join(statement.name.span, statement.side.span);
}

}  // namespace

bool is_known_along_side(Workspace& work, const System& system, const Formula& value) {
    const Node* node = beyond_reach_of_side(system, value);
    if (node == nullptr) return true;
    const std::string_view function = info(node->function).spelling;
    work.diagnostics.error(
        node->span,
        fmt::format("in the rule of a side, {} cannot depend on species, t or step", function),
        "move species, t and step out of the brackets, which are computed once, when the stage "
        "starts");
    return false;
}

namespace {

/// Collects the rules in statements. A later rule replaces an earlier rule for the same side.
class RuleChecker {
public:
    RuleChecker(Workspace& work, const ast::Script& script, const Scope& scope)
        : work_(work), script_(script), scope_(scope), system_(work.program.systems[scope.system]) {
        scope_.is_side = true;
    }

    std::vector<SubjectSide> check(std::span<const ast::Statement> statements) {
        for (const ast::Statement* statement : in_order(statements)) {
            for (const Declaration& each :
                 stage_declarations(work_, system_, script_, *statement)) {
                if (!is_replaced(each)) check(each);
            }
        }
        // The order makes u[2].left override u[i].left.
        std::ranges::stable_sort(rules_, std::greater(), &Rule::indices);
        std::vector<SubjectSide> sides;
        for (const bool of_all : {true, false}) {
            for (Rule& rule : rules_) {
                if (rule.is_of_all == of_all) sides.push_back(std::move(rule.side));
            }
        }
        return sides;
    }

private:
    struct Rule {
        SubjectSide side;
        std::size_t indices = 0;  ///< How many indices are names: one in u[i], none in u[2].
        bool is_of_all = false;  ///< Whether the rule is for all `sides` and not for a single side.
    };

    /// Whether an earlier rule has the same side and subject. If so, the second statement is
    /// reported as an error.
    bool is_replaced(const Declaration& declaration) {
        const std::string side(declaration.statement->side.text);
        const std::string what = declaration.name + "." + side;
        const Span span = head_of(*declaration.statement);
        const auto [first, is_new] =
            seen_.try_emplace(what + std::string(declaration.indices.size(), '*'), span);
        if (!is_new) {
            report_twice(work_, span, first->second, fmt::format("'{}' is given twice", what));
        }
        return !is_new;
    }

    /// Whether a species or definition may have this rule. A definition has no diffusion, so it
    /// cannot have a flux, and it cannot be periodic by itself.
    bool is_for(const SideSubject& subject, const WrittenSide& written,
                const ast::Statement& statement) {
        const bool is_of_species =
            written.kind == SideKind::periodic || written.kind == SideKind::flux;
        if (std::holds_alternative<ItemId>(subject) || !is_of_species) return true;
        work_.diagnostics.error(
            head_of(statement), "the side of a definition must be noflux, fixed(…) or slope(…)",
            written.kind == SideKind::periodic
                ? "leave it out: the side is periodic if the sides of the species in the "
                  "definition are"
                : "write slope(…): the flux is this slope times the factor before lap or grad");
        return false;
    }

    void check(const Declaration& declaration) {
        const ast::Statement& statement = *declaration.statement;
        const Meaning* meaning = find(work_.names[scope_.system], declaration.name);
        if (meaning != nullptr && meaning->has_error) return;
        const auto subject = find_subject(work_, scope_.system, declaration.name);
        if (!subject) {
            return report_not_species(work_, scope_.system, declaration.name, head_of(statement));
        }
        note_use(work_, statement.name.span, scope_.system, *subject);
        const auto written = read_side(work_, script_, statement);
        if (!written || !is_for(*subject, *written, statement)) return;
        SideSetting setting{written->kind, {}, statement.span};
        if (written->value) {
            Scope scope = scope_;
            scope.indices = declaration.indices;
            auto checked = check_number(work_, script_, *written->value, scope);
            if (!checked || !is_known_along_side(work_, system_, checked->formula)) return;
            setting.value = std::move(checked->formula);
            mark_reads(work_, setting.value, scope_.system);
        }
        for (const Side side : sides_of_word(statement.side.text)) {
            rules_.push_back({{*subject, side, setting},
                              declaration.indices.size(),
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

std::vector<SubjectSide> read_side_rules(Workspace& work, const ast::Script& script,
                                         const Scope& scope,
                                         std::span<const ast::Statement> statements) {
    if (is_of_cells(work, scope)) {
        for (const ast::Statement& statement : statements) {
            work.diagnostics.error(head_of(statement), "cells that crawl have no sides",
                                   "keep cells away from a place by their rates, p' += …");
        }
        return {};
    }
    return RuleChecker(work, script, scope).check(statements);
}

}  // namespace cascade::checking
