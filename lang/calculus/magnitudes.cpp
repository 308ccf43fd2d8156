// Carries bounds from the leaves of an expression graph to its roots, and with them what is lost.
#include "lang/calculus/magnitudes.h"

#include "lang/calculus/algebra.h"
#include "lang/vocabulary/by_name.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// The least and the largest normal number of single precision. What is smaller counts as 0.
constexpr double least_single = 0x1p-126, largest_single = 3.4028235e38;

struct Part {
    Magnitude size;
    double lost = 0;                     ///< A bound of what has been taken for 0.
    std::optional<NodeId> lost_by = {};  ///< The part that was.
    std::optional<NodeId> too_large = {};
    std::optional<double> number = {};  ///< If it is one.

    static Magnitude either(const Magnitude& a, const Magnitude& b) {
        return {std::min(a.least, b.least), std::max(a.most, b.most),
                a.is_positive && b.is_positive};
    }
    /// A sum or a difference.
    static Part joined(const Part& a, const Part& b, bool keeps_sign) {
        const double least =
            keeps_sign ? a.size.least + b.size.least
                       : std::max({a.size.least - b.size.most, b.size.least - a.size.most, 0.0});
        return {{least, a.size.most + b.size.most, keeps_sign}, a.lost + b.lost};
    }
    static Part truth() { return {{0, 1, true}}; }
    static Part within_one(const Part& a) { return {{0, 1, false}, a.lost}; }

    // What functions make of parts, by their names in functions.def; of the others nothing is
    // known.
    friend Part add(const Part& a, const Part& b) {
        return joined(a, b, a.size.is_positive && b.size.is_positive);
    }
    friend Part subtract(const Part& a, const Part& b) { return joined(a, b, false); }
    friend Part negate(const Part& a) { return {{a.size.least, a.size.most, false}, a.lost}; }
    friend Part abs(const Part& a) { return {{a.size.least, a.size.most, true}, a.lost}; }
    friend Part min(const Part& a, const Part& b) {
        return {either(a.size, b.size), std::max(a.lost, b.lost)};
    }
    friend Part max(const Part& a, const Part& b) { return min(a, b); }
    friend Part if_(const Part&, const Part& b, const Part& c) { return min(b, c); }
    friend Part sqrt(const Part& a) {
        return {{std::sqrt(a.size.least), std::sqrt(a.size.most), true}, std::sqrt(a.lost)};
    }
    friend Part exp(const Part& a) {
        const double most = std::exp(a.size.most);
        return {{std::exp(-a.size.most), most, true}, most * a.lost};
    }
    friend Part sin(const Part& a) { return within_one(a); }
    friend Part cos(const Part& a) { return within_one(a); }
    friend Part tanh(const Part& a) { return within_one(a); }
    friend Part less(const Part&, const Part&) { return truth(); }
    friend Part less_equal(const Part&, const Part&) { return truth(); }
    friend Part greater(const Part&, const Part&) { return truth(); }
    friend Part greater_equal(const Part&, const Part&) { return truth(); }
    friend Part equal(const Part&, const Part&) { return truth(); }
    friend Part not_equal(const Part&, const Part&) { return truth(); }
    friend Part multiply(const Part& a, const Part& b) {
        const bool is_square = &a == &b;
        Part part{{a.size.least * b.size.least, a.size.most * b.size.most,
                   is_square || (a.size.is_positive && b.size.is_positive)}};
        if (a.size.most == 0 || b.size.most == 0) part.size.most = 0;
        part.lost =
            (a.lost > 0 ? a.lost * b.size.most : 0) + (b.lost > 0 ? b.lost * a.size.most : 0);
        return part;
    }
    friend Part divide(const Part& a, const Part& b) {
        Part part{{a.size.least / b.size.most, a.size.most / b.size.least,
                   a.size.is_positive && b.size.is_positive}};
        if (b.lost >= b.size.least && b.lost > 0) {
            part.lost = part.size.most;
            part.lost_by = b.lost_by;
        } else {
            part.lost = (a.lost > 0 ? a.lost / b.size.least : 0) +
                        (b.lost > 0 ? part.size.most * b.lost / b.size.least : 0);
        }
        return part;
    }
    friend Part power(const Part& a, const Part& b) {
        if (!b.number) return {};
        const double n = *b.number;
        const bool is_even = std::fmod(n, 2) == 0;
        const double low = std::pow(n < 0 ? a.size.most : a.size.least, n);
        const double high = std::pow(n < 0 ? a.size.least : a.size.most, n);
        Part part{{low, high, is_even || a.size.is_positive}};
        if (a.lost > 0) part.lost = std::abs(n) * high * std::min(1.0, a.lost / a.size.most);
        return part;
    }
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
            if (const auto* number = node.as<double>()) part.number = *number;
            part.size = leaf(node);
            return part;
        }
        if (differentiates(node.function)) {
            part.size = {0, 0, false};  // What operators add is left out.
        } else if (node.operand_count > 0) {
            const auto operand = [&](std::size_t n) -> const Part& {
                return parts_[node.operands[n < node.operand_count ? n : 0]];
            };
            part = call_by_name(node.function, operand(0), operand(1), operand(2));
        }
        inherit(node, part);
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
        std::optional<NodeId> lost_by;
        for (const NodeId operand : node.reads()) {
            const Part& of = parts_[operand];
            if (of.too_large && !part.too_large) part.too_large = of.too_large;
            if (!of.lost_by || !(of.lost > 0)) continue;
            // Relative to its own size, because factors follow.
            const double share = of.size.most > 0 ? of.lost / of.size.most : 0;
            if (lost_by && share <= most) continue;
            most = share;
            lost_by = of.lost_by;
        }
        if (!part.lost_by) part.lost_by = lost_by;
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
