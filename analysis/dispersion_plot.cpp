// Chooses the ranges of both axes, and draws curves and the legend.
#include "analysis/dispersion_plot.h"

#include "picture/axes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::analysis {

namespace {

constexpr double width = 640, height = 420;
constexpr Colour growth_colour{0.13F, 0.36F, 0.64F};
constexpr Colour turning_colour{0.80F, 0.36F, 0.12F};
constexpr Colour second_colour{0.55F, 0.55F, 0.57F};
constexpr Colour band_colour{0.87F, 0.93F, 0.98F};

class Plot {
public:
    explicit Plot(const StageAnalysis& analysis)
        : analysis_(analysis),
          relation_(state_to_show(analysis).relation),
          per_phase_(1 / lattice_of(*analysis.model.program).spacing),
          axes_({}, {}, width, height) {
        const auto append = [](const Branch& curve, auto&& add) {
            for (std::size_t k = 0; k < curve.phases.size(); ++k) add(k);
        };
        numbers_.push_back(0);
        real_.push_back(relation_.at_rest.real());
        turning_.push_back(std::abs(relation_.at_rest.imag()));
        const double nan = std::numeric_limits<double>::quiet_NaN();
        second_.push_back(nan);
        append(relation_.curve, [&](std::size_t k) {
            numbers_.push_back(relation_.curve.phases[k] * per_phase_);
            real_.push_back(relation_.curve.largest[k].real());
            turning_.push_back(std::abs(relation_.curve.largest[k].imag()));
            second_.push_back(relation_.curve.second[k].real());
        });
        const double most_turning = *std::max_element(turning_.begin(), turning_.end());
        turns_ = most_turning > relation_.resolution;
        choose_ranges(most_turning);
    }

    Drawing draw() {
        drawing_.width = width;
        drawing_.height = height;
        drawing_.add(DrawnArea{{0, 0}, width, height, {1, 1, 1}});
        draw_bands();
        drawing_.add(
            DrawnLine{{axes_.place(0, 0), axes_.place(most_number_, 0)}, second_colour, 1, false});
        axes_.draw_curve(drawing_, numbers_, second_, {{}, second_colour, 1.2, false});
        if (turns_) axes_.draw_curve(drawing_, numbers_, turning_, {{}, turning_colour, 1.5, true});
        axes_.draw_curve(drawing_, numbers_, real_, {{}, growth_colour, 2, false});
        draw_fastest();
        axes_.draw(drawing_);
        draw_legend();
        const std::string title =
            fmt::format("{}, stage '{}': {}", analysis_.model.system().name,
                        analysis_.model.program->stages[analysis_.model.stage].name,
                        name_of(relation_.stability));
        text({axes_.left(), 14}, title, DrawnText::Anchor::start);
        return std::move(drawing_);
    }

private:
    void choose_ranges(double most_turning) {
        most_number_ = numbers_.back();
        if (!relation_.bands.empty()) {
            const double end = relation_.bands.back().most * per_phase_;
            most_number_ = std::min(most_number_, 1.5 * end);
        }
        double low = 0, high = 0;
        for (std::size_t k = 0; k < numbers_.size() && numbers_[k] <= most_number_; ++k) {
            low = std::min(low, real_[k]);
            high = std::max(high, real_[k]);
        }
        if (turns_) high = std::max(high, most_turning);
        for (std::size_t k = 0; k < numbers_.size() && numbers_[k] <= most_number_; ++k) {
            shows_second_ = shows_second_ || second_[k] > std::max(low, -1.5 * high);
        }
        // The depth of valleys is limited. Otherwise the small rates of growing waves could not be
        // distinguished from 0.
        if (relation_.has_growing_waves() || relation_.grows_at_rest())
            low = std::max(low, -1.5 * high);
        if (high - low <= 0) high = 1;
        const double margin = 0.08 * (high - low);
        axes_ = Axes({0, most_number_, "wave number k (2 pi / wavelength)"},
                     {low < 0 ? low - margin : -margin, high + margin, "rate of growth"}, width,
                     height);
    }

    void text(DrawnPoint place, std::string words, DrawnText::Anchor anchor) {
        drawing_.add(DrawnText{place, std::move(words), anchor});
    }

    void draw_bands() {
        for (const GrowingBand& band : relation_.bands) {
            const double left = axes_.place(band.least * per_phase_, 0)[0];
            const double right = axes_.place(std::min(band.most * per_phase_, most_number_), 0)[0];
            drawing_.add(DrawnArea{
                {left, axes_.top()}, right - left, axes_.bottom() - axes_.top(), band_colour});
        }
    }

    void draw_fastest() {
        const GrowingWave& fastest = relation_.fastest;
        if (!relation_.has_growing_waves()) return;
        const DrawnPoint at = axes_.place(fastest.phase * per_phase_, fastest.rate.real());
        drawing_.add(DrawnLine{{at, {at[0], axes_.bottom()}}, growth_colour, 1, true});
        drawing_.add(DrawnDisc{at, 3.5, growth_colour});
        const bool is_left = at[0] < axes_.right() - 160;
        text({at[0] + (is_left ? 7 : -7), axes_.bottom() - 12},
             fmt::format("{:.4g} cells", fastest.cells()),
             is_left ? DrawnText::Anchor::start : DrawnText::Anchor::end);
    }

    /// Draws the entries of the legend side by side, at the right above the box.
    void draw_legend() {
        struct Entry {
            std::string words;
            DrawnLine style;
        };
        std::vector<Entry> entries{{"real part", {{}, growth_colour, 2, false}}};
        if (turns_) entries.push_back({"imaginary part", {{}, turning_colour, 1.5, true}});
        if (shows_second_) {
            entries.push_back({"next rate", {{}, second_colour, 1.2, false}});
        }
        if (!relation_.bands.empty()) entries.push_back({"grows", {{}, band_colour, 0, false}});
        double x = axes_.right();
        const double y = axes_.top() - 11;
        for (auto entry = entries.rbegin(); entry != entries.rend(); ++entry) {
            x -= 7.0 * static_cast<double>(entry->words.size());
            text({x, y}, entry->words, DrawnText::Anchor::start);
            if (entry->style.width > 0) {
                entry->style.points = {{x - 26, y}, {x - 6, y}};
                drawing_.add(entry->style);
            } else {
                drawing_.add(DrawnArea{{x - 26, y - 5}, 20, 10, entry->style.colour});
            }
            x -= 38;
        }
    }

    const StageAnalysis& analysis_;
    const Dispersion& relation_;
    double per_phase_;  ///< Converts phases to wave numbers, in the script's unit of length.
    std::vector<double> numbers_, real_, turning_, second_;
    bool turns_ = false, shows_second_ = false;
    double most_number_ = 0;
    Axes axes_;
    Drawing drawing_;
};

}  // namespace

Drawing plot_dispersion(const StageAnalysis& analysis) { return Plot(analysis).draw(); }

}  // namespace cascade::analysis
