// Checks stages: their statements, defaults, the order of their items, and the uniform items.
#include "lang/check/blocks/cell_stages.h"
#include "lang/check/blocks/check_blocks.h"
#include "lang/check/blocks/check_growth.h"
#include "lang/check/systems/check_systems.h"
#include "lang/check/systems/check_coarse.h"
#include "lang/check/expressions/check_convolution.h"
#include "lang/check/systems/check_cycles.h"
#include "lang/check/expressions/check_expression.h"
#include "lang/check/systems/check_time.h"
#include "lang/check/names/note_uses.h"
#include "lang/check/names/unknown_names.h"
#include "lang/check/expressions/read_setting.h"
#include "lang/check/expressions/setting_words.h"
#include "lang/program/dependencies.h"
#include "lang/vocabulary/settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade::checking {

namespace {

/// The largest total number of nodes in defaults. Defaults are copied into every stage, so this
/// limits the memory that a check needs.
constexpr std::size_t most_copied_nodes = 8u << 20;

class StageChecker {
public:
    StageChecker(Workspace& work, const ast::Script& script, std::uint32_t index,
                 std::size_t& copied)
        : work_(work), script_(script), index_(index), copied_(copied) {}

    /// `overrides` come from outside the script. If several overrides set the same name, the last
    /// one applies. `asked` contains the options that set the time of every stage.
    void run(const ast::Block& block, const std::vector<const ast::Statement*>& overrides,
             const TimeSettings& asked);

private:
    Stage& stage() { return work_.draft->stages[index_]; }
    const System& system() const {
        return work_.program.systems[work_.program.stages[index_].system];
    }
    Scope scope() const {
        Scope result;
        result.system = work_.program.stages[index_].system;
        result.stage = index_;
        result.last_stage = index_;
        return result;
    }
    std::vector<Declaration> collect(const ast::Block& block,
                                     const std::vector<const ast::Statement*>& overrides);
    std::vector<Declaration> declarations_of(const ast::Statement& statement);
    void set(const Declaration& declaration);
    bool set_of_cells(const Declaration& declaration);
    void set_of_fields(const ast::Statement& statement);
    void report_unknown(const Declaration& declaration);
    void fill_defaults();
    void take_default(ItemId item, const Formula* formula, double otherwise);
    void order_items();
    void find_uniform();

    Workspace& work_;
    const ast::Script& script_;
    std::uint32_t index_;
    std::size_t& copied_;
    Settings settings_;
    IdVector<ItemId, bool> from_system_;
    std::array<Formula, 2> axes_;  ///< ey and ez at the start, for crawling cells.
};

/// The declarations of a statement: only one if the system, and so its families, are unknown.
std::vector<Declaration> StageChecker::declarations_of(const ast::Statement& statement) {
    if (stage().system != unknown_system) {
        return stage_declarations(work_, system(), script_, statement);
    }
    Declaration declaration;
    declaration.script = &script_;
    declaration.statement = &statement;
    declaration.name = fmt::format("{}[{}]", statement.name.text, statement.index.text);
    return {std::move(declaration)};
}

std::vector<Declaration> StageChecker::collect(
    const ast::Block& block, const std::vector<const ast::Statement*>& overrides) {
    std::vector<Declaration> declarations;
    std::unordered_map<std::string, std::size_t> positions;
    const auto add = [&](Declaration declaration, bool from_outside) {
        const auto [first, is_new] = positions.try_emplace(declaration.name, declarations.size());
        if (is_new) return declarations.push_back(std::move(declaration));
        Declaration& before = declarations[first->second];
        // u[2]: … replaces u[i]: …. An override from outside the script replaces any earlier
        // declaration.
        const bool replaces = from_outside || before.indices.size() > declaration.indices.size();
        const bool is_replaced =
            !from_outside && before.indices.size() < declaration.indices.size();
        if (!replaces && !is_replaced) {
            report_twice(work_, declaration.span(), before.span(),
                         fmt::format("'{}' is given a value twice", declaration.name));
        }
        if (replaces) before = std::move(declaration);
    };
    for (const ast::Statement& statement : block.statements) {
        if (statement.name.empty()) continue;
        const ast::Statement* value = value_statement(statement);
        if (value == nullptr) {
            if (statement.kind == ast::StatementKind::value) continue;
            work_.diagnostics.error(statement.span, "only values (name: …) belong in a stage",
                                    statement.kind == ast::StatementKind::definition
                                        ? fmt::format("write {}: …", statement.name.text)
                                        : "rates, definitions and bounds belong in a system");
            continue;
        }
        if (statement.range) {
            work_.diagnostics.error(statement.range->span,
                                    "the range of a parameter must be written in its system, not "
                                    "in a stage");
        }
        for (Declaration& declaration : declarations_of(*value)) add(std::move(declaration), false);
    }
    for (const ast::Statement* statement : overrides) {
        for (Declaration& declaration : declarations_of(*statement))
            add(std::move(declaration), true);
    }
    return declarations;
}

void StageChecker::run(const ast::Block& block, const std::vector<const ast::Statement*>& overrides,
                       const TimeSettings& asked) {
    const std::vector<Declaration> declarations = collect(block, overrides);
    if (stage().system == unknown_system) return;
    stage().items.resize(system().item_count());
    from_system_.assign(system().item_count(), false);
    // An end from outside the script, which may be `iterations` or `duration`, replaces the
    // script's end.
    const SourceId own_source = stage().span.source;
    const auto is_end = [&](const Declaration& declaration, bool from_outside) {
        return is_end_setting(declaration.name) &&
               (declaration.span().source != own_source) == from_outside;
    };
    const bool has_new_end = std::any_of(declarations.begin(), declarations.end(),
                                         [&](const auto& each) { return is_end(each, true); });
    // Founders are set first, because they determine which names other values may read.
    for (const bool is_first : {true, false}) {
        for (const Declaration& declaration : declarations) {
            if ((declaration.name == "founders") != is_first) continue;
            if (!has_new_end || !is_end(declaration, false)) set(declaration);
        }
    }
    for (const Formula& formula : stage().items) mark_reads(work_, formula, stage().system);
    for (const auto* formula : {&settings_.show, &settings_.time.until}) {
        if (*formula) mark_reads(work_, **formula, stage().system);
    }
    fill_defaults();
    order_items();
    find_uniform();
    check_kernels_of_stage(work_, index_);
    if (asked.solver && system().cells) {
        change_cell_solver(work_, index_, asked);
    } else if (asked.solver) {
        change_solver(stage(), asked);
    }
    check_time(work_, index_);
    if (system().cells) check_cell_stage(work_, index_);
}

/// If the declaration has a meaning only in stages of cells, applies it and returns true.
bool StageChecker::set_of_cells(const Declaration& declaration) {
    const std::string_view name = declaration.name;
    const ast::Statement& statement = *declaration.statement;
    if (is_setting_of(SettingBlock::cell_stage, name)) {
        check_cell_setting(work_, script_, statement, scope());
        return true;
    }
    if (name == "p") {
        work_.diagnostics.error(declaration.span(), "the positions of cells cannot be set by 'p'",
                                "write founders: keys(x, y, z) for the positions at the start");
        return true;
    }
    if (name != "ey" && name != "ez") return false;
    if (!has_one_value(work_, script_, statement)) return true;
    auto checked = check_vector(work_, script_, statement.values[0], scope());
    if (checked) axes_[name == "ey" ? 0 : 1] = std::move(checked->formula);
    return true;
}

/// Applies a setting of stages of fields. Stages of cells have one of these settings, `size`, too.
void StageChecker::set_of_fields(const ast::Statement& statement) {
    if (statement.name.text == "size") {
        const auto wanted = read_number(work_, script_, statement);
        if (wanted && system().cells) stage().cell_size = *wanted;
        else if (wanted) stage().size = StageSize{*wanted, value_of(script_, statement).span};
        return;
    }
    if (statement.values.empty()) return;
    if (statement.name.text == "extent")
        return check_stage_extent(work_, script_, statement, stage());
    const auto coarse =
        check_coarse(work_, script_, statement.values[0], "grid",
                     "'grid' of a stage takes coarse(N), for cells N times as wide");
    if (!coarse || !has_one_value(work_, script_, statement)) return;
    stage().coarse = coarse->times;
    stage().coarse_span = coarse->span;
}

void StageChecker::set(const Declaration& declaration) {
    const ast::Statement& statement = *declaration.statement;
    const std::string_view name = declaration.name;
    if (system().cells && set_of_cells(declaration)) return;
    const Reserved kind = reserved(name);
    if (kind == Reserved::setting) {
        check_setting(work_, script_, statement, scope(), settings_);
        return;
    }
    const Meaning* meaning = find(work_.names[stage().system], name);
    const bool is_of_fields = is_setting_of(SettingBlock::field_stage, name);
    if (meaning == nullptr && is_of_fields && (!system().cells || name == "size")) {
        return set_of_fields(statement);
    }
    if (meaning == nullptr) return report_unknown(declaration);
    if (meaning->has_error) return;
    note_use(work_, statement.name.span, stage().system, meaning->id);
    if (meaning->is_definition()) {
        work_.diagnostics.error(statement.name.span,
                                fmt::format("'{}' cannot be set in a stage, because it is a "
                                            "definition of {}",
                                            name, system().name));
        return;
    }
    if (!has_one_value(work_, declaration)) return;
    Scope own = scope();
    own.indices = declaration.indices;
    auto checked = check_number(work_, script_, declaration.value(), own);
    if (!checked) return;
    const ItemId item = meaning->item();
    if (item < system().frozen_item()) {
        warn_outside(work_, system().quantities[item], checked->constant,
                     script_.expressions[declaration.value().root].span);
    }
    stage().items[item] = std::move(checked->formula);
}

void StageChecker::report_unknown(const Declaration& declaration) {
    if (auto explained = explain_family(work_, system(), declaration.name))
        return work_.diagnostics.error(declaration.span(), std::move(explained->message),
                                       std::move(explained->hint));
    if (is_incomplete(work_, stage().system)) return;
    Diagnostic diagnostic{
        Severity::error, declaration.span(), not_a_parameter(declaration.name, system()), {}, {}};
    if (!is_hopeless(work_)) {
        std::vector<std::string> names = quantity_names(system());
        diagnostic.notes.push_back(
            {std::nullopt, fmt::format("{} has {}", system().name, list_names(names))});
        const SettingBlock own =
            system().cells ? SettingBlock::cell_stage : SettingBlock::field_stage;
        for (std::string& each : settings_of({SettingBlock::stage, own}))
            names.push_back(std::move(each));
        if (system().cells) names.insert(names.end(), {"ey", "ez"});
        diagnostic.hint =
            with_number(hint_about(work_, declaration.name, WordContext::stage, names),
                        script_.expressions[declaration.value().root]);
        if (is_side_word(declaration.name)) {
            diagnostic.hint = fmt::format(
                "write SPECIES.{0}: … for one species, or {0}: … in the domain for "
                "all species",
                declaration.name);
        }
    }
    work_.diagnostics.add(std::move(diagnostic));
}

void StageChecker::take_default(ItemId item, const Formula* formula, double otherwise) {
    Formula& target = stage().items[item];
    if (!target.nodes.empty()) return;
    from_system_[item] = true;
    if (formula == nullptr || formula->nodes.empty()) {
        target = {{Node{otherwise, stage().span}}};
        return;
    }
    copied_ += formula->nodes.size();
    if (copied_ > most_copied_nodes) {
        work_.diagnostics.error(stage().span, "the stages of this script are too large in total");
        target = {{Node{otherwise, stage().span}}};
        return;
    }
    target = *formula;
}

void StageChecker::fill_defaults() {
    const System& from = system();
    const Settings& defaults = from.settings;
    const auto pick = [](const std::optional<Formula>& own, const std::optional<Formula>& other) {
        return own ? &*own : other ? &*other : nullptr;
    };
    if (settings_.frozen) stage().items[from.frozen_item()] = std::move(*settings_.frozen);
    if (settings_.speed) stage().items[from.speed_item()] = std::move(*settings_.speed);
    mark_reads(work_, stage().items[from.frozen_item()], stage().system);
    mark_reads(work_, stage().items[from.speed_item()], stage().system);
    if (from.cells) take_cell_size(work_, index_);
    if (from.cells) take_cells(work_, index_, std::move(axes_));
    for (const ItemId item : from.quantities.ids()) {
        take_default(item, &from.quantities[item].start, 0);
    }
    take_default(from.frozen_item(), pick(defaults.frozen, std::nullopt), 0);
    take_default(from.speed_item(), pick(defaults.speed, std::nullopt), 1);

    Stage& target = stage();
    if (!from.cells) fill_growth(target, work_.program.domain, settings_, defaults);
    if (from.cells) {
        fill_cell_time(work_, index_, settings_, defaults);
    } else {
        fill_time(target, settings_, defaults);
    }
    if (const Formula* show = pick(settings_.show, defaults.show)) {
        target.show = *show;
        return;
    }
    const auto species = from.species();
    ItemId shown = species.empty() ? ItemId() : species.front();
    if (from.cells) shown = from.cells->radius;
    target.show = {{Node{shown, target.span}}};
}

void StageChecker::order_items() {
    std::vector<const Formula*> items;
    for (const Formula& formula : stage().items) items.push_back(&formula);
    Order order = topological_order(item_dependencies(items));
    for (const auto& cycle : order.cycles) {
        // If all values in the cycle are defaults, the cycle has been reported with the system.
        const bool is_default = std::all_of(cycle.begin(), cycle.end(),
                                            [&](auto item) { return from_system_[ItemId(item)]; });
        if (!is_default) report_item_cycle(work_, system(), items, from_system_, cycle);
    }
    for (const std::uint32_t item : order.order) stage().order.emplace_back(item);
}

/// Finds the uniform items, which are those that read nothing that varies by cell. An aggregate
/// over the domain is a single number, even if its operand varies.
void StageChecker::find_uniform() {
    Stage& target = stage();
    target.uniform.assign(target.items.size(), false);
    IdVector<ItemId, std::uint32_t> depths(target.items.size());
    IdVector<NodeId, bool> varies;
    for (const ItemId item : target.order) {
        varies.clear();
        for (const Node& node : target.items[item].nodes) {
            bool operand_varies = false;
            for (const NodeId operand : node.reads()) operand_varies |= varies[operand];
            varies.push_back(differs_by_cell(node, operand_varies, work_.program, index_));
        }
        // A value that restarts after a division differs between cells.
        const auto& cells = system().cells;
        const bool starts_again =
            cells && item < cells->restarts.next() && !cells->restarts[item].nodes.empty();
        target.uniform[item] =
            !system().is_species(item) && !starts_again && (varies.empty() || !varies.back());
        depths[item] = check_nesting(work_, target.items[item], [&](const Node& node) {
            const auto* own = node.as<ItemId>();
            return own != nullptr ? depths[*own] : 0;
        });
    }
}

}  // namespace

void check_stages(Workspace& work, const ast::Script& script) {
    const std::vector<const ast::Block*> blocks = stage_blocks(script);
    find_systems_of_stages(work, script, true);
    const StageOverrides overrides = distribute_overrides(work, script);
    const ast::Statement* const steps = find_option(script, "steps");
    const double most_steps =
        steps != nullptr ? check_constant(work, script, steps->values[0], "steps").value_or(0)
                         : static_cast<double>(most_iterations);
    Settings asked;
    if (const auto* solver = find_option(script, "solver")) {
        check_time_setting(work, script, *solver, {}, asked);
    }
    std::size_t copied = 0;
    for (std::uint32_t i = 0; i < blocks.size(); ++i) {
        StageChecker(work, script, i, copied).run(*blocks[i], overrides[i], asked.time);
        Stage& stage = work.draft->stages[i];
        if (stage.size) stage.size->steps = stage.iterations;
        if (static_cast<double>(stage.iterations) > most_steps) {
            stage.iterations = static_cast<std::int64_t>(most_steps);
        }
    }
}

}  // namespace cascade::checking
