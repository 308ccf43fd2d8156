// Takes colours that colour-blind readers can distinguish (M. Okabe, K. Ito, "Color Universal
// Design").
#include "analysis/map_plot.h"

#include "picture/axes.h"

#include <algorithm>

namespace cascade::analysis {

namespace {

constexpr double map_width = 640, map_height = 560;

Colour colour_of(const std::optional<Stability>& stability) {
    if (!stability) return {0.80F, 0.80F, 0.80F};
    switch (*stability) {
        case Stability::turing: return {0.34F, 0.71F, 0.91F};
        case Stability::wave: return {0.00F, 0.62F, 0.45F};
        case Stability::hopf: return {0.90F, 0.62F, 0.00F};
        case Stability::both: return {0.80F, 0.47F, 0.65F};
        case Stability::uniform: return {0.84F, 0.37F, 0.00F};
        default: return {0.97F, 0.97F, 0.95F};
    }
}

std::string words_of(const std::optional<Stability>& stability) {
    return stability ? std::string(name_of(*stability)) : "no flat state";
}

}  // namespace

Drawing plot_map(const ParameterMap& map, const MapLabels& labels) {
    Drawing drawing{map_width, map_height, {}};
    drawing.add(DrawnArea{{0, 0}, map_width, map_height, {1, 1, 1}});
    const Axes axes({map.across.low, map.across.high, labels.across},
                    {map.up.low, map.up.high, labels.up}, map_width, map_height);
    const auto side = static_cast<std::int64_t>(map.side);
    Image image(side, side);
    std::vector<std::optional<Stability>> classes;
    for (std::int64_t y = 0; y < side; ++y) {
        for (std::int64_t x = 0; x < side; ++x) {
            const auto& stability = map.classes[static_cast<std::size_t>(y * side + x)];
            image.at(x, side - 1 - y) = colour_of(stability);
            if (std::find(classes.begin(), classes.end(), stability) == classes.end()) {
                classes.push_back(stability);
            }
        }
    }
    drawing.add(DrawnImage{{axes.left(), axes.top()},
                           axes.right() - axes.left(),
                           axes.bottom() - axes.top(),
                           std::move(image)});
    const auto [a, b] = labels.present;
    if (a >= map.across.low && a <= map.across.high && b >= map.up.low && b <= map.up.high) {
        drawing.add(DrawnDisc{axes.place(a, b), 5, {1, 1, 1}});
        drawing.add(DrawnDisc{axes.place(a, b), 3.5, axis_ink});
    }
    axes.draw(drawing);
    std::sort(classes.begin(), classes.end());
    double x = axes.right();
    const double y = axes.top() - 11;
    for (auto each = classes.rbegin(); each != classes.rend(); ++each) {
        const std::string words = words_of(*each);
        x -= 7.0 * static_cast<double>(words.size());
        drawing.add(DrawnText{{x, y}, words, DrawnText::Anchor::start});
        drawing.add(DrawnArea{{x - 18, y - 6}, 13, 13, axis_ink});
        drawing.add(DrawnArea{{x - 17, y - 5}, 11, 11, colour_of(*each)});
        x -= 30;
    }
    drawing.add(DrawnText{{axes.left(), 14}, labels.title, DrawnText::Anchor::start});
    return drawing;
}

}  // namespace cascade::analysis
