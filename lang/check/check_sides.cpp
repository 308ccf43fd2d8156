// Sides: what a species is at the sides of the grid. `u.left: fixed(1)` in a system or a stage,
// `left: fixed(0)` of all species in the domain.
#include "lang/check/check_blocks.h"
#include "lang/check/declarations.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <vector>

namespace cascade::checking {

namespace {

std::optional<SideKind> kind_of_word(std::string_view word) {
    const auto found = std::find(side_kind_words.begin(), side_kind_words.end(), word);
    if (found == side_kind_words.end()) return std::nullopt;
    return static_cast<SideKind>(found - side_kind_words.begin());
}

/// What is said of a side: its kind, and where its value stands.
struct WrittenSide {
    SideKind kind = SideKind::no_flux;
    std::optional<ast::Expression> value;
};

/// `periodic`, `noflux`, `fixed(e)` or `flux(e)`; nothing, with a message, for all else.
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
    // The parts of the only argument stand directly before the call.
    return WrittenSide{*kind,
                       ast::Expression{written.first, script.arguments[call->first_argument]}};
}

/// The sides that a word means; empty for a word that means none.
std::vector<Side> sides_of_word(std::string_view word) {
    std::vector<Side> sides;
    for (std::size_t side = 0; side < side_count; ++side) {
        if (word == side_names[side] || word == "sides") sides.push_back(static_cast<Side>(side));
    }
    return sides;
}

/// The statements with those of `sides` first, since one side alone says more than all.
std::vector<const ast::Statement*> in_order(std::span<const ast::Statement> statements) {
    std::vector<const ast::Statement*> ordered;
    for (const ast::Statement& statement : statements) ordered.push_back(&statement);
    std::stable_partition(ordered.begin(), ordered.end(), [](const ast::Statement* statement) {
        return statement->side.text == "sides";
    });
    return ordered;
}

/// What a statement sets, in messages: `u.left`.
Span head_of(const ast::Statement& statement) {
    return join(statement.name.span, statement.side.span);
}

/// t and step reach a side as numbers: what takes the values of many cells, or knows the place of
/// one, is computed when the stage starts.
bool is_known_along_side(Workspace& work, const Formula& value) {
    IdVector<NodeId, bool> changes;
    for (const Node& node : value.nodes) {
        bool is_changing = node.kind == NodeKind::builtin &&
                           (node.index == static_cast<std::uint32_t>(Builtin::t) ||
                            node.index == static_cast<std::uint32_t>(Builtin::step));
        if (node.kind == NodeKind::call) {
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

/// What to write in a rate in place of a flux that depends on a species: a source in the cells at
/// the side, as `lap` divides what flows through a face by the spacing.
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

/// Values of sides are found when the stage starts, and species change. False, with a message,
/// where one reads a species.
bool reads_no_species(Workspace& work, const System& system, const SideSetting& setting, Side side,
                      std::string_view of) {
    const auto& nodes = setting.value.nodes;
    const auto read = std::find_if(nodes.begin(), nodes.end(), [&](const Node& node) {
        return node.kind == NodeKind::own && system.is_species(node.index);
    });
    if (read == nodes.end()) return true;
    const std::string_view name = system.item_name(read->index);
    work.diagnostics.error(
        read->span, fmt::format("a side cannot follow '{}', which every step changes", name),
        setting.kind == SideKind::flux
            ? as_source(of, side)
            : fmt::format("a parameter keeps what {0} starts with: name: …; {0}: name", name));
    return false;
}

std::vector<std::string> species_names(const System& system) {
    std::vector<std::string> names;
    for (const Quantity& quantity : system.quantities) {
        if (quantity.is_species) names.push_back(quantity.name);
    }
    return names;
}

/// The rules that statements give, in an order in which later ones replace earlier ones.
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
        // u[2].left says more than u[i].left.
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
        bool is_of_all = false;     ///< `sides`, not one of them.
    };

    /// A second statement about the same is a fault.
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
        if (meaning != nullptr && meaning->is_faulty) return;
        if (meaning == nullptr || meaning->is_definition || !system_.is_species(meaning->index)) {
            if (is_incomplete(work_, scope_.system)) return;
            return report_no_species(declaration);
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
            if (!reads_no_species(work_, system_, setting, side, declaration.name)) return;
        }
        for (const Side side : sides_of_word(statement.side.text)) {
            rules_.push_back({{meaning->index, side, setting},
                              declaration.index.has_value(),
                              statement.side.text == "sides"});
        }
    }

    void report_no_species(const Declaration& declaration) {
        std::string hint;
        if (!is_hopeless(work_)) {
            if (auto family = explain_family(work_, system_, declaration.name)) {
                work_.diagnostics.error(head_of(*declaration.statement), std::move(family->message),
                                        std::move(family->hint));
                return;
            }
            hint = did_you_mean(work_, declaration.name, species_names(system_));
        }
        work_.diagnostics.error(
            head_of(*declaration.statement),
            fmt::format("'{}' is not a species of {}", declaration.name, system_.name), hint);
    }

    Workspace& work_;
    const ast::Script& script_;
    Scope scope_;
    const System& system_;
    std::vector<Rule> rules_;
    std::unordered_map<std::string, Span> seen_;
};

using AllSides = std::array<SideSetting, side_count>;

/// What holds where no species says otherwise.
AllSides sides_of_domain(const DomainSettings& domain) {
    AllSides sides;
    const SideRules boundary(domain.grid.boundary);
    for (std::size_t side = 0; side < side_count; ++side) {
        sides[side].kind = boundary.at[side].kind;
        if (domain.sides[side]) sides[side] = *domain.sides[side];
    }
    return sides;
}

/// The two sides of an axis are both periodic or neither is. False, with a message, where one is.
bool are_pairs(Workspace& work, const AllSides& sides) {
    for (std::size_t side = 0; side < side_count; side += 2) {
        const bool first = sides[side].kind == SideKind::periodic;
        const bool second = sides[side + 1].kind == SideKind::periodic;
        if (first == second) continue;
        const std::size_t other = first ? side + 1 : side;
        const std::size_t periodic = first ? side : side + 1;
        // The span is that of the rule which one of them was given.
        const Span span = sides[other].span.end > 0 ? sides[other].span : sides[periodic].span;
        work.diagnostics.error(
            span,
            fmt::format("{} is {}, but {} is periodic", side_names[other],
                        side_kind_words[static_cast<std::size_t>(sides[other].kind)],
                        side_names[periodic]),
            fmt::format("give {} a rule too, or write boundary: noflux in the domain",
                        side_names[span == sides[other].span ? periodic : other]));
        return false;
    }
    return true;
}

/// Which cell lies beyond a periodic side is the mask's matter too, and there is one for all
/// species. False, with a message, where a species is periodic and the domain is not, or the other
/// way round.
bool are_periodic_as_boundary(Workspace& work, const AllSides& sides) {
    const SideRules boundary(work.program.domain.grid.boundary);
    for (std::size_t side = 0; side < side_count; ++side) {
        const bool is_periodic = sides[side].kind == SideKind::periodic;
        if (is_periodic == (boundary.at[side].kind == SideKind::periodic)) continue;
        work.diagnostics.error(
            sides[side].span,
            fmt::format("in a domain with a mask {} is periodic for all species or for none",
                        side_names[side]),
            "the domain's boundary says which: boundary: periodic, noflux");
        return false;
    }
    return true;
}

/// Puts together what holds for each species of a stage.
void resolve(Workspace& work, Stage& stage, const std::vector<SpeciesSide>& own) {
    const System& system = work.program.systems[stage.system];
    const AllSides base = sides_of_domain(work.program.domain);
    const bool is_plain =
        own.empty() && system.sides.empty() &&
        std::none_of(work.program.domain.sides.begin(), work.program.domain.sides.end(),
                     [](const auto& side) { return side.has_value(); });
    if (is_plain) return;
    std::vector<std::size_t> number(system.quantities.size());  // Of the species, by item.
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        number[item] = stage.sides.size();
        if (system.is_species(item)) stage.sides.push_back(base);
    }
    for (const auto* rules : {&system.sides, &own}) {
        for (const SpeciesSide& rule : *rules) {
            stage.sides[number[rule.species]][static_cast<std::size_t>(rule.side)] = rule.setting;
        }
    }
    if (work.program.domain.model) {
        // Boundaries of a model have no flux through them.
        for (const AllSides& sides : stage.sides) {
            for (const SideSetting& side : sides) {
                if (!takes_value(side.kind)) continue;
                work.diagnostics.warning(side.span, "a model has no sides: this is left aside");
            }
        }
        return stage.sides.clear();
    }
    for (const AllSides& sides : stage.sides) {
        if (!are_pairs(work, sides)) return;
        if (work.program.domain.mask && !are_periodic_as_boundary(work, sides)) return;
    }
}

}  // namespace

bool is_side_word(std::string_view word) { return is_setting_of(SettingBlock::side, word); }

void check_system_sides(Workspace& work, const ast::Script& script, const ast::Block& block,
                        std::uint32_t index, std::optional<std::uint32_t> base) {
    if (index >= work.program.systems.size()) return;  // It could not be made.
    Scope scope;
    scope.system = index;
    System& system = work.draft->systems[index];
    if (base && *base < work.program.systems.size()) {
        const System& from = work.program.systems[*base];
        // Species keep their names, but not always their numbers.
        for (SpeciesSide side : from.sides) {
            const Meaning* meaning = find(work.names[index], from.item_name(side.species));
            if (meaning == nullptr || !system.is_species(meaning->index)) continue;
            side.species = meaning->index;
            for (Node& node : side.setting.value.nodes) {
                if (node.kind != NodeKind::own) continue;
                const Meaning* own = find(work.names[index], from.item_name(node.index));
                if (own != nullptr) node.index = own->index;
            }
            mark_reads(work, side.setting.value, index);
            system.sides.push_back(std::move(side));
        }
    }
    for (SpeciesSide& rule : RuleChecker(work, script, scope).check(block.sides)) {
        system.sides.push_back(std::move(rule));
    }
}

void check_domain_side(Workspace& work, const ast::Script& script,
                       const ast::Statement& statement) {
    const auto written = read_side(work, script, statement);
    if (!written) return;
    SideSetting setting{written->kind, {}, statement.span};
    if (written->value) {
        const auto value =
            check_constant(work, script, *written->value, "the value of a side of all species");
        Node node;
        node.number = value.value_or(0);  // A wrong one has its message; the side's kind holds.
        node.span = statement.span;
        setting.value = {{node}};
    }
    const bool is_for_all = statement.name.text == "sides";
    for (const Side side : sides_of_word(statement.name.text)) {
        auto& target = work.draft->domain.sides[static_cast<std::size_t>(side)];
        if (!is_for_all || !target) target = setting;
    }
}

void check_stage_sides(Workspace& work, const ast::Script& script) {
    AllSides domain = sides_of_domain(work.program.domain);
    if (!are_pairs(work, domain)) return;
    const SideOverrides overrides = distribute_side_overrides(work, script);
    std::uint32_t index = 0;
    for (const ast::Block& block : script.blocks) {
        const bool is_stage =
            block.kind == ast::BlockKind::stage || block.kind == ast::BlockKind::classic_stage;
        if (!is_stage) continue;
        Stage& stage = work.draft->stages[index];
        Scope scope;
        scope.system = stage.system;
        scope.stage = scope.last_stage = index;
        ++index;
        if (stage.system == unknown_system) continue;
        std::vector<SpeciesSide> rules = RuleChecker(work, script, scope).check(block.sides);
        // What comes from outside has the last word, and of that the last.
        for (const ast::Statement& change : overrides[index - 1]) {
            for (SpeciesSide& rule :
                 RuleChecker(work, script, scope).check(std::span(&change, 1))) {
                rules.push_back(std::move(rule));
            }
        }
        resolve(work, stage, rules);
    }
}

}  // namespace cascade::checking
