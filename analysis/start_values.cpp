// Visits the formulas of a stage's items once.
#include "analysis/start_values.h"

#include "lang/calculus/derivative_rules.h"
#include "lang/program/fold.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cascade::analysis {

namespace {

class Starts {
public:
    Starts(Algebra& algebra, const Program& program) : algebra_(algebra), program_(program) {
        none_ = {algebra.number(0), algebra.number(0)};
    }

    IdVector<ItemId, StartValue> of_stage(std::uint32_t stage, std::span<const ItemId> varied) {
        const Stage& here = program_.stages[stage];
        IdVector<ItemId, StartValue> values(here.items.size(), none_);
        for (const ItemId item : here.order) {
            if (std::find(varied.begin(), varied.end(), item) != varied.end()) {
                values[item] = {algebra_.leaf(item), none_.value};
                continue;
            }
            values[item] = of_formula(here.items[item], values);
        }
        earlier_.push_back(values);
        return values;
    }

    StartValue of_formula(const Formula& formula, const IdVector<ItemId, StartValue>& items) {
        IdVector<NodeId, StartValue> parts;
        for (const Node& node : formula.nodes) parts.push_back(of_node(node, parts, items));
        return parts.empty() ? none_ : parts.back();
    }

private:
    StartValue of_node(const Node& node, const IdVector<NodeId, StartValue>& parts,
                       const IdVector<ItemId, StartValue>& items) {
        if (const auto* number = node.as<double>()) return {algebra_.number(*number), none_.value};
        if (const auto* item = node.as<ItemId>()) return items[*item];
        if (const auto* there = node.as<StageItem>()) {
            StartValue value =
                there->stage < earlier_.size() ? earlier_[there->stage][there->item] : none_;
            // A formula that reads a species of an earlier stage gets the final pattern of that
            // stage.
            value.differs |= program_.system_of(there->stage).is_species(there->item);
            return value;
        }
        if (const auto* builtin = node.as<Builtin>()) return of_builtin(*builtin);
        if (!node.is<Call>()) return elsewhere(!node.is<TextId>(), false);
        return of_call(node, parts);
    }

    StartValue elsewhere(bool differs, bool is_unknown) const {
        StartValue value = none_;
        value.differs = differs;
        value.is_unknown = is_unknown;
        return value;
    }

    StartValue of_builtin(Builtin builtin) {
        const Grid& grid = program_.domain.grid;
        const auto longest = static_cast<double>(grid.longest_side());
        const auto middle = [&](std::int64_t side) {
            return program_.domain.model ? 0.5 : 0.5 * static_cast<double>(side) / longest;
        };
        double value = 0;
        bool differs = true;
        switch (builtin) {
            case Builtin::x: value = middle(grid.width); break;
            case Builtin::y: value = middle(grid.height); break;
            case Builtin::z: value = middle(grid.depth); break;
            case Builtin::sx:
            case Builtin::sy:
            case Builtin::sz: value = 0.5; break;
            case Builtin::t:
            case Builtin::step: differs = false; break;
            default: differs = program_.domain.model.has_value(); break;
        }
        StartValue start = elsewhere(differs, false);
        start.value = algebra_.number(value);
        return start;
    }

    StartValue of_call(const Node& node, const IdVector<NodeId, StartValue>& parts) {
        const FunctionKind kind = info(node.function).kind;
        StartValue result = none_;
        for (const NodeId operand : node.reads()) {
            result.differs |= parts[operand].differs;
            result.is_unknown |= parts[operand].is_unknown;
        }
        const auto of = [&](std::size_t n) { return parts[node.operands[n]]; };
        switch (kind) {
            case FunctionKind::draw:
                if (node.function == Function::white) return result;
                result.value = of(0).value;
                result.scatter = spread(node, of(0), of(1));
                return result;
            case FunctionKind::pattern:
                // Smooth noise counts as random, like a random number that is drawn for each cell.
                if (node.function != Function::noise) return elsewhere(true, false);
                result.scatter = algebra_.number(0.5);
                return result;
            case FunctionKind::shape:
            case FunctionKind::landmarks: return elsewhere(true, false);
            case FunctionKind::text: return elsewhere(true, true);
            case FunctionKind::aggregate: result.value = of(0).value; return result;
            default: break;
        }
        const bool is_of_numbers = node.type == ValueType::number &&
                                   kind != FunctionKind::derivative &&
                                   kind != FunctionKind::stencil && kind != FunctionKind::flux;
        if (!is_of_numbers) return result;  // In a flat state, a derivative is 0.
        Node valued = node;
        for (std::size_t n = 0; n < node.operand_count; ++n) valued.operands[n] = of(n).value;
        result.value = algebra_.call_of(valued);
        for (std::size_t n = 0; n < node.operand_count; ++n) {
            if (algebra_.is_number(of(n).scatter, 0)) continue;
            const auto partial = partial_derivative(algebra_, valued, n);
            if (!partial) {
                result.differs = true;
                continue;
            }
            result.scatter =
                algebra_.sum(result.scatter,
                             algebra_.product(algebra_.magnitude(*partial), of(n).scatter));
        }
        return result;
    }

    /// A uniform number in m ± s has the standard deviation s / √3.
    NodeId spread(const Node& node, const StartValue& mean, const StartValue& size) {
        const double factor = node.function == Function::random ? 1 / std::sqrt(3.0) : 1;
        return algebra_.sum(mean.scatter, algebra_.product(algebra_.number(factor),
                                                           algebra_.magnitude(size.value)));
    }

    Algebra& algebra_;
    const Program& program_;
    StartValue none_;
    std::vector<IdVector<ItemId, StartValue>> earlier_;
};

}  // namespace

IdVector<ItemId, StartValue> start_values(Algebra& algebra, const Program& program,
                                          std::uint32_t stage, std::span<const ItemId> varied) {
    Starts starts(algebra, program);
    for (std::uint32_t earlier = 0; earlier < stage; ++earlier) starts.of_stage(earlier, {});
    return starts.of_stage(stage, varied);
}

StartValue start_value(Algebra& algebra, const Program& program, const Formula& formula,
                       const IdVector<ItemId, StartValue>& starts) {
    return Starts(algebra, program).of_formula(formula, starts);
}

}  // namespace cascade::analysis
