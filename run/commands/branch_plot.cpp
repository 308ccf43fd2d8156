// Draws the curves, the special points, and the pictures in a strip below the diagram.
#include "run/commands/branch_plot.h"

#include "picture/axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace cascade {

namespace {

using continuation::Branch;
using continuation::Point;
using continuation::PointKind;

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
    // Values that differ only by rounding count as one value.
    const double largest = std::max(std::abs(low), std::abs(high));
    const double width = high - low > 1e-9 * largest ? high - low : largest > 0 ? largest : 1;
    return {low - 0.04 * width, high + 0.04 * width, std::move(name)};
}

/// The state of a picture below the diagram, and the state's position in the diagram.
struct Chosen {
    const Point* point;
    DrawnPoint at;
};

/// Draws the branches of a diagram.
class BranchPlot {
public:
    BranchPlot(const BranchPlotText& text, const StatePictures& pictures)
        : text_(text), pictures_(pictures) {}

    Drawing draw(const std::vector<Branch>& branches) {
        choose_axes(branches);
        choose_states(branches);
        drawing_.width = width;
        drawing_.height = height + (chosen_.empty() ? 0 : strip);
        drawing_.add(DrawnArea{{0, 0}, width, drawing_.height, {1, 1, 1}});
        for (std::size_t k = 0; k < branches.size(); ++k) draw_branch(branches[k], k);
        for (const Branch& branch : branches) draw_points(branch);
        axes_.draw(drawing_);
        drawing_.add(DrawnText{{axes_.left(), 14}, text_.title, DrawnText::Anchor::start});
        draw_legend();
        draw_states();
        return std::move(drawing_);
    }

private:
    static constexpr double width = 640, height = 440, strip = 112;
    static constexpr Colour ink{0.1F, 0.1F, 0.1F}, fold{0.55F, 0.55F, 0.57F},
        hopf{0.78F, 0.13F, 0.16F};

    double value(const Point& point) const {
        return text_.table.measured(point.place.state)[text_.up];
    }

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
        axes_ = Axes(widened(left, right, text_.across),
                     widened(low, high, text_.table.numbers()[text_.up]), width, height);
    }

    void draw_branch(const Branch& branch, std::size_t number) {
        const auto style_of = [&](const Point& point) { return point.growing.value_or(0) > 0; };
        const auto& points = branch.points;
        for (std::size_t begin = 0; begin + 1 < points.size();) {
            // A special point belongs to the curves on both of its sides, so it does not say
            // whether the states of the next curve are stable. The point after it does.
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

    /// Returns the values of the first species.
    continuation::Values first_of(const Point& point) const {
        const auto count = static_cast<Eigen::Index>(text_.table.species().size());
        return point.place.state(Eigen::seq(0, Eigen::last, count)).array();
    }

    /// Chooses states at equal distances along the parts of curves whose states are patterns.
    void choose_states(const std::vector<Branch>& branches) {
        if (pictures_.count == 0 || pictures_.cells.links != nullptr) return;
        std::vector<std::pair<double, Chosen>> along;
        double length = 0;
        for (const Branch& branch : branches) {
            std::optional<DrawnPoint> before;
            for (const Point& point : branch.points) {
                const continuation::Values values = first_of(point);
                const double range = values.maxCoeff() - values.minCoeff();
                const DrawnPoint at = axes_.place(point.place.parameter, value(point));
                const bool is_pattern = range > 1e-3 * values.abs().maxCoeff() && range > 1e-6;
                if (before && is_pattern) {
                    length += std::hypot(at[0] - (*before)[0], at[1] - (*before)[1]);
                    along.emplace_back(length, Chosen{&point, at});
                }
                before = at;
            }
        }
        const std::size_t count = std::min(pictures_.count, along.size());
        for (std::size_t k = 0; k < count; ++k) {
            const double wanted =
                length * (static_cast<double>(k) + 0.5) / static_cast<double>(count);
            const auto distance = [&](const auto& each) { return std::abs(each.first - wanted); };
            const Chosen& nearest = std::ranges::min_element(along, {}, distance)->second;
            const auto is_same = [&](const Chosen& each) { return each.point == nearest.point; };
            if (std::ranges::none_of(chosen_, is_same)) chosen_.push_back(nearest);
        }
    }

    /// Draws the picture of a state in a box, with the range of values that all pictures share.
    void draw_state(const Point& point, const AxisBox& box, double low, double high) {
        const Grid& grid = pictures_.cells.grid;
        const continuation::Values values = first_of(point);
        const std::array lengths{grid.width, grid.height, grid.depth};
        std::vector<std::size_t> axes;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (lengths[axis] > 1) axes.push_back(axis);
        }
        const auto share = [&](double number) {
            return high > low ? (number - low) / (high - low) : 0.5;
        };
        if (axes.size() < 2) {
            DrawnLine line{{}, colour_of_branch(0), 1.2, false};
            const double step = (box.right - box.left) / static_cast<double>(values.size() - 1);
            for (Eigen::Index k = 0; k < values.size(); ++k) {
                const double up = 0.06 + 0.88 * share(values[k]);
                line.points.push_back({box.left + step * static_cast<double>(k),
                                       box.bottom - (box.bottom - box.top) * up});
            }
            drawing_.add(std::move(line));
            draw_frame(drawing_, box);
            return;
        }
        const std::int64_t across = lengths[axes[0]], down = lengths[axes[1]];
        Image image(across, down);
        const std::int64_t first = axes.size() > 2 ? across * down * (grid.depth / 2) : 0;
        const std::vector<bool>& inside = pictures_.cells.inside;
        Eigen::Index number = 0;
        for (std::int64_t k = 0; k < grid.cell_count(); ++k) {
            const bool is_cell = inside.empty() || inside[static_cast<std::size_t>(k)];
            if (k >= first && k < first + across * down) {
                image.pixels[static_cast<std::size_t>(k - first)] =
                    is_cell ? colour_at(*find_palette("viridis"), share(values[number]))
                            : pure_white;
            }
            number += is_cell ? 1 : 0;
        }
        const double scale = std::min((box.right - box.left) / static_cast<double>(across),
                                      (box.bottom - box.top) / static_cast<double>(down));
        const double wide = scale * static_cast<double>(across),
                     high_of = scale * static_cast<double>(down);
        drawing_.add(DrawnImage{
            {(box.left + box.right - wide) / 2, box.top}, wide, high_of, std::move(image)});
    }

    void draw_states() {
        if (chosen_.empty()) return;
        double low = std::numeric_limits<double>::infinity(), high = -low;
        for (const Chosen& each : chosen_) {
            low = std::min(low, first_of(*each.point).minCoeff());
            high = std::max(high, first_of(*each.point).maxCoeff());
        }
        constexpr double gap = 14;
        const auto count = static_cast<double>(pictures_.count);
        const double wide = std::min(120.0, (axes_.right() - axes_.left() + gap) / count - gap);
        for (std::size_t k = 0; k < chosen_.size(); ++k) {
            const std::string letter(1, static_cast<char>('a' + k));
            const double left = axes_.left() + static_cast<double>(k) * (wide + gap);
            const AxisBox box{left, height + 14, left + wide, height + 14 + 0.8 * wide};
            draw_state(*chosen_[k].point, box, low, high);
            drawing_.add(
                DrawnText{{left + wide / 2, box.bottom + 11}, letter, DrawnText::Anchor::middle});
            const auto [x, y] = chosen_[k].at;
            drawing_.add(DrawnDisc{{x, y}, 2.2, ink});
            drawing_.add(DrawnText{{x + 6, y - 8}, letter, DrawnText::Anchor::start});
        }
    }

    const BranchPlotText& text_;
    const StatePictures& pictures_;
    std::vector<Chosen> chosen_;
    Axes axes_{{}, {}, width, height};
    Drawing drawing_;
};

}  // namespace

Drawing draw_branches(const BranchPlotText& text, const std::vector<Branch>& branches,
                      const StatePictures& pictures) {
    return BranchPlot(text, pictures).draw(branches);
}

}  // namespace cascade
