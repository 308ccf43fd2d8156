// Describes the results of an analysis to users.
#include "analysis/stage_analysis.h"

#include "core/counted.h"
#include "core/with_commas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::analysis {

namespace {

/// The largest number of species whose names are shown.
constexpr Eigen::Index most_named = 6;

/// A text such as "-0.5" or "-0.5 ± 2i".
std::string rate_text(Complex rate, double resolution) {
    const double real = std::abs(rate.real()) < resolution ? 0 : rate.real();
    if (std::abs(rate.imag()) < std::max(resolution, 1e-6 * std::abs(real))) {
        return fmt::format("{:.4g}", real);
    }
    return fmt::format("{:.4g} ± {:.4g}i", real, std::abs(rate.imag()));
}

class StateText {
public:
    StateText(const StageAnalysis& analysis, const StateAnalysis& state)
        : analysis_(analysis),
          state_(state),
          relation_(state.relation),
          lattice_(lattice_of(*analysis.model.program)) {}

    std::string text() {
        text_ =
            fmt::format("\nflat state {}{}\n", values_text(analysis_.model, state_.state.species),
                        state_.state.is_from_start ? " (from the starting values)" : "");
        text_ += fmt::format("  {}\n", verdict());
        line("all cells alike", at_rest());
        if (!analysis_.model.algebra.nodes().empty() && analysis_.model.terms.size() > 1) waves();
        steps();
        return text_;
    }

private:
    void line(std::string_view name, const std::string& words) {
        text_ += fmt::format("  {:<20}{}\n", name, words);
    }

    std::string verdict() const {
        switch (relation_.stability) {
            case Stability::turing:
                return relation_.at_rest.real() < -relation_.resolution
                           ? "Turing: stable if all cells change alike, and standing waves grow"
                           : "standing waves grow; a change that is the same in all cells does not";
            case Stability::wave:
                return "wave: stable if all cells change alike, and moving or oscillating waves grow";
            case Stability::hopf: return "Hopf: all cells together begin to oscillate";
            case Stability::both:
                return "Hopf and Turing: an oscillation of all cells and standing waves grow";
            case Stability::uniform:
                return relation_.fastest.rate.real() > 1.001 * relation_.at_rest.real()
                           ? "unstable: all cells together leave it, and waves grow faster"
                           : "unstable: all cells together leave it";
            default: break;
        }
        const double most = std::max(relation_.at_rest.real(), relation_.fastest.rate.real());
        return most < -relation_.resolution ? "stable: small changes fade, whatever their length"
                                            : "neutral: nothing grows, and not everything fades";
    }

    /// A text such as "fades e-fold in 0.4", followed by the number of steps.
    std::string pace(double real) const {
        if (std::abs(real) <= relation_.resolution) return "neither grows nor fades";
        const double time = 1 / std::abs(real);
        std::string text = fmt::format("{} e-fold in {:.4g}", real > 0 ? "grows" : "fades", time);
        if (analysis_.step) {
            const double steps = std::ceil(time / *analysis_.step);
            text += steps < 1e15
                        ? fmt::format(" ({} steps)", with_commas(static_cast<std::int64_t>(steps)))
                        : "";
        }
        return text;
    }

    std::string at_rest() const {
        std::string text =
            fmt::format("rate {}: {}", rate_text(relation_.at_rest, relation_.resolution),
                        pace(relation_.at_rest.real()));
        const double turns = std::abs(relation_.at_rest.imag());
        if (oscillates(relation_.at_rest, relation_.resolution)) {
            text += fmt::format(", period {:.4g}", 2 * std::numbers::pi / turns);
        }
        return text;
    }

    /// A length in cells, and also in the script's unit of length if this unit is not a cell.
    std::string length(double cells) const {
        if (lattice_.is_continuous && lattice_.spacing == 1) {
            return fmt::format("{:.4g} mean distances of cells", cells);
        }
        if (lattice_.is_continuous)
            return fmt::format("{:.4g} in length", cells * lattice_.spacing);
        return lattice_.spacing == 1
                   ? fmt::format("{:.4g} cells", cells)
                   : fmt::format("{:.4g} cells, {:.4g} in length", cells, cells * lattice_.spacing);
    }

    /// A range of lengths, written as length() does.
    std::string lengths(double least, double most) const {
        const double spacing = lattice_.spacing;
        if (lattice_.is_continuous || spacing == 1) {
            return fmt::format("{:.4g} to {}", least * spacing, length(most));
        }
        return fmt::format("{:.4g} to {:.4g} cells, {:.4g} to {:.4g} in length", least, most,
                           least * spacing, most * spacing);
    }

    std::string direction() const {
        const Direction& d = relation_.fastest.direction;
        if (!relation_.depends_on_direction) return "";
        if (d[2] != 0) return fmt::format(", along ({:.2g}, {:.2g}, {:.2g})", d[0], d[1], d[2]);
        return fmt::format(", with a wave vector at {:.3g} degrees",
                           std::atan2(d[1], d[0]) * 180 / std::numbers::pi);
    }

    /// Whether growth only approaches its maximum as waves become longer and longer.
    bool is_longest() const {
        const double apart = relation_.fastest.rate.real() - relation_.at_rest.real();
        return relation_.fastest.cells() > 1e4 ||
               std::abs(apart) < 1e-4 * std::abs(relation_.at_rest.real());
    }

    void waves() {
        const auto& fastest = relation_.fastest;
        if (is_longest()) {
            line(relation_.has_growing_waves() ? "fastest waves" : "slowest to fade",
                 "longer waves behave more like a uniform state");
            if (!relation_.has_growing_waves()) return;
        } else if (!relation_.has_growing_waves()) {
            line("slowest to fade",
                 fmt::format("{}{}: rate {}, {}", length(fastest.cells()), direction(),
                             rate_text(fastest.rate, relation_.resolution),
                             pace(fastest.rate.real())));
            return;
        }
        std::string bands;
        for (const GrowingBand& band : relation_.bands) {
            const double most = 2 * std::numbers::pi / band.least;
            const double least = 2 * std::numbers::pi / band.most;
            bands += bands.empty() ? "" : ", and ";
            bands +=
                band.least == 0 ? fmt::format("all above {}", length(least)) : lengths(least, most);
        }
        line("growing waves", bands);
        if (is_longest()) return;
        std::string words =
            fmt::format("{}{}: rate {}, {}", length(fastest.cells()), direction(),
                        rate_text(fastest.rate, relation_.resolution), pace(fastest.rate.real()));
        const double turns = std::abs(fastest.rate.imag());
        if (relation_.stability == Stability::wave && turns > 0) {
            words += fmt::format(", moves {:.4g} cells in a unit of time", turns / fastest.phase);
        }
        line("fastest wave", words);
    }

    void steps() {
        if (state_.steps.empty()) return;
        std::string words;
        for (const StableStep& each : state_.steps) {
            if (!std::isfinite(each.step)) return;
            words +=
                fmt::format("{}{} {}", words.empty() ? "" : ", ", cascade::name_of(each.solver),
                            each.step > 0 ? fmt::format("{:.4g}", each.step) : std::string("none"));
        }
        if (analysis_.step) words += fmt::format("; the script takes {:.4g}", *analysis_.step);
        line("longest stable step", words);
    }

    const StageAnalysis& analysis_;
    const StateAnalysis& state_;
    const Dispersion& relation_;
    Lattice lattice_;
    std::string text_;
};

std::string notes(const StageAnalysis& analysis) {
    const LinearModel& model = analysis.model;
    std::string text;
    for (const ItemId item : model.parameters) {
        const StartValue& start = model.starts[item];
        const auto* number = model.algebra[start.value].as<double>();
        const std::string value =
            number != nullptr ? fmt::format(" {:.4g}", *number) : std::string();
        if (start.differs) {
            text += fmt::format("'{}' varies over the domain: its value{} in the middle is used\n",
                                model.system().item_name(item), value);
        } else if (!model.algebra.is_number(start.scatter, 0)) {
            text += fmt::format("'{}' is random: its mean{} is used\n",
                                model.system().item_name(item), value);
        }
    }
    if (model.reads_time) text += "rates depend on time: t = 0 is used\n";
    if (model.has_noise) text += "rates are random: their means are used\n";
    if (analysis.has_conserved_totals) {
        text +=
            "the reaction keeps a total, so flat states come in families: these have the total of "
            "the starting values\n";
    }
    if (model.program->domain.model || lattice_of(*model.program).is_continuous) {
        text += "on a curved surface waves count as those of a plane: lap is -k^2\n";
    }
    return text.empty() ? "" : "\n" + text;
}

}  // namespace

std::string_view name_of(Stability stability) {
    switch (stability) {
        case Stability::turing: return "Turing";
        case Stability::wave: return "wave";
        case Stability::hopf: return "Hopf";
        case Stability::both: return "Hopf and Turing";
        case Stability::uniform: return "unstable";
        default: return "stable";
    }
}

std::string values_text(const LinearModel& model, const Vector& species) {
    std::string text;
    for (Eigen::Index k = 0; k < std::min(species.size(), most_named); ++k) {
        text += fmt::format("{}{} = {:.5g}", k > 0 ? ", " : "",
                            model.system().item_name(model.species[static_cast<std::size_t>(k)]),
                            species[k] + 0.0);  // Removes the sign of -0.
    }
    return text + (species.size() > most_named ? ", …" : "");
}

std::string describe(const StageAnalysis& analysis) {
    const LinearModel& model = analysis.model;
    const std::string name = analysis.model.program->stages[model.stage].name;
    std::string text =
        fmt::format("stage '{}' of {}: {} species, {}\n", name, model.system().name,
                    model.species_count(),
                    analysis.states.empty()
                        ? "no flat state found"
                        : counted(static_cast<std::int64_t>(analysis.states.size()), "flat state"));
    if (!analysis.states.empty() && !analysis.states[0].state.is_from_start) {
        text += "Newton's method finds none from the starting values\n";
    }
    for (const StateAnalysis& state : analysis.states) text += StateText(analysis, state).text();
    return text + notes(analysis);
}

}  // namespace cascade::analysis
