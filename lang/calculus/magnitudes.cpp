// Computes two bounds for each node, from the leaves of an expression graph to its roots. One is a
// bound of the node's value. The other is a bound of the error that arises because some
// subexpressions count as 0.
#include "lang/calculus/magnitudes.h"

#include "lang/calculus/algebra.h"
#include "lang/program/calls.h"
#include "lang/vocabulary/by_name.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// The smallest and the largest normal number of single precision. Smaller numbers count as 0.
constexpr double least_single = 0x1p-126, largest_single = 3.4028235e38;
/// A term that is smaller than this fraction of a number is less than half a unit in the last place
/// of the number.
constexpr double least_added = 0x1p-25;

struct Part {
    Magnitude size;
    /// A bound of the sum of all parts that count as 0 because they are too small.
    double lost = 0;
    std::optional<NodeId> lost_by = {};  ///< The part that counts as 0.
    /// The part to which `lost_by` was added; nullopt if it was not added.
    std::optional<NodeId> within = {};
    std::optional<NodeId> too_large = {};
    std::optional<double> number = {};  ///< The value, if the node is a constant.

    static Magnitude either(const Magnitude& a, const Magnitude& b) {
        return {std::min(a.least, b.least), std::max(a.most, b.most),
                a.is_positive && b.is_positive, a.is_negative && b.is_negative};
    }
    static Magnitude negative(const Magnitude& a) {
        return {a.least, a.most, a.is_negative, a.is_positive};
    }
    static Part sum(const Magnitude& a, const Magnitude& b, double lost) {
        const auto low = [](const Magnitude& of) { return of.is_positive ? of.least : -of.most; };
        const auto high = [](const Magnitude& of) { return of.is_negative ? -of.least : of.most; };
        const double lowest = low(a) + low(b), highest = high(a) + high(b);
        const double most = std::max(std::abs(lowest), std::abs(highest));
        const double least = std::max({lowest, -highest, a.least - b.most, b.least - a.most, 0.0});
        return {{least, std::isnan(most) ? INFINITY : most, lowest >= 0, highest <= 0}, lost};
    }
    /// The magnitude with the bounds `least` and `most`. Its sign is the sign of a product or
    /// quotient of a and b.
    static Magnitude with_sign(double least, double most, const Part& a, const Part& b) {
        const Magnitude &x = a.size, &y = b.size;
        return {least, most, (x.is_positive && y.is_positive) || (x.is_negative && y.is_negative),
                (x.is_positive && y.is_negative) || (x.is_negative && y.is_positive)};
    }
    static Part truth() { return {{0, 1, true}}; }
    static Part within_one(const Part& a) { return {{0, 1, false}, a.lost}; }

    // The bounds of functions, by their names in functions.def. All other functions are unbounded.
    friend Part add(const Part& a, const Part& b) { return sum(a.size, b.size, a.lost + b.lost); }
    friend Part subtract(const Part& a, const Part& b) {
        return sum(a.size, negative(b.size), a.lost + b.lost);
    }
    friend Part negate(const Part& a) { return {negative(a.size), a.lost}; }
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
        const double least = std::exp(a.size.is_positive ? a.size.least : -a.size.most);
        const double most = std::exp(a.size.is_negative ? -a.size.least : a.size.most);
        return {{least, most, true}, most * a.lost};
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
        Part part{with_sign(a.size.least * b.size.least, a.size.most * b.size.most, a, b)};
        if (is_square) part.size.is_positive = true;
        if (a.size.most == 0 || b.size.most == 0) part.size.most = 0;
        part.lost =
            (a.lost > 0 ? a.lost * b.size.most : 0) + (b.lost > 0 ? b.lost * a.size.most : 0);
        return part;
    }
    friend Part divide(const Part& a, const Part& b) {
        Part part{with_sign(a.size.least / b.size.most, a.size.most / b.size.least, a, b)};
        if (b.lost >= b.size.least && b.lost > 0) {
            part.lost = part.size.most;
            part.lost_by = b.lost_by;
            part.within = b.within;
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
        if (node.calls(Function::shifted)) {
            part.size = parts_[node.operands[0]].size;
        } else if (differentiates(node.function)) {
            part.size = {0, 0, false};  // The terms that operators give are left out.
        } else if (node.operand_count > 0) {
            const auto operand = [&](std::size_t n) -> const Part& {
                return parts_[node.operands[n < node.operand_count ? n : 0]];
            };
            part = call_by_name(node.function, operand(0), operand(1), operand(2));
        }
        inherit(node, part);
        // If the size of the part is unknown, its loss is unknown, too.
        if (!std::isfinite(part.lost) || !std::isfinite(part.size.most)) part.lost = 0;
        if (!std::isfinite(part.size.most)) return part;
        if (calls(node, is_sum)) swallow(node, part);
        const bool multiplies = node.calls(Function::multiply) || node.calls(Function::divide) ||
                                node.calls(Function::power) || node.calls(Function::exp);
        if (!multiplies) return part;
        if (part.size.most > 0 && part.size.most < least_single) {
            part.lost = part.size.most;
            part.lost_by = id;
            part.within = {};
        }
        if (part.size.most > largest_single && !part.too_large) part.too_large = id;
        return part;
    }

    /// If one operand of a sum is too small to change the other operand in any cell, adds it to the
    /// loss.
    void swallow(const Node& node, Part& part) const {
        for (const std::size_t small : {0, 1}) {
            const NodeId id = node.operands[small], other = node.operands[1 - small];
            const double most = parts_[id].size.most;
            if (!(most > 0 && most < least_added * parts_[other].size.least)) continue;
            part.lost += most;
            if (part.lost_by && parts_[*part.lost_by].size.most > most) continue;
            part.lost_by = id;
            part.within = other;
        }
    }

    Magnitude leaf(const Node& node) const {
        if (const auto* number = node.as<double>()) return Magnitude::of(*number);
        if (const auto* item = node.as<ItemId>()) return magnitude_of_(*item);
        const bool is_share = node.is(Builtin::sx) || node.is(Builtin::sy) || node.is(Builtin::sz);
        return is_share ? Magnitude{0, 1, true} : Magnitude{};
    }

    /// Takes `lost_by` from the operand that has lost most.
    void inherit(const Node& node, Part& part) const {
        double most = 0;
        const Part* from = nullptr;
        for (const NodeId operand : node.reads()) {
            const Part& of = parts_[operand];
            if (of.too_large && !part.too_large) part.too_large = of.too_large;
            if (!of.lost_by || !(of.lost > 0)) continue;
            // The loss is compared relative to the operand's size, because other factors may
            // multiply the operand.
            const double share = of.size.most > 0 ? of.lost / of.size.most : 0;
            if (from != nullptr && share <= most) continue;
            most = share;
            from = &of;
        }
        if (part.lost_by || from == nullptr) return;
        part.lost_by = from->lost_by;
        part.within = from->within;
    }

    const Algebra& graph_;
    const std::function<Magnitude(ItemId)>& magnitude_of_;
    IdVector<NodeId, Part> parts_;
};

/// A formula that is searched, and the place of the formula.
struct Root {
    ItemId species;
    std::optional<Side> side;
    SideKind kind{};
    NodeId id;
};

std::vector<Root> roots_of(const Stage& stage, const System& system, FlatRates& rates) {
    std::vector<Root> roots;
    const IdVector<SpeciesId, ItemId> items = system.species();
    for (const SpeciesId species : items.ids()) {
        const ItemId item = items[species];
        roots.push_back({item, std::nullopt, {}, rates.rate(item)});
        if (species.index() >= stage.sides.size()) continue;
        for (std::size_t side = 0; side < wall_count; ++side) {
            const SideSetting& setting = stage.sides[species][side];
            if (setting.value.nodes.empty()) continue;
            roots.push_back(
                {item, static_cast<Side>(side), setting.kind, rates.flattening.add(setting.value)});
        }
    }
    return roots;
}

}  // namespace

std::vector<LostPart> find_lost_parts(const Program& program, std::uint32_t stage,
                                      const std::function<Magnitude(ItemId)>& magnitude_of) {
    const System& system = program.system_of(stage);
    FlatRates rates(system, FieldSpace::of(program, system));
    const std::vector<Root> roots = roots_of(program.stages[stage], system, rates);
    const Bounds bounds(rates.algebra, magnitude_of);
    std::vector<LostPart> found;
    for (const Root& root : roots) {
        const Part& whole = bounds[root.id];
        const auto add = [&](NodeId id, LostPart::Cause cause) {
            const Span other =
                cause == LostPart::Cause::swallowed ? rates.algebra[*whole.within].span : Span();
            found.push_back({root.species, root.side, root.kind, rates.algebra[id].span, other,
                             rates.algebra.formula(id), bounds[id].size.most, whole.lost,
                             whole.size.most, cause});
        };
        if (whole.lost > 0 && whole.lost_by) {
            add(*whole.lost_by,
                whole.within ? LostPart::Cause::swallowed : LostPart::Cause::too_small);
        }
        if (whole.too_large) add(*whole.too_large, LostPart::Cause::too_large);
    }
    return found;
}

}  // namespace cascade
