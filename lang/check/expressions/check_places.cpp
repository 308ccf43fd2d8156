// Warns of positions that are given as numbers of cells or as lengths, as in `x < 5` or `disc(64,
// 64, 10)`. In the language, positions are fractions of the longest side, from 0 to 1. Comparisons
// are evaluated on intervals of x, y and z (R. E. Moore, "Interval Analysis", 1966).
#include "lang/check/expressions/expression_checker.h"
#include "lang/vocabulary/by_name.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ranges>
#include <string>
#include <vector>

namespace cascade::checking {

namespace {

struct Interval {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
    /// x, y or z, if the value is computed only from this coordinate and numbers.
    std::string_view place = {};

    /// The smallest magnitude in the interval.
    double least() const {
        return low <= 0 && high >= 0 ? 0 : std::min(std::abs(low), std::abs(high));
    }
    double most() const { return std::max(std::abs(low), std::abs(high)); }

    friend std::string_view place_of(const Interval& a, const Interval& b) {
        return a.place.empty() ? b.place : a.place;
    }

    /// The interval from the smallest to the largest of the values. It has no `place`, because the
    /// values are not fractions of the longest side, and messages about fractions would be false.
    static Interval around(std::initializer_list<double> values) {
        const auto [low, high] = std::minmax(values);
        if (std::isnan(low) || std::isnan(high)) return {};
        return {low, high};
    }

    // Functions of intervals, by their names in functions.def. The results of all other functions
    // are unknown.
    friend Interval add(const Interval& a, const Interval& b) {
        return {a.low + b.low, a.high + b.high, place_of(a, b)};
    }
    friend Interval subtract(const Interval& a, const Interval& b) {
        return {a.low - b.high, a.high - b.low, place_of(a, b)};
    }
    friend Interval negate(const Interval& a) { return {-a.high, -a.low, a.place}; }
    friend Interval multiply(const Interval& a, const Interval& b) {
        return around({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    }
    friend Interval divide(const Interval& a, const Interval& b) {
        if (b.low <= 0 && b.high >= 0) return {};
        return around({a.low / b.low, a.low / b.high, a.high / b.low, a.high / b.high});
    }
    friend Interval power(const Interval& a, const Interval& b) {
        const bool is_even = b.low == b.high && std::fmod(b.low, 2) == 0 && b.low > 0;
        if (!is_even) return {};
        return {std::pow(a.least(), b.low), std::pow(a.most(), b.low), place_of(a, b)};
    }
    friend Interval abs(const Interval& a) { return {a.least(), a.most(), a.place}; }
    friend Interval sqrt(const Interval& a) {
        return {std::sqrt(std::max(a.low, 0.0)), std::sqrt(a.high), a.place};
    }
    friend Interval hypot(const Interval& a, const Interval& b) {
        return {std::hypot(a.least(), b.least()), std::hypot(a.most(), b.most()), place_of(a, b)};
    }
};

/// Whether the comparison has the same result everywhere, by a wide margin. Without the margin,
/// comparisons that the author may intend would be reported, such as `hypot(x - 0.5, y - 0.5) <
/// 0.8`.
bool is_decided(Function comparison, const Interval& a, const Interval& b) {
    constexpr double far = 0.5;
    const bool is_of_order =
        is_comparison(comparison) &&
        info(comparison).spelling.find_first_of("<>") != std::string_view::npos;
    return is_of_order && (a.high + far < b.low || a.low > b.high + far);
}

bool is_place(const Node& node) {
    const auto* const builtin = node.as<Builtin>();
    return builtin != nullptr && *builtin <= Builtin::sz;
}

/// How many operands of a shape, noise or a lattice are positions or lengths. They are the first
/// operands. 0 for other functions.
std::size_t places_and_lengths(const Node& node) {
    if (node.calls(Function::noise)) return 1;
    if (node.calls(Function::lattice) || node.calls(Function::diamond)) return 2;
    const bool is_shape =
        node.calls(Function::disc) || node.calls(Function::gauss) || node.calls(Function::box);
    return is_shape ? node.operand_count : 0;
}

}  // namespace

void ExpressionChecker::check_places() {
    const bool may_speak = scope_.context == Context::value || scope_.context == Context::rate ||
                           scope_.context == Context::mask || scope_.context == Context::picture;
    if (!may_speak || in_cells()) return;
    std::vector<Interval> ranges(formula_.nodes.size());
    for (const NodeId id : formula_.nodes.ids()) {
        const Node& node = formula_.nodes[id];
        Interval& range = ranges[id.index()];
        if (parts_[id].constant) {
            range = {parts_[id].value, parts_[id].value};
        } else if (is_place(node)) {
            range = {0, 1, builtin_names[static_cast<std::size_t>(*node.as<Builtin>())]};
        } else if (node.is<Call>() && node.operand_count > 0) {
            const Interval& a = ranges[node.operands[0].index()];
            const Interval& b = ranges[node.reads().back().index()];
            const bool is_known = std::isfinite(a.low) && std::isfinite(a.high) &&
                                  std::isfinite(b.low) && std::isfinite(b.high);
            const std::string_view place = place_of(a, b);
            if (is_known && !place.empty() && is_decided(node.function, a, b)) {
                warn_of_place(node.span, place);
            }
            if (is_known && node.operand_count <= 2) range = call_by_name(node.function, a, b, b);
            check_shape_in_domain(node);
        }
    }
}

void ExpressionChecker::warn_of_place(Span span, std::string_view place) {
    const DomainSettings& domain = work_.program.domain;
    const bool has_lengths = !domain.model && !domain.surface && place.size() == 1;
    warn(span,
         fmt::format("this value is the same in every cell, because {} runs only from 0 to 1{}",
                     place, place.size() == 1 ? " along the longest side" : ""),
         has_lengths ? fmt::format("write domain.{} for a position in units of length", place)
                     : "");
}

/// Warns of shapes, noise and lattices with positions or lengths far outside the domain.
void ExpressionChecker::check_shape_in_domain(const Node& node) {
    const std::size_t count = places_and_lengths(node);
    if (count == 0) return;
    std::vector<double> numbers;
    for (const NodeId operand : node.reads()) {
        if (!parts_[operand].constant) return;
        numbers.push_back(parts_[operand].value);
    }
    constexpr double far = 2;
    const auto is_far = [](double value) { return std::abs(value) > far; };
    if (std::ranges::none_of(numbers | std::views::take(count), is_far)) return;
    const DomainSettings& domain = work_.program.domain;
    std::string hint;
    if (!domain.model && !domain.surface) {
        const Grid& grid = domain.grid;
        const auto cells = static_cast<double>(grid.longest_side());
        for (const double side : {cells * grid.spacing, cells}) {
            std::vector<std::string> shares;
            for (const double number : numbers) {
                const bool is_length = shares.size() < count;
                if (is_length && (number < 0 || number > side)) break;
                shares.push_back(fmt::format("{:.3g}", is_length ? number / side : number));
            }
            if (shares.size() < numbers.size()) continue;
            hint =
                fmt::format("write {}({})", info(node.function).spelling, fmt::join(shares, ", "));
            break;
        }
    }
    warn(node.span,
         "this position or length is far outside of the domain: the longest side runs "
         "from 0 to 1",
         hint);
}

}  // namespace cascade::checking
