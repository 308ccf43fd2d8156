// Marks parts bottom-up, then takes the largest ones that depend on time alone.
#include "lang/calculus/time_parts.h"

#include "lang/calculus/algebra.h"

#include <algorithm>

namespace cascade {

namespace {

/// Facts about a part of a formula.
struct TimeFacts {
    bool is_of_time = false;  ///< It reads only constants and `t`,
    bool reads_time = false;  ///< and `t` is among them.
};

TimeFacts time_facts_of(const Node& node, const IdVector<NodeId, TimeFacts>& before,
                        const Program& program, std::uint32_t stage) {
    const bool is_time = node.is(Builtin::t);
    if (!node.is<Call>()) {
        const bool is_constant = (node.is<double>() || node.is<ItemId>() || node.is<StageItem>()) &&
                                 node.type == ValueType::number;
        const bool is_same = !differs_by_cell(node, false, program, stage);
        return {is_same && (is_time || is_constant), is_time};
    }
    const Function function = node.function;
    TimeFacts kind{!info(function).is_aggregate && !is_random(function) &&
                       !varies_by_cell(function) && !differentiates(function) &&
                       node.type == ValueType::number,
                   false};
    for (const NodeId operand : node.reads()) {
        kind.is_of_time = kind.is_of_time && before[operand].is_of_time;
        kind.reads_time = kind.reads_time || before[operand].reads_time;
    }
    return kind;
}

}  // namespace

std::vector<Formula> parts_of_time(const Program& program, std::uint32_t stage) {
    const System& system = program.system_of(stage);
    FlatRates rates(system, FieldSpace::of(program, system));
    IdVector<NodeId, TimeFacts> kinds;
    std::vector<NodeId> found;
    const auto note = [&](NodeId id) {
        const bool is_wanted = kinds[id].is_of_time && kinds[id].reads_time;
        if (is_wanted && std::find(found.begin(), found.end(), id) == found.end())
            found.push_back(id);
    };
    for (const NodeId id : ids_below<NodeId>(rates.count)) {
        const Node& node = rates.algebra[id];
        kinds.push_back(time_facts_of(node, kinds, program, stage));
        if (!node.is<Call>() || kinds[id].is_of_time) continue;
        for (const NodeId operand : node.reads()) note(operand);
    }
    for (const ItemId item : system.species()) note(rates.rate(item));
    std::vector<Formula> parts;
    for (const NodeId id : found) parts.push_back(rates.algebra.formula(id));
    return parts;
}

}  // namespace cascade
