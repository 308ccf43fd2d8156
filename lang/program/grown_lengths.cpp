// Gives each stage whose domain grows its own copy of its system, and writes the growth into the
// formulas.
#include "lang/program/grown_lengths.h"

#include "lang/program/evaluate.h"
#include "lang/program/growing_formula.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {

namespace {

/// The same growth, but with every length fixed at its value at t = 0.
Growth at_start(Growth growth) {
    for (Formula& scale : growth.scale) {
        scale = {{Node{evaluate(scale, BuiltinValues{})}}};
        double& value = std::get<double>(scale.nodes.back().kind);
        if (std::abs(value - 1) < 1e-9) value = 1;
    }
    return growth;
}

class GrowingStage {
public:
    GrowingStage(Program& program, std::uint32_t stage)
        : program_(program),
          stage_(program.stages[stage]),
          growth_(*stage_.growth),
          system_(program.systems[stage_.system]) {}

    void run() {
        stage_.growth->written = stage_.system;
        for (Definition& each : system_.definitions) each.formula = grown(each.formula);
        for (Formula& rate : system_.rates) {
            if (!rate.nodes.empty()) rate = grown(rate);
        }
        dilute();
        const Growth first = at_start(growth_);
        for (Formula& item : stage_.items)
            item = GrowingFormula(first, program_.domain).rewritten(item);
        stage_.show = grown(stage_.show);
        if (stage_.time.until) stage_.time.until = grown(*stage_.time.until);
        for (SideSettings& sides : stage_.sides) grow_sides(sides);
        for (DefinitionSides& each : stage_.definition_sides) grow_sides(each.sides);
        stage_.system = program_.systems.next();
        program_.systems.push_back(std::move(system_));
    }

private:
    Formula grown(const Formula& formula) const {
        return GrowingFormula(growth_, program_.domain).rewritten(formula);
    }

    void dilute() {
        if (growth_.dilution.nodes.back().is(NodeKind(0.0))) return;
        for (const ItemId item : system_.species()) {
            if (std::ranges::find(stage_.undiluted, item) != stage_.undiluted.end()) continue;
            Formula& rate = system_.rates[item];
            keep_rate(item);
            rate = GrowingFormula(growth_, program_.domain).diluted(rate, item);
        }
    }

    /// If a formula reads the rate of a species, makes the undiluted rate a definition. That
    /// formula and the new, diluted rate then read this definition. The definition has the name of
    /// a rate, so that it draws the same random numbers.
    void keep_rate(ItemId species) {
        const NodeKind rate = Rate{species};
        const auto reads = [&](const Formula& formula) {
            return std::ranges::any_of(formula.nodes,
                                       [&](const Node& node) { return node.is(rate); });
        };
        if (std::ranges::none_of(system_.rates, reads) &&
            std::ranges::none_of(system_.definitions, reads, &Definition::formula)) {
            return;
        }
        const DefinitionId id = system_.definitions.next();
        const Quantity& quantity = system_.quantities[species];
        const Span span = quantity.span;
        system_.definitions.push_back(
            {quantity.name + "'", span, std::exchange(system_.rates[species], {{Node{id, span}}})});
        const auto replace = [&](Formula& formula) {
            for (Node& node : formula.nodes) {
                if (node.is(rate)) node.kind = id;
            }
        };
        for (Formula& each : system_.rates) replace(each);
        for (Definition& each : system_.definitions) replace(each.formula);
    }

    /// The first axis with more than one cell.
    std::size_t main_axis() const { return program_.domain.grid.width > 1 ? 0 : 1; }

    void grow_sides(SideSettings& sides) const {
        for (std::size_t side = 0; side < wall_count; ++side) {
            SideSetting& setting = sides[side];
            if (!takes_value(setting.kind)) continue;
            setting.value = grown(setting.value);
            if (setting.kind == SideKind::fixed) continue;
            // The border of a mask has no axis. So slopes and fluxes at this border are refused if
            // axes grow differently, and the main axis stands for all axes here.
            const std::size_t axis = side < side_count ? side / 2 : main_axis();
            const bool is_slope = setting.kind == SideKind::slope;
            setting.value =
                GrowingFormula(growth_, program_.domain)
                    .at_side(setting.value, axis, is_slope ? Function::multiply : Function::divide);
        }
    }

    Program& program_;
    Stage& stage_;
    Growth growth_;
    System system_;
};

}  // namespace

void let_lengths_grow(Program& program) {
    for (std::uint32_t stage = 0; stage < program.stages.size(); ++stage) {
        if (program.stages[stage].growth) GrowingStage(program, stage).run();
    }
}

Formula with_growth(const Program& program, std::uint32_t stage, const Formula& formula) {
    const auto& growth = program.stages[stage].growth;
    return growth ? GrowingFormula(*growth, program.domain).rewritten(formula) : formula;
}

std::vector<GrowingSide> growing_sides(const DomainSettings& domain) {
    const auto longest = [](const auto& surface) {
        return std::vector{
            GrowingSide{0, "the length of the longest side", surface.extent.value_or(0)}};
    };
    if (domain.model) return longest(*domain.model);
    if (domain.surface) return longest(*domain.surface);
    constexpr std::array names{"the length along x", "the length along y", "the length along z"};
    const std::array cells{domain.grid.width, domain.grid.height, domain.grid.depth};
    std::vector<GrowingSide> sides;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (cells[axis] == 1) continue;
        const double length = static_cast<double>(cells[axis]) * domain.grid.spacing;
        sides.push_back({axis, names[axis], length});
    }
    return sides;
}

std::optional<double> known_duration(const Program& program, std::uint32_t stage) {
    const Stage& its = program.stages[stage];
    if (its.time.duration) return *its.time.duration;
    if (its.time.automatic_speed || its.time.open_end) return std::nullopt;
    const Formula& speed = its.items[program.system_of(stage).speed_item()];
    const auto* const step = speed.nodes.back().as<double>();
    if (step == nullptr) return std::nullopt;
    return *step * static_cast<double>(its.time.duration_in_steps.value_or(its.iterations));
}

std::array<double, 3> scales_at(const Stage& stage, double t) {
    std::array<double, 3> scales{1, 1, 1};
    if (!stage.growth) return scales;
    BuiltinValues moment{};
    moment[static_cast<std::size_t>(Builtin::t)] = t;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        scales[axis] = evaluate(stage.growth->scale[axis], moment);
    }
    return scales;
}

}  // namespace cascade
