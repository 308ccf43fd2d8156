// Infers dimensions from the leaves of a formula to its root.
#include "lang/check/expressions/measures.h"

#include "lang/vocabulary/functions.h"

#include <algorithm>
#include <optional>

namespace cascade::checking {

namespace {

using MeasureKind = Measure::Kind;

class MeasureReader {
public:
    MeasureReader(const Formula& formula, const MeasureOf& leaves,
                  std::vector<Contradiction>& found)
        : formula_(formula), leaves_(leaves), found_(found) {}

    Measure run() {
        for (const NodeId id : formula_.nodes.ids()) measures_.push_back(measure(id));
        return measures_.back();
    }

private:
    const Node& node(NodeId id) const { return formula_.nodes[id]; }
    const Measure& of(const Node& call, std::size_t n) const { return measures_[call.operands[n]]; }
    bool knows_lengths() const { return leaves_.units.knows(BaseQuantity::length); }
    bool knows_times() const { return leaves_.units.knows(BaseQuantity::time); }

    Measure measure(NodeId id) {
        const Node& here = node(id);
        if (const Dimension* known = leaves_.measured.find(here.span)) {
            const bool is_length = here.is<Call>() && !knows_lengths();
            return is_length ? Measure{} : Measure::of(*known);
        }
        if (here.is<double>()) return {leaves_.number};
        if (const auto* builtin = here.as<Builtin>()) {
            const bool is_time = *builtin == Builtin::t && knows_times();
            return is_time ? Measure::of(Dimension::of(BaseQuantity::time)) : Measure{};
        }
        if (here.is<Call>()) return measure_call(here);
        return leaves_.name(here);
    }

    void contradict(const Node& call, std::size_t a, std::size_t b) {
        const Node &first = node(call.operands[a]), &second = node(call.operands[b]);
        found_.push_back(
            {second.span, first.span, second.span, of(call, a).dimension, of(call, b).dimension});
    }
    /// The measure that operands have in common if they must have the same dimension.
    Measure agree(const Node& call, std::size_t first, std::size_t end) {
        std::size_t known = first;
        while (known < end && !of(call, known).is_known()) ++known;
        for (std::size_t n = known + 1; n < end; ++n) {
            const Measure& other = of(call, n);
            if (!other.is_known() || other.dimension == of(call, known).dimension) continue;
            contradict(call, known, n);
            return {};
        }
        if (known < end) return of(call, known);
        const bool are_plain =
            std::ranges::all_of(call.reads().subspan(first, end - first), [&](NodeId id) {
                return measures_[id].kind == MeasureKind::plain;
            });
        return {are_plain ? MeasureKind::plain : MeasureKind::any};
    }
    /// The measure of a function whose operand and result must be plain numbers.
    Measure plain_of(const Node& call) {
        const Measure& operand = of(call, 0);
        if (operand.is_known() && !operand.dimension.is_none()) {
            const Span span = node(call.operands[0]).span;
            found_.push_back({span, span, {}, operand.dimension, {}});
        }
        return {MeasureKind::plain};
    }
    static Measure product(const Measure& a, const Measure& b, bool divides) {
        if (a.kind == MeasureKind::any || b.kind == MeasureKind::any) return {};
        if (a.kind == MeasureKind::plain && b.kind == MeasureKind::plain)
            return {MeasureKind::plain};
        return Measure::of(divides ? a.dimension / b.dimension : a.dimension * b.dimension);
    }
    static Measure power(const Measure& base, double exponent) {
        if (!base.is_known()) return base;
        const auto raised = to_power(base.dimension, exponent);
        return raised ? Measure::of(*raised) : Measure{};
    }
    Measure per_length(const Measure& measure, int power) const {
        if (measure.kind != MeasureKind::known || !knows_lengths()) return {};
        return Measure::of(measure.dimension / Dimension::of(BaseQuantity::length, power));
    }

    /// The value of an exponent that consists only of numbers: 2, -1, 1/2.
    std::optional<double> constant(NodeId id) const {
        const Node& here = node(id);
        if (const auto* number = here.as<double>()) return *number;
        if (here.calls(Function::negate)) {
            const auto value = constant(here.operands[0]);
            return value ? std::optional(-*value) : std::nullopt;
        }
        if (here.calls(Function::divide)) {
            const auto above = constant(here.operands[0]), below = constant(here.operands[1]);
            if (above && below && *below != 0) return *above / *below;
        }
        return std::nullopt;
    }

    Measure measure_power(const Node& call) {
        const Measure& exponent = of(call, 1);
        if (exponent.is_known() && !exponent.dimension.is_none()) {
            const Span span = node(call.operands[1]).span;
            found_.push_back({span, span, {}, exponent.dimension, {}});
            return {};
        }
        if (const auto value = constant(call.operands[1])) return power(of(call, 0), *value);
        const Measure& base = of(call, 0);
        const bool is_plain =
            base.kind == MeasureKind::plain || (base.is_known() && base.dimension.is_none());
        return is_plain ? base : Measure{};
    }

    Measure measure_call(const Node& call) {
        switch (call.function) {
            case Function::add:
            case Function::subtract:
            case Function::min:
            case Function::max:
            case Function::hypot:
            case Function::mod:
            case Function::clamp:
            case Function::random:
            case Function::normal: return agree(call, 0, call.operand_count);
            case Function::if_: return agree(call, 1, 3);
            case Function::atan2:
            case Function::step:
            case Function::smoothstep:
                agree(call, 0, call.operand_count);
                return {MeasureKind::plain};
            case Function::multiply: return product(of(call, 0), of(call, 1), false);
            case Function::divide: return product(of(call, 0), of(call, 1), true);
            case Function::negate:
            case Function::abs:
            case Function::floor:
            case Function::ceil:
            case Function::round: return of(call, 0);
            case Function::power:
            case Function::pow: return measure_power(call);
            case Function::sqrt: return power(of(call, 0), 0.5);
            case Function::cbrt: return power(of(call, 0), 1.0 / 3);
            case Function::exp:
            case Function::log:
            case Function::sin:
            case Function::cos:
            case Function::tan:
            case Function::asin:
            case Function::acos:
            case Function::atan:
            case Function::sinh:
            case Function::cosh:
            case Function::tanh: return plain_of(call);
            case Function::sign: return {MeasureKind::plain};
            default: break;
        }
        const FunctionKind kind = info(call.function).kind;
        if (kind == FunctionKind::logic) return {MeasureKind::plain};
        if (kind == FunctionKind::comparison) {
            agree(call, 0, 2);
            return {MeasureKind::plain};
        }
        if (kind == FunctionKind::pattern || kind == FunctionKind::shape)
            return {MeasureKind::plain};
        return measure_in_space(call);
    }

    Measure measure_in_space(const Node& call) {
        const std::size_t count = call.operand_count;
        switch (call.function) {
            case Function::lap:
            case Function::grad:
            case Function::div:
            case Function::curl: return per_length(of(call, 0), info(call.function).lengths);
            case Function::grad2: return per_length(power(of(call, 0), 2), 2);
            case Function::vector: return agree(call, 0, count);
            case Function::advect:
                return per_length(product(count == 2 ? of(call, 0) : agree(call, 0, count - 1),
                                          of(call, count - 1), false),
                                  1);
            case Function::diffuse:
                return per_length(product(power(agree(call, 1, 3), 2), of(call, 0), false), 2);
            case Function::component:
            case Function::length: return of(call, 0);
            case Function::dot:
            case Function::cross: return product(of(call, 0), of(call, 1), false);
            default: break;
        }
        const FunctionInfo& row = info(call.function);
        if (row.kind == FunctionKind::derivative) return per_length(of(call, 0), row.lengths);
        if (row.is_aggregate && count == 1) return of(call, 0);
        return {};
    }

    const Formula& formula_;
    const MeasureOf& leaves_;
    std::vector<Contradiction>& found_;
    IdVector<NodeId, Measure> measures_;
};

}  // namespace

std::string words_of_dimension(const ScriptUnits& units, const Dimension& dimension) {
    return dimension.is_none() ? "a plain number" : "in " + units.name_of(dimension);
}

Measure measure_of(const Formula& formula, const MeasureOf& leaves,
                   std::vector<Contradiction>& found) {
    return MeasureReader(formula, leaves, found).run();
}

}  // namespace cascade::checking
