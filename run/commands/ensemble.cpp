// Groups the runs by their values other than the seed.
#include "run/commands/ensemble.h"

#include "core/csv.h"
#include "picture/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace cascade {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array cell_counts = {std::pair{std::string_view("cells"), &CellCounts::count},
                                    std::pair{std::string_view("births"), &CellCounts::births},
                                    std::pair{std::string_view("deaths"), &CellCounts::deaths}};

std::vector<std::string> without_seed(std::vector<std::string> cells,
                                      std::span<const std::string> names) {
    const auto seed = std::ranges::find(names, "seed");
    if (seed != names.end()) cells.erase(cells.begin() + (seed - names.begin()));
    return cells;
}

/// Whether a mean over runs has a meaning. Angles begin again after half a turn, so their mean
/// would depend on where the half turn begins.
bool has_mean(std::string_view number) { return number != "angle"; }

Statistics statistics_in(const Ensemble& ensemble, std::string_view number, SweepResults results) {
    std::vector<double> values;
    for (const std::size_t run : ensemble.runs) {
        values.push_back(measured_number(results[run], number));
    }
    return statistics_of(values);
}

/// A curve of a number: the statistics of the number at each position along the horizontal axis,
/// from left to right.
struct Curve {
    /// The values of the names other than the name across, such as "kill = 0.06".
    std::string name;
    std::vector<std::pair<double, Statistics>> points;
};

std::vector<Curve> curves_of(std::string_view number, SweepResults results,
                             std::span<const Variation> varied) {
    const std::vector<std::string> names = names_but_seed(varied);
    std::vector<Curve> curves;
    for (const Ensemble& each : ensembles_of(results.size(), varied)) {
        std::vector<std::string> parts;
        for (std::size_t k = 1; k < names.size(); ++k) {
            parts.push_back(fmt::format("{} = {}", names[k], each.values[k]));
        }
        const std::string name = fmt::format("{}", fmt::join(parts, ", "));
        auto curve = std::ranges::find(curves, name, &Curve::name);
        if (curve == curves.end()) curve = curves.insert(curves.end(), Curve{name, {}});
        const auto across = read_with_unit(each.values[0]);
        curve->points.emplace_back(across ? across->number : none,
                                   statistics_in(each, number, results));
    }
    for (Curve& curve : curves) {
        std::ranges::stable_sort(curve.points, {}, [](const auto& point) { return point.first; });
    }
    return curves;
}

/// Returns the range of all finite numbers, with a margin.
AxisRange range_over(const std::vector<double>& numbers, std::string name) {
    double low = none, high = none;
    for (const double number : numbers) {
        if (!std::isfinite(number)) continue;
        low = std::fmin(low, number);
        high = std::fmax(high, number);
    }
    if (std::isnan(low)) return {0, 1, std::move(name)};
    const double width = high > low ? high - low : low != 0 ? std::abs(low) : 1;
    const double margin = 0.05 * width;
    return {low - margin, high + margin, std::move(name)};
}

class CurvePlot {
public:
    CurvePlot(std::vector<Curve> curves, std::string across, std::string up)
        : curves_(std::move(curves)), axes_({}, {}, width, height) {
        std::vector<double> x, y;
        for (const Curve& curve : curves_) {
            for (const auto& [at, all] : curve.points) {
                x.push_back(at);
                y.insert(y.end(), {all.mean, all.low, all.high});
            }
        }
        axes_ = Axes(range_over(x, std::move(across)), range_over(y, std::move(up)), width, height);
    }

    Drawing draw(std::string title) {
        drawing_.width = width;
        drawing_.height = height;
        drawing_.add(DrawnArea{{0, 0}, width, height, {1, 1, 1}});
        for (std::size_t k = 0; k < curves_.size(); ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(curves_.size());
            const Colour colour = colour_at(*find_palette("viridis"), 0.1 + 0.8 * share);
            draw_curve(curves_[k], colour);
            draw_name(curves_[k].name, k, colour);
        }
        axes_.draw(drawing_);
        if (is_empty_) {
            drawing_.add(DrawnText{{(axes_.left() + axes_.right()) / 2, height / 2},
                                   "no run has this feature",
                                   DrawnText::Anchor::middle});
        }
        drawing_.add(
            DrawnText{{axes_.right(), axes_.top() - 11}, std::move(title), DrawnText::Anchor::end});
        return std::move(drawing_);
    }

private:
    static constexpr double width = 640, height = 420;

    void draw_curve(const Curve& curve, Colour colour) {
        DrawnLine line{{}, colour, 1.5, false};
        for (const auto& [x, all] : curve.points) {
            if (!std::isfinite(all.mean)) continue;
            line.points.push_back(axes_.place(x, all.mean));
            is_empty_ = false;
            drawing_.add(DrawnDisc{line.points.back(), 3, colour});
            if (std::isfinite(all.low)) draw_bar(x, all, colour);
        }
        if (line.points.size() > 1) drawing_.add(std::move(line));
    }

    void draw_bar(double x, const Statistics& all, Colour colour) {
        constexpr double cap = 4;
        const DrawnPoint low = axes_.place(x, all.low), high = axes_.place(x, all.high);
        drawing_.add(DrawnLine{{low, high}, colour, 1, false});
        for (const auto& [across, up] : {low, high}) {
            drawing_.add(DrawnLine{{{across - cap, up}, {across + cap, up}}, colour, 1, false});
        }
    }

    /// Adds the name of curve `k` to the legend. Leaves out names that would be below the box.
    void draw_name(const std::string& name, std::size_t k, Colour colour) {
        constexpr double line = 15;
        const double y = axes_.top() + line * (static_cast<double>(k) + 0.8);
        if (name.empty() || y > axes_.bottom()) return;
        drawing_.add(DrawnDisc{{axes_.right() - 8, y}, 3, colour});
        drawing_.add(DrawnText{{axes_.right() - 16, y}, name, DrawnText::Anchor::end});
    }

    std::vector<Curve> curves_;
    Axes axes_;
    Drawing drawing_;
    bool is_empty_ = true;
};

}  // namespace

std::vector<std::string> names_but_seed(std::span<const Variation> varied) {
    const std::vector<std::string> names = names_of(varied);
    return without_seed(names, names);
}

std::vector<Ensemble> ensembles_of(std::size_t runs, std::span<const Variation> varied) {
    const std::vector<std::string> names = names_of(varied);
    std::vector<Ensemble> ensembles;
    std::map<std::vector<std::string>, std::size_t> known;
    for (std::size_t run = 0; run < runs; ++run) {
        auto values = without_seed(values_of_run(varied, run), names);
        const auto [at, is_new] = known.emplace(values, ensembles.size());
        if (is_new) ensembles.push_back({std::move(values), {}});
        ensembles[at->second].runs.push_back(run);
    }
    return ensembles;
}

void add_cells(std::vector<std::string>& row, const Statistics& all) {
    row.insert(row.end(), {fmt::format("{}", all.count), csv_number(all.mean),
                           csv_number(all.deviation), csv_number(all.low), csv_number(all.high)});
}

std::vector<std::string> measured_names(SweepResults results) {
    std::vector<std::string> names;
    for (const std::string_view name : measure::feature_names()) names.emplace_back(name);
    const bool has_cells =
        std::ranges::any_of(results, [](const auto& result) { return result && result->cells; });
    if (!has_cells) return names;
    for (const auto& [name, count] : cell_counts) names.emplace_back(name);
    return names;
}

double measured_number(const std::optional<SweepResult>& result, std::string_view name) {
    if (!result || result->failed()) return none;
    for (const auto& [counted, count] : cell_counts) {
        if (counted != name) continue;
        return result->cells ? static_cast<double>((*result->cells).*count) : none;
    }
    const auto& names = measure::feature_names();
    const auto at = std::ranges::find(names, name) - names.begin();
    return measure::to_array(*result->features)[static_cast<std::size_t>(at)];
}

bool has_ensembles(std::span<const Variation> varied) {
    for (const Variation& each : varied) {
        const std::vector<std::string> names = names_of({&each, 1});
        if (std::ranges::count(names, "seed") > 0) return each.values.size() > 1;
    }
    return false;
}

std::string ensemble_table(SweepResults results, std::span<const Variation> varied) {
    std::vector<std::string> row = names_but_seed(varied);
    row.emplace_back("number");
    row.insert(row.end(), statistics_header.begin(), statistics_header.end());
    std::string table = csv_row(row);
    const std::vector<std::string> measured = measured_names(results);
    for (const Ensemble& each : ensembles_of(results.size(), varied)) {
        for (const std::string& number : measured) {
            if (!has_mean(number)) continue;
            row = each.values;
            row.push_back(number);
            add_cells(row, statistics_in(each, number, results));
            table += csv_row(row);
        }
    }
    return table;
}

Result<void> check_curve(std::string_view number, std::span<const Variation> varied) {
    std::vector<std::string> known;
    for (const std::string_view name : measure::feature_names()) {
        if (has_mean(name)) known.emplace_back(name);
    }
    for (const auto& [name, count] : cell_counts) known.emplace_back(name);
    if (std::ranges::count(known, number) == 0) {
        return failure(fmt::format("a sweep cannot draw a curve of '{}'", number),
                       fmt::format("curves can be drawn of {}", fmt::join(known, ", ")));
    }
    const std::vector<std::string> names = names_but_seed(varied);
    if (names.empty()) {
        return failure("a curve needs a varied name other than the seed",
                       "add a name with numbers, as in --vary feed=0.02..0.06:9");
    }
    std::optional<std::string> unit;
    const std::vector<Ensemble> ensembles = ensembles_of(*count_runs(varied), varied);
    for (const Ensemble& each : ensembles) {
        const auto across = read_with_unit(each.values[0]);
        if (across && !unit) unit = across->unit;
        if (across && std::isfinite(across->number) && across->unit == unit) continue;
        return failure(
            fmt::format("the value '{}' of {} is not a number{}, so it cannot be a point of a "
                        "curve",
                        each.values[0], names[0], across ? " in the unit of the first value" : ""),
            across ? "write all values in the same unit"
                   : "put a name with numbers into the first --vary");
    }
    return {};
}

Drawing draw_curve(std::string_view number, SweepResults results,
                   std::span<const Variation> varied) {
    const std::vector<std::string> names = names_but_seed(varied);
    const auto first = read_with_unit(ensembles_of(1, varied)[0].values[0]);
    std::string across = names[0];
    if (first && !first->unit.empty()) across += fmt::format(" ({})", first->unit);
    return CurvePlot(curves_of(number, results, varied), std::move(across), std::string(number))
        .draw(has_ensembles(varied) ? "mean over seeds and its 95 % interval" : "");
}

}  // namespace cascade
