// Marks nodes from the leaves upwards. Then takes the largest subexpressions that depend only on
// time and positions.
#include "lang/calculus/time_parts.h"

#include "lang/calculus/algebra.h"

#include <algorithm>

namespace cascade {

namespace {

/// Facts about a subexpression of a formula.
struct TimeFacts {
    bool is_of_time = false;  ///< Whether the subexpression reads only constants and `t`.
    /// Whether the subexpression reads only constants, `t` and positions.
    bool is_of_places = false;
    bool reads_time = false;    ///< Whether the subexpression reads `t`.
    bool reads_places = false;  ///< Whether the subexpression reads positions.
    /// Whether the subexpression consists of sums and products of parts that read either `t` or
    /// positions but not both.
    bool is_separable = true;

    bool reads_both() const { return reads_time && reads_places; }
};

/// Whether the node is a sum, product or quotient that is separable if its operands are. In a
/// product, at most one factor may read both `t` and positions. In a quotient, the divisor may not
/// read both.
bool keeps_apart(const Node& node, const IdVector<NodeId, TimeFacts>& before) {
    const auto reads_both = [&](std::size_t operand) {
        return before[node.reads()[operand]].reads_both();
    };
    const FunctionInfo& row = info(node.function);
    if (row.kind != FunctionKind::arithmetic) return false;
    const std::size_t last = node.operand_count - 1u;
    switch (row.linear) {
        case Linear::each: return last == 0 || !reads_both(0) || !reads_both(last);
        case Linear::first: return !reads_both(last);
        default: return true;
    }
}

TimeFacts facts_of_leaf(const Node& node, const Program& program, std::uint32_t stage) {
    if (node.type != ValueType::number) return {};
    const bool differs = differs_by_cell(node, false, program, stage);
    if (node.is(Builtin::t)) return {!differs, !differs, true, false, true};
    if (node.is<Builtin>()) return {false, !node.is(Builtin::step), false, true, true};
    const auto* const item = node.as<ItemId>();
    const bool is_kept = node.is<double>() || node.is<StageItem>() ||
                         (item != nullptr && !program.system_of(stage).is_species(*item));
    return {is_kept && !differs, is_kept, false, differs, true};
}

TimeFacts time_facts_of(const Node& node, const IdVector<NodeId, TimeFacts>& before,
                        const Program& program, std::uint32_t stage) {
    if (!node.is<Call>()) return facts_of_leaf(node, program, stage);
    const Function function = node.function;
    const bool is_shape = info(function).kind == FunctionKind::shape;
    const bool is_number = node.type == ValueType::number;
    TimeFacts facts{is_number && !info(function).is_aggregate && !is_random(function) &&
                        !varies_by_cell(function) && !differentiates(function),
                    is_number && (is_elementary(function) || is_shape), false, is_shape, true};
    bool is_apart = true;
    for (const NodeId operand : node.reads()) {
        const TimeFacts& of = before[operand];
        facts.is_of_time = facts.is_of_time && of.is_of_time;
        facts.is_of_places = facts.is_of_places && of.is_of_places;
        facts.reads_time = facts.reads_time || of.reads_time;
        facts.reads_places = facts.reads_places || of.reads_places;
        is_apart = is_apart && of.is_separable;
    }
    facts.is_separable = !facts.reads_both() || (is_apart && keeps_apart(node, before));
    return facts;
}

/// The parts that were found, without duplicates.
class Found {
public:
    void add(NodeId id) {
        if (std::find(ids_.begin(), ids_.end(), id) == ids_.end()) ids_.push_back(id);
    }
    std::vector<Formula> formulas(const Algebra& algebra) const {
        std::vector<Formula> formulas;
        for (const NodeId id : ids_) formulas.push_back(algebra.formula(id));
        return formulas;
    }

private:
    std::vector<NodeId> ids_;
};

}  // namespace

TimeParts parts_of_time(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    FlatRates rates(system, FieldSpace::of(program, system));
    std::vector<NodeId> roots;
    for (const ItemId item : system.species()) roots.push_back(rates.rate(item));
    const auto add_sides = [&](const SideSettings& sides) {
        for (const SideSetting& side : sides) {
            if (!side.value.nodes.empty()) roots.push_back(rates.flattening.add(side.value));
        }
    };
    for (const SideSettings& sides : program.stages[stage].sides) add_sides(sides);
    for (const DefinitionSides& each : program.stages[stage].definition_sides)
        add_sides(each.sides);

    IdVector<NodeId, TimeFacts> facts;
    Found of_time, of_places;
    const auto note = [&](NodeId id, bool is_within_time, bool is_within_places) {
        const TimeFacts& of = facts[id];
        if (!of.reads_time) return;
        if (of.is_of_time && !is_within_time) of_time.add(id);
        if (of.is_of_places && !of.is_separable && !is_within_places) of_places.add(id);
    };
    for (const NodeId id : ids_below<NodeId>(rates.algebra.size())) {
        const Node& node = rates.algebra[id];
        facts.push_back(time_facts_of(node, facts, program, stage));
        if (!node.is<Call>()) continue;
        const bool is_of_time = facts[id].is_of_time, is_of_places = facts[id].is_of_places;
        for (const NodeId operand : node.reads()) note(operand, is_of_time, is_of_places);
    }
    for (const NodeId root : roots) note(root, false, false);
    return {of_time.formulas(rates.algebra), of_places.formulas(rates.algebra)};
}

}  // namespace cascade
