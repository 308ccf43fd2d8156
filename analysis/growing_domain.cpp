// Analyses the stage at several times. Each time replaces t as a number.
#include "analysis/growing_domain.h"

#include "analysis/stage_analysis.h"
#include "analysis/wave_operators.h"
#include "lang/program/grown_lengths.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::analysis {

namespace {

/// The parts into which the duration of a stage is divided.
constexpr int parts_of_duration = 4;

constexpr std::string_view lengths_name = "lengths";

/// A copy of the program in which the given time replaces `t` in the rates of a stage.
Program at_moment(const Program& program, std::uint32_t stage, double t) {
    Program result = program;
    System& system = result.systems[result.stages[stage].system];
    const auto set = [&](Formula& formula) {
        for (Node& node : formula.nodes) {
            if (node.is(Builtin::t)) node.kind = t;
        }
    };
    for (Definition& each : system.definitions) set(each.formula);
    for (Formula& rate : system.rates) set(rate);
    return result;
}

/// Finds which of the growing waves fit into the domain.
class FittingWaves {
public:
    FittingWaves(const Program& program, double scale)
        : domain_(program.domain), lattice_(lattice_of(program)), scale_(scale) {}

    /// Sets `waves` and `none_fits` of a moment.
    void count(const Dispersion& relation, GrowingMoment& moment) const {
        if (!relation.has_growing_waves() || relation.bands.empty()) return;
        const double low = relation.bands.front().least, high = relation.bands.back().most;
        if (is_surface() && !is_sphere()) {
            moment.waves = {length(high), length(low), length(relation.fastest.phase)};
            return;
        }
        const double least = std::max(1.0, std::ceil(number(low) - 1e-9));
        const double most = std::floor(number(high) + 1e-9);
        moment.none_fits = most < least;
        if (moment.none_fits) return;
        const double fastest = std::round(number(relation.fastest.phase));
        moment.waves = {least, most, std::clamp(fastest, least, most)};
    }

private:
    bool is_surface() const { return domain_.model || domain_.surface; }
    bool is_sphere() const { return domain_.model && domain_.model->shape == ModelShape::sphere; }
    /// The length of waves, infinite at phase 0.
    double length(double phase) const {
        return 2 * std::numbers::pi / phase * lattice_.spacing * scale_;
    }
    /// The number of waves along x with this phase, or the degree l of spherical harmonics, for
    /// which the Laplacian is −l (l + 1) / R².
    double number(double phase) const {
        if (is_sphere()) {
            const double part = phase / lattice_.spacing * *domain_.model->extent / 2;
            return std::sqrt(part * part + 0.25) - 0.5;
        }
        const double cells = static_cast<double>(domain_.grid.width);
        return phase * cells / ((lattice_.is_periodic[0] ? 2 : 1) * std::numbers::pi);
    }

    const DomainSettings& domain_;
    Lattice lattice_;
    double scale_;
};

/// A text such as "3 to 5 half waves grow along x, 4 fastest".
std::string text_of(const GrowingMoment& moment, const DomainSettings& domain) {
    const std::string_view name = counted_waves(domain);
    const bool has_axis = !domain.model && !domain.surface;
    if (!moment.has_state) return "no flat state found";
    if (moment.none_fits) {
        return fmt::format("none of the growing waves fits {}",
                           has_axis ? "along x" : "on the sphere");
    }
    if (!moment.waves) return "no wave grows";
    const auto [least, most, fastest] = *moment.waves;
    if (name == lengths_name) {
        return fmt::format("waves from {:.4g} to {:.4g} long grow, {:.4g} fastest", least, most,
                           fastest);
    }
    if (!has_axis) {
        return least == most ? fmt::format("harmonics of degree {:.0f} grow", least)
                             : fmt::format(
                                   "harmonics of degrees {:.0f} to {:.0f} grow, {:.0f} "
                                   "fastest",
                                   least, most, fastest);
    }
    if (most == 1) {
        return fmt::format("1 {} grows along x", name.substr(0, name.size() - 1));
    }
    return least == most ? fmt::format("{:.0f} {} grow along x", most, name)
                         : fmt::format("{:.0f} to {:.0f} {} grow along x, {:.0f} fastest", least,
                                       most, name, fastest);
}

}  // namespace

std::string_view counted_waves(const DomainSettings& domain) {
    if (domain.model && domain.model->shape == ModelShape::sphere) return "degrees";
    if (domain.model || domain.surface) return lengths_name;
    return domain.grid.boundary.x == Boundary::periodic ? "waves" : "half waves";
}

std::vector<GrowingMoment> moments_of_growing_domain(const Program& program, std::uint32_t stage) {
    const auto end = known_duration(program, stage);
    const DomainSettings& domain = program.domain;
    const bool has_axis = domain.model || domain.surface || domain.grid.width > 1;
    if (!program.stages[stage].growth || !end || !has_axis) return {};
    std::vector<GrowingMoment> moments;
    for (int part = 0; part <= parts_of_duration; ++part) {
        GrowingMoment& moment = moments.emplace_back();
        moment.t = *end * part / parts_of_duration;
        const auto scales = scales_at(program.stages[stage], moment.t);
        for (const GrowingSide& side : growing_sides(domain)) {
            moment.lengths.push_back(side.start * scales[side.axis]);
        }
        const Program now = at_moment(program, stage, moment.t);
        const auto analysis = analyze_stage(now, stage);
        if (!analysis) return {};
        moment.has_state = !analysis->states.empty();
        if (!moment.has_state) continue;
        FittingWaves(program, scales[0]).count(state_to_show(*analysis).relation, moment);
    }
    return moments;
}

std::string waves_of_growing_domain(const Program& program, std::uint32_t stage) {
    const std::vector<GrowingMoment> moments = moments_of_growing_domain(program, stage);
    if (moments.empty()) return "";
    std::string text = "\nas the domain grows\n";
    for (const GrowingMoment& moment : moments) {
        std::vector<std::string> lengths;
        for (const double length : moment.lengths) lengths.push_back(fmt::format("{:.4g}", length));
        text += fmt::format("  {:<20}{}: {}\n", fmt::format("t = {:.4g}", moment.t),
                            fmt::join(lengths, " x "), text_of(moment, program.domain));
    }
    return text;
}

}  // namespace cascade::analysis
