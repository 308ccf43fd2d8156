// Checks the parts that only blocks of cells have: the quantities that every cell has, vectors, and
// the rules of division and death.
#include "lang/calculus/algebra.h"
#include "lang/check/systems/cell_frame.h"
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/system_checker.h"
#include "lang/vocabulary/settings.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/program/cell_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade::checking {

namespace {

constexpr double usual_radius = 0.02;

Formula number(double value, Span span = {}) { return {{Node{value, span}}}; }

bool is_axis(std::string_view name) { return name == "ey" || name == "ez"; }

/// The formula vector(0, 0, 0).
Formula zero_vector(Span span) {
    Node call{Call(), span, ValueType::vector, Function::vector, 3};
    call.operands = {NodeId(0), NodeId(1), NodeId(2)};
    return {{Node{0.0, span}, Node{0.0, span}, Node{0.0, span}, call}};
}

/// The formula component(definition, k).
Formula component(DefinitionId vector, std::size_t k) {
    Node of_vector{vector};
    of_vector.type = ValueType::vector;
    Node call{Call()};
    call.function = Function::component;
    call.operands = {NodeId(0), NodeId(1)};
    call.operand_count = 2;
    return {{of_vector, Node{static_cast<double>(k)}, call}};
}

bool is_same(const Formula& a, const Formula& b) {
    return std::ranges::equal(a.nodes, b.nodes, [](const Node& one, const Node& other) {
        return one.is(other.kind) && one.function == other.function && one.type == other.type &&
               std::ranges::equal(one.reads(), other.reads());
    });
}

}  // namespace

/// Adds the quantities that every cell has, before the system's own quantities.
void SystemChecker::add_cell_quantities() {
    CellRules& rules = *system().cells;
    const auto add = [&](const char* name) {
        Quantity quantity;
        quantity.name = name;
        quantity.span = system().span;
        quantity.is_species = true;
        quantity.start = number(0, quantity.span);
        system().quantities.push_back(std::move(quantity));
        values_.push_back(nullptr);
        return ItemId(system().quantities.size() - 1);
    };
    rules.place = add("p.x");
    add("p.y");
    add("p.z");
    rules.frame = add("frame.w");
    for (const char* name : {"frame.x", "frame.y", "frame.z"}) add(name);
    rules.radius = add("r");
    system().quantities.back().start = number(usual_radius, system().span);
    rules.age = add("age");
    const auto define = [&](const char* name) {
        system().definitions.push_back({name, system().span, {}});
        definitions_.push_back(nullptr);
        return DefinitionId(system().definitions.size() - 1);
    };
    rules.velocity = define("p'");
    rules.spin = define("turn'");
}

/// If a declaration has a meaning only for cells, handles it and returns true.
bool SystemChecker::declare_of_cells(const Declaration& declaration) {
    if (declaration.kind() != ast::StatementKind::value) return false;
    const std::string& name = declaration.name;
    const bool is_plain = declaration.statement->index.empty();
    if (is_plain && (is_setting_of(SettingBlock::cells, name) || is_axis(name))) {
        if (declaration.is_restart()) {
            work_.diagnostics.error(declaration.statement->after.span,
                                    fmt::format("'{}' cannot be set after a division", name));
        }
        const auto [first, is_new] = rules_.try_emplace(name, &declaration);
        if (!is_new) {
            report_twice(work_, declaration.span(), first->second->span(),
                         fmt::format("'{}' is given a value twice", name));
        }
        return true;
    }
    if (declaration.is_restart()) {
        const auto is_start = [&](const Declaration& each) {
            return each.kind() == ast::StatementKind::value && !each.is_restart() &&
                   each.name == name;
        };
        const auto [first, is_new] =
            declared_.try_emplace(name + " after divide", declaration.span());
        if (!is_new) {
            report_twice(work_, declaration.span(), first->second,
                         fmt::format("'{}' is set twice after a division", name));
            return true;
        }
        restarts_.push_back(&declaration);
        if (std::ranges::any_of(declarations_, is_start)) return true;
    }
    if (name != "r" && name != "age") return false;
    if (!can_declare(declaration)) return true;
    const CellRules& rules = *system().cells;
    const ItemId item = name == "r" ? rules.radius : rules.age;
    values_[item] = &declaration;
    system().quantities[item].span = declaration.span();
    system().quantities[item].doc = declaration.doc;
    return true;
}

/// Whether the name can be declared. Reports names that every cell already has.
bool SystemChecker::can_declare_in_cells(const Declaration& declaration) {
    const std::string_view name = declaration.statement->name.text;
    if (name == "p") {
        work_.diagnostics.error(declaration.span(), "the positions of cells cannot be set by 'p'",
                                "write founders: keys(x, y, z) in a stage for the positions at "
                                "the start");
        return false;
    }
    const bool is_own = name == "r" || name == "age";
    const bool is_value = declaration.kind() == ast::StatementKind::value;
    if (is_own && is_value && declaration.statement->index.empty()) return true;
    if (!is_own && name != "turn" && !cell_value_named(name)) return true;
    work_.diagnostics.error(declaration.span(),
                            fmt::format("'{}' is built in and cannot be declared", name),
                            name == "ex" ? "set ey and ez, the directions of a cell's axes at "
                                           "the start"
                                         : "");
    return false;
}

/// If the declaration gives the rate of the position, the frame or the age, handles it and returns
/// true.
bool SystemChecker::collect_rate_of_cells(const Declaration& declaration) {
    const std::string& name = declaration.name;
    if (name == "p" || name == "turn") {
        add_statement_of_rate(name == "p" ? velocity_ : spin_, declaration);
        return true;
    }
    if (name == "age") {
        work_.diagnostics.error(declaration.span(),
                                "'age' cannot have another rate, because it "
                                "grows at the rate 1",
                                "choose another name for the quantity with this rate");
        return true;
    }
    if (!cell_value_named(name)) return false;
    work_.diagnostics.error(declaration.span(), fmt::format("'{}' has no rate", name),
                            name.starts_with("e") ? "write turn' += … to turn the axes of a cell"
                                                  : "");
    return true;
}

void SystemChecker::check_rates_of_cells() {
    System& target = system();
    const CellRules& rules = *target.cells;
    const auto define = [&](DefinitionId id, const RateStatements& rate) {
        Formula sum = sum_of(rate, ValueType::vector);
        work_.definitions_read[index_][id] = true;
        const bool is_empty = sum.nodes.empty();
        target.definitions[id].formula = is_empty ? zero_vector(target.span) : std::move(sum);
        return !is_empty;
    };
    const bool moves = define(rules.velocity, velocity_);
    for (std::uint32_t k = 0; k < 3; ++k) {
        target.rates[ItemId(rules.place.index() + k)] =
            moves ? component(rules.velocity, k) : number(0, target.span);
    }
    const bool turns = define(rules.spin, spin_);
    const auto turned = rates_of_frame(rules.frame, rules.spin);
    for (std::uint32_t k = 0; k < 4; ++k) {
        target.rates[ItemId(rules.frame.index() + k)] = turns ? turned[k] : number(0, target.span);
    }
    if (target.rates[rules.radius].nodes.empty()) {
        target.rates[rules.radius] = number(0, target.span);
    }
    target.rates[rules.age] = number(1, target.span);
}

/// Checks a rule (divide, die, along, ey or ez) if the block contains the rule.
void SystemChecker::check_rule(std::string_view name, Formula& rule, Context context,
                               ValueType type, bool may_draw) {
    const auto found = rules_.find(name);
    if (found == rules_.end()) return;
    auto checked = check_value(*found->second, context, type);
    if (!checked) return;
    rule = std::move(checked->formula);
    const auto draw = std::ranges::find_if(rule.nodes, is_draw);
    if (may_draw || draw == rule.nodes.end()) return;
    work_.diagnostics.error(draw->span, fmt::format("'{}' cannot contain random numbers", name),
                            name == "along"
                                ? "leave 'along' out: the direction of divisions is then random"
                                : "draw the number in a parameter, as in limit: random(1, 0.1) "
                                  "after divide");
}

/// Checks division, death, and values that restart after a division. Must be called last, because
/// these rules may read all other names.
void SystemChecker::check_rules_of_cells() {
    const std::size_t errors_before = work_.diagnostics.error_count();
    CellRules& rules = *system().cells;
    check_rule("divide", rules.divide, Context::rate, ValueType::number, false);
    check_rule("die", rules.die, Context::rate, ValueType::number, false);
    check_rule("along", rules.along, Context::rate, ValueType::vector, false);
    check_rule("ey", rules.ey, Context::value, ValueType::vector, true);
    check_rule("ez", rules.ez, Context::value, ValueType::vector, true);
    rules.restarts.resize(system().quantities.size());
    rules.restarts[rules.age] = number(0, system().span);
    for (const Declaration* restart : restarts_) {
        const Meaning* meaning = find(work_.names[index_], restart->name);
        if (meaning == nullptr || meaning->has_error || meaning->is_definition()) continue;
        auto checked = check_value(*restart, Context::rate);
        if (checked) rules.restarts[meaning->item()] = std::move(checked->formula);
    }
    if (const auto reach = rules_.find("reach"); reach != rules_.end()) {
        const Declaration& from = *reach->second;
        put(rules.reach, read_number(work_, *from.script, *from.statement));
    }
    const auto frame = starting_frame(rules.ey, rules.ez);
    for (std::uint32_t k = 0; k < 4; ++k) {
        system().quantities[ItemId(rules.frame.index() + k)].start = frame[k];
    }
    const bool is_sound = work_.diagnostics.error_count() == errors_before;
    if (!is_sound || !system().is_complete() || work_.diagnostics.has_errors()) return;
    for (Formula* rule : {&rules.divide, &rules.die, &rules.along}) {
        if (!rule->nodes.empty()) *rule = without_definitions(system(), *rule);
    }
    for (Formula& restart : rules.restarts) {
        if (!restart.nodes.empty()) restart = without_definitions(system(), restart);
    }
    find_near();
}

/// Collects the distances of `over near(d)`.
void SystemChecker::find_near() {
    std::vector<Formula> near;
    const auto collect = [&](const Formula& formula) {
        for (const Formula& distance : near_distances(formula)) {
            Formula found = without_definitions(system(), distance);
            const auto is_found = [&](const Formula& each) { return is_same(each, found); };
            if (std::ranges::none_of(near, is_found)) near.push_back(std::move(found));
        }
    };
    for (const Definition& definition : system().definitions) collect(definition.formula);
    for (const Formula& rate : system().rates) collect(rate);
    for (const Formula* rule : rules_of(system())) collect(*rule);
    const Settings& settings = system().settings;
    if (settings.show) collect(*settings.show);
    if (settings.time.until) collect(*settings.time.until);
    system().cells->near = std::move(near);
}

}  // namespace cascade::checking
