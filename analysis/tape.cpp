// Lists the nodes on which the results depend, in order. Each node has a register.
#include "analysis/tape.h"

#include "core/check.h"
#include "lang/program/fold.h"
#include "lang/vocabulary/function_groups.h"

#include <algorithm>
#include <array>
#include <limits>

namespace cascade::analysis {

namespace {

template <typename Step>
double value_of(const Step& step, const std::vector<double>& registers) {
    const double a = registers[step.a], b = registers[step.b];
    if (b == 2 && is_power(step.function)) return a * a;
    return fold(step.function, std::array{a, b, registers[step.c]})
        .value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

Tape::Tape(const Algebra& algebra, std::span<const NodeId> results,
           std::span<const NodeKind> inputs)
    : numbers_(inputs.size(), 0.0) {
    const IdVector<NodeId, bool> is_needed = needed_by(algebra, results);
    std::vector<std::uint32_t> place(algebra.size(), 0);
    for (const NodeId id : algebra.nodes().ids()) {
        if (!is_needed[id]) continue;
        const Node& node = algebra[id];
        if (!node.is<double>() && !node.is<Call>()) {
            const auto found = std::find(inputs.begin(), inputs.end(), node.kind);
            CHECK(found != inputs.end(), "formulas of a tape read its inputs");
            place[id.index()] = static_cast<std::uint32_t>(found - inputs.begin());
            continue;
        }
        const auto to = static_cast<std::uint32_t>(numbers_.size());
        place[id.index()] = to;
        const auto* number = node.as<double>();
        numbers_.push_back(number != nullptr ? *number : 0.0);
        if (number != nullptr) continue;
        CHECK(node.operand_count <= 3, "formulas of a tape are of numbers");
        const auto operand = [&](std::size_t n) {
            return n < node.operand_count ? place[node.operands[n].index()] : 0;
        };
        steps_.push_back({node.function, operand(0), operand(1), operand(2), to});
    }
    for (const NodeId id : results) results_.push_back(place[id.index()]);
}

std::vector<double> Tape::run(std::span<const double> inputs) const {
    std::vector<double> registers = numbers_;
    std::copy(inputs.begin(), inputs.end(), registers.begin());
    for (const Step& step : steps_) registers[step.to] = value_of(step, registers);
    std::vector<double> results;
    for (const std::uint32_t place : results_) results.push_back(registers[place]);
    return results;
}

}  // namespace cascade::analysis
