// Carries bounds from the leaves of an expression graph to its roots, and with them what is lost.
#include "lang/calculus/magnitudes.h"

#include "lang/calculus/algebra.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// The least and the largest normal number of single precision. What is smaller counts as 0.
constexpr double least_single = 0x1p-126, largest_single = 3.4028235e38;

struct Part {
    Magnitude size;
    double lost = 0;                ///< A bound of what has been taken for 0.
    std::optional<NodeId> lost_by;  ///< The part that was.
    std::optional<NodeId> too_large;
};

class Bounds {
public:
    Bounds(const Algebra& graph, const std::function<Magnitude(ItemId)>& magnitude_of)
        : graph_(graph), magnitude_of_(magnitude_of) {
        for (const NodeId id : ids_below<NodeId>(graph.size())) parts_.push_back(part_of(id));
    }

    const Part& operator[](NodeId id) const { return parts_[id]; }

private:
    Part part_of(NodeId id) const {
        const Node& node = graph_[id];
        Part part;
        if (!node.is<Call>()) {
            part.size = leaf(node);
            return part;
        }
        inherit(node, part);
        apply(node, part);
        // Where nothing is known of the size, nothing is known of the loss.
        if (!std::isfinite(part.lost) || !std::isfinite(part.size.most)) part.lost = 0;
        const bool multiplies = node.calls(Function::multiply) || node.calls(Function::divide) ||
                                node.calls(Function::power);
        if (!multiplies || !std::isfinite(part.size.most)) return part;
        if (part.size.most > 0 && part.size.most < least_single) {
            part.lost = part.size.most;
            part.lost_by = id;
        }
        if (part.size.most > largest_single && !part.too_large) part.too_large = id;
        return part;
    }

    Magnitude leaf(const Node& node) const {
        if (const auto* number = node.as<double>()) return Magnitude::of(*number);
        if (const auto* item = node.as<ItemId>()) return magnitude_of_(*item);
        const bool is_share = node.is(Builtin::sx) || node.is(Builtin::sy) || node.is(Builtin::sz);
        return is_share ? Magnitude{0, 1, true} : Magnitude{};
    }

    /// The part that loses most passes its name on.
    void inherit(const Node& node, Part& part) const {
        double most = 0;
        for (const NodeId operand : node.reads()) {
            const Part& of = parts_[operand];
            if (of.too_large && !part.too_large) part.too_large = of.too_large;
            if (!of.lost_by || !(of.lost > 0)) continue;
            // Relative to its own size, because factors follow.
            const double share = of.size.most > 0 ? of.lost / of.size.most : 0;
            if (part.lost_by && share <= most) continue;
            most = share;
            part.lost_by = of.lost_by;
        }
    }

    void apply(const Node& node, Part& part) const {
        const FunctionKind kind = info(node.function).kind;
        if (differentiates(node.function)) {
            part.size = {0, 0, false};  // What operators add is left out.
            return;
        }
        if (kind == FunctionKind::comparison) {
            part.size = {0, 1, true};
            return;
        }
        if (node.operand_count == 0) return;
        const Part& a = parts_[node.operands[0]];
        const Part& b = parts_[node.operands[node.operand_count > 1 ? 1 : 0]];
        switch (node.function) {
            case Function::multiply: return multiply(node, a, b, part);
            case Function::divide: return divide(a, b, part);
            case Function::power: return power(node, a, part);
            case Function::add:
            case Function::subtract: return add(node, a, b, part);
            case Function::negate:
                part.size = {a.size.least, a.size.most, false};
                part.lost = a.lost;
                return;
            case Function::abs:
                part.size = {a.size.least, a.size.most, true};
                part.lost = a.lost;
                return;
            case Function::min:
            case Function::max:
                part.size = either(a.size, b.size);
                part.lost = std::max(a.lost, b.lost);
                return;
            case Function::if_: {
                const Part& c = parts_[node.operands[2]];
                part.size = either(b.size, c.size);
                part.lost = std::max(b.lost, c.lost);
                return;
            }
            case Function::sqrt:
                part.size = {std::sqrt(a.size.least), std::sqrt(a.size.most), true};
                part.lost = std::sqrt(a.lost);
                return;
            case Function::exp:
                part.size = {std::exp(-a.size.most), std::exp(a.size.most), true};
                part.lost = part.size.most * a.lost;
                return;
            case Function::sin:
            case Function::cos:
            case Function::tanh:
                part.size = {0, 1, false};
                part.lost = a.lost;
                return;
            default: return;
        }
    }

    static Magnitude either(const Magnitude& a, const Magnitude& b) {
        return {std::min(a.least, b.least), std::max(a.most, b.most),
                a.is_positive && b.is_positive};
    }

    static void multiply(const Node& node, const Part& a, const Part& b, Part& part) {
        const bool is_square = node.operands[0] == node.operands[1];
        part.size = {a.size.least * b.size.least, a.size.most * b.size.most,
                     is_square || (a.size.is_positive && b.size.is_positive)};
        if (a.size.most == 0 || b.size.most == 0) part.size.most = 0;
        part.lost =
            (a.lost > 0 ? a.lost * b.size.most : 0) + (b.lost > 0 ? b.lost * a.size.most : 0);
    }

    static void divide(const Part& a, const Part& b, Part& part) {
        part.size = {a.size.least / b.size.most, a.size.most / b.size.least,
                     a.size.is_positive && b.size.is_positive};
        if (b.lost >= b.size.least && b.lost > 0) {
            part.lost = part.size.most;
            part.lost_by = b.lost_by;
        } else {
            part.lost = (a.lost > 0 ? a.lost / b.size.least : 0) +
                        (b.lost > 0 ? part.size.most * b.lost / b.size.least : 0);
        }
    }

    void power(const Node& node, const Part& a, Part& part) const {
        const auto* const exponent = graph_[node.operands[1]].as<double>();
        if (exponent == nullptr) return;
        const double n = *exponent;
        const bool is_even = std::fmod(n, 2) == 0;
        const double low = std::pow(n < 0 ? a.size.most : a.size.least, n);
        const double high = std::pow(n < 0 ? a.size.least : a.size.most, n);
        part.size = {low, high, is_even || a.size.is_positive};
        if (a.lost > 0) part.lost = std::abs(n) * high * std::min(1.0, a.lost / a.size.most);
    }

    static void add(const Node& node, const Part& a, const Part& b, Part& part) {
        const bool keeps_sign =
            node.calls(Function::add) && a.size.is_positive && b.size.is_positive;
        part.size.most = a.size.most + b.size.most;
        part.size.is_positive = keeps_sign;
        part.size.least =
            keeps_sign ? a.size.least + b.size.least
                       : std::max({a.size.least - b.size.most, b.size.least - a.size.most, 0.0});
        part.lost = a.lost + b.lost;
    }

    const Algebra& graph_;
    const std::function<Magnitude(ItemId)>& magnitude_of_;
    IdVector<NodeId, Part> parts_;
};

}  // namespace

std::vector<LostProduct> find_lost_products(const Program& program, std::uint32_t stage,
                                            const std::function<Magnitude(ItemId)>& magnitude_of) {
    const System& system = program.system_of(stage);
    const FlatRates rates(system, FieldSpace::of(program, system));
    const Bounds bounds(rates.algebra, magnitude_of);
    std::vector<LostProduct> found;
    for (const ItemId item : system.species()) {
        const Part& rate = bounds[rates.rate(item)];
        const auto add = [&](NodeId id, bool is_too_large) {
            found.push_back({item, rates.algebra[id].span, rates.algebra.formula(id),
                             bounds[id].size.most, rate.lost, rate.size.most, is_too_large});
        };
        if (rate.lost > 0 && rate.lost_by) add(*rate.lost_by, false);
        if (rate.too_large) add(*rate.too_large, true);
    }
    return found;
}

}  // namespace cascade
