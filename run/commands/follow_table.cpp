// Writes branches of steady states as rows, lines and words.
#include "run/commands/follow_table.h"

#include "core/counted.h"
#include "core/csv.h"
#include "picture/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace cascade {

namespace {

using continuation::Branch;
using continuation::Point;
using continuation::PointKind;

constexpr std::array measures = {"norm", "min", "max", "mean"};

std::string_view word_of(PointKind kind) {
    switch (kind) {
        case PointKind::fold: return "fold";
        case PointKind::branch: return "branch point";
        case PointKind::hopf: return "Hopf point";
        default: return "";
    }
}

Colour colour_of_branch(std::size_t number) {
    constexpr std::array<Colour, 6> colours{{{0.13F, 0.36F, 0.64F},
                                             {0.80F, 0.36F, 0.12F},
                                             {0.17F, 0.55F, 0.30F},
                                             {0.56F, 0.27F, 0.60F},
                                             {0.70F, 0.55F, 0.10F},
                                             {0.35F, 0.35F, 0.38F}}};
    return colours[number % colours.size()];
}

AxisRange widened(double low, double high, std::string name) {
    // Values that differ by rounding alone are one value.
    const double largest = std::max(std::abs(low), std::abs(high));
    const double width = high - low > 1e-9 * largest ? high - low : largest > 0 ? largest : 1;
    return {low - 0.04 * width, high + 0.04 * width, std::move(name)};
}

/// Draws the branches of a diagram.
class BranchPlot {
public:
    BranchPlot(const FollowTable& table, std::size_t number, std::string across)
        : table_(table), number_(number), across_(std::move(across)) {}

    Drawing draw(const std::vector<Branch>& branches, const std::string& title) {
        drawing_.width = width;
        drawing_.height = height;
        drawing_.add(DrawnArea{{0, 0}, width, height, {1, 1, 1}});
        choose_axes(branches);
        for (std::size_t k = 0; k < branches.size(); ++k) draw_branch(branches[k], k);
        for (const Branch& branch : branches) draw_points(branch);
        axes_.draw(drawing_);
        drawing_.add(DrawnText{{axes_.left(), 14}, title, DrawnText::Anchor::start});
        draw_legend();
        return std::move(drawing_);
    }

private:
    static constexpr double width = 640, height = 440;
    static constexpr Colour ink{0.1F, 0.1F, 0.1F}, fold{0.55F, 0.55F, 0.57F},
        hopf{0.78F, 0.13F, 0.16F};

    double value(const Point& point) const { return table_.measured(point.place.state)[number_]; }

    void choose_axes(const std::vector<Branch>& branches) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        double left = infinity, right = -infinity, low = infinity, high = -infinity;
        for (const Branch& branch : branches) {
            for (const Point& point : branch.points) {
                left = std::min(left, point.place.parameter);
                right = std::max(right, point.place.parameter);
                low = std::min(low, value(point));
                high = std::max(high, value(point));
            }
        }
        axes_ = Axes(widened(left, right, across_), widened(low, high, table_.numbers()[number_]),
                     width, height);
    }

    void draw_branch(const Branch& branch, std::size_t number) {
        const auto style_of = [&](const Point& point) { return point.growing.value_or(0) > 0; };
        const auto& points = branch.points;
        for (std::size_t begin = 0; begin + 1 < points.size();) {
            // A special point belongs to both sides, so the point after it decides.
            const bool is_dashed =
                style_of(points[begin + (points[begin].kind != PointKind::regular)]);
            std::vector<double> across{points[begin].place.parameter}, up{value(points[begin])};
            std::size_t end = begin + 1;
            for (; end < points.size(); ++end) {
                across.push_back(points[end].place.parameter);
                up.push_back(value(points[end]));
                if (points[end].kind != PointKind::regular || style_of(points[end]) != is_dashed)
                    break;
            }
            axes_.draw_curve(drawing_, across, up,
                             {{}, colour_of_branch(number), is_dashed ? 1.3 : 2.2, is_dashed});
            begin = end;
        }
    }

    void draw_points(const Branch& branch) {
        for (const Point& point : branch.points) {
            if (point.kind == PointKind::regular) continue;
            const DrawnPoint at = axes_.place(point.place.parameter, value(point));
            drawing_.add(DrawnDisc{at, 3.6,
                                   point.kind == PointKind::fold   ? fold
                                   : point.kind == PointKind::hopf ? hopf
                                                                   : ink});
        }
    }

    void draw_legend() {
        double x = axes_.right();
        const double y = axes_.top() - 11;
        const auto entry = [&](const std::string& words, const auto& draw_sign) {
            x -= 7.0 * static_cast<double>(words.size());
            drawing_.add(DrawnText{{x, y}, words, DrawnText::Anchor::start});
            draw_sign(x - 14);
            x -= 38;
        };
        const auto line = [&](bool is_dashed) {
            return [this, y, is_dashed](double at) {
                drawing_.add(
                    DrawnLine{{{at - 12, y}, {at + 8, y}}, ink, is_dashed ? 1.3 : 2.2, is_dashed});
            };
        };
        const auto disc = [&](Colour colour) {
            return [this, y, colour](double at) {
                drawing_.add(DrawnDisc{{at + 4, y}, 3.6, colour});
            };
        };
        entry("Hopf", disc(hopf));
        entry("branch", disc(ink));
        entry("fold", disc(fold));
        entry("unstable", line(true));
        entry("stable", line(false));
    }

    const FollowTable& table_;
    std::size_t number_;
    std::string across_;
    Axes axes_{{}, {}, width, height};
    Drawing drawing_;
};

std::string exact(double value) { return csv_number(value, Precision::binary64); }

}  // namespace

FollowTable::FollowTable(const Program& program, std::uint32_t stage, ItemId varied) {
    const System& system = program.system_of(stage);
    name_of_varied_ = system.item_name(varied);
    for (const ItemId item : system.species()) {
        species_.emplace_back(system.item_name(item));
        for (const char* measure : measures) {
            numbers_.push_back(fmt::format("{}_{}", measure, species_.back()));
        }
    }
}

Result<std::size_t> FollowTable::find_number(std::string_view name) const {
    for (std::size_t k = 0; k < numbers_.size(); ++k) {
        if (name == numbers_[k] || (k < measures.size() && name == measures[k])) return k;
    }
    return failure(fmt::format("there is no number '{}' of a state", name),
                   fmt::format("the numbers of a state are {}", fmt::join(numbers_, ", ")));
}

std::vector<double> FollowTable::measured(const continuation::Vector& state) const {
    const auto count = static_cast<continuation::Index>(species_.size());
    const continuation::Index cells = state.size() / count;
    std::vector<double> numbers;
    for (continuation::Index s = 0; s < count; ++s) {
        double squares = 0, sum = 0;
        double least = state[s], most = state[s];
        for (continuation::Index k = 0; k < cells; ++k) {
            const double value = state[k * count + s];
            squares += value * value;
            sum += value;
            least = std::min(least, value);
            most = std::max(most, value);
        }
        const auto total = static_cast<double>(cells);
        numbers.insert(numbers.end(), {std::sqrt(squares / total), least, most, sum / total});
    }
    return numbers;
}

std::string FollowTable::csv(const std::vector<Branch>& branches) const {
    std::vector<std::string> head{"branch", "point", "kind", name_of_varied_};
    head.insert(head.end(), numbers_.begin(), numbers_.end());
    for (const char* name : {"stable", "growing", "rate", "frequency"}) head.emplace_back(name);
    std::string text = csv_row(head);
    for (std::size_t b = 0; b < branches.size(); ++b) {
        for (std::size_t k = 0; k < branches[b].points.size(); ++k) {
            const Point& point = branches[b].points[k];
            std::vector<std::string> row{std::to_string(b + 1), std::to_string(k + 1),
                                         std::string(word_of(point.kind)),
                                         exact(point.place.parameter)};
            for (const double number : measured(point.place.state)) row.push_back(exact(number));
            if (point.growing && !point.leading.empty()) {
                const auto& [rate, frequency] =
                    std::pair(point.leading[0].real(), point.leading[0].imag());
                row.insert(row.end(),
                           {*point.growing == 0 ? "1" : "0", std::to_string(*point.growing),
                            csv_number(rate), csv_number(std::abs(frequency))});
            } else {
                row.resize(head.size());
            }
            text += csv_row(row);
        }
    }
    return text;
}

std::string FollowTable::words(const std::vector<Branch>& branches) const {
    std::string text;
    for (std::size_t b = 0; b < branches.size(); ++b) {
        const Branch& branch = branches[b];
        text += fmt::format("branch {}: {}", b + 1, counted(branch.points.size(), "point"));
        if (branch.from) {
            text += fmt::format(", from point {} of branch {}", branch.from->second + 1,
                                branch.from->first + 1);
        }
        text += "\n";
        for (std::size_t k = 0; k < branch.points.size(); ++k) {
            const Point& point = branch.points[k];
            if (point.kind == PointKind::regular) continue;
            const std::string crossing =
                point.kind == PointKind::branch && point.crossing > 1
                    ? fmt::format(", {} at once", counted(point.crossing, "eigenvalue"))
                    : std::string();
            text += fmt::format("  point {}: {} at {} = {:.7g}, {} = {:.6g}{}\n", k + 1,
                                word_of(point.kind), name_of_varied_, point.place.parameter,
                                numbers_[0], measured(point.place.state)[0], crossing);
        }
        if (!branch.begins.empty()) {
            text += fmt::format("  begins at {} = {:.6g}: {}\n", name_of_varied_,
                                branch.points.front().place.parameter, branch.begins);
        }
        text += fmt::format("  ends at {} = {:.6g}: {}\n", name_of_varied_,
                            branch.points.back().place.parameter, branch.ends);
    }
    return text;
}

Drawing FollowTable::diagram(const std::vector<Branch>& branches, std::size_t number,
                             const std::string& title) const {
    return BranchPlot(*this, number, name_of_varied_).draw(branches, title);
}

}  // namespace cascade
