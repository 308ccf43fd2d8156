// Checks strictly that no starting value, parameter, side or rate makes cells differ, so that noise
// alone does.
#include "analysis/outlook.h"

#include "analysis/stage_analysis.h"
#include "lang/program/nodes_of_rates.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace cascade::analysis {

namespace {

/// The largest noise that counts as weak, relative to the values. Stronger noise might start a
/// pattern that weak noise does not start.
constexpr double weak = 0.02;

bool has_values_at_sides(const Program& program, std::uint32_t stage) {
    for (const auto& side : program.domain.sides) {
        if (side && takes_value(side->kind)) return true;
    }
    if (!program.stages[stage].definition_sides.empty()) return true;
    for (const auto& sides : program.stages[stage].sides) {
        for (const SideSetting& side : sides) {
            if (takes_value(side.kind)) return true;
        }
    }
    return false;
}

/// Whether noise is the only source of differences between cells.
bool starts_with_noise_alone(const LinearModel& model) {
    if (model.reads_time || model.has_noise) return false;
    const System& system = model.system();
    const StartValue& frozen = model.starts[system.frozen_item()];
    if (frozen.differs || frozen.is_unknown || !model.algebra.is_number(frozen.value, 0)) {
        return false;
    }
    bool has_noise = false;
    const auto is_plain = [&](ItemId item) {
        const StartValue& start = model.starts[item];
        has_noise = has_noise || !model.algebra.is_number(start.scatter, 0);
        return !start.differs && !start.is_unknown;
    };
    for (const ItemId item : model.species) {
        if (!is_plain(item)) return false;
    }
    for (const ItemId item : model.parameters) {
        if (!is_plain(item)) return false;
    }
    return has_noise;
}

/// A quick test before starts_with_noise_alone(). Most stages fail it, because they draw no random
/// numbers or continue from the pattern of an earlier stage.
bool may_start_with_noise(const Program& program, std::uint32_t number) {
    const Stage& stage = program.stages[number];
    const auto is_pattern = [&](const Node& node) {
        const auto* there = node.as<StageItem>();
        return there != nullptr && program.system_of(there->stage).is_species(there->item);
    };
    for (const ItemId item : program.system_of(number).species()) {
        if (holds_in(stage.items[item], is_pattern)) return false;
    }
    return std::any_of(stage.items.begin(), stage.items.end(),
                       [&](const Formula& formula) { return holds_in(formula, is_draw); });
}

bool is_weak(const Vector& scatter, const Vector& state, const Vector& start) {
    const double largest = state.cwiseAbs().maxCoeff();
    const Vector sizes = state.cwiseAbs().cwiseMax(weak * largest);
    for (Eigen::Index k = 0; k < state.size(); ++k) {
        const double most = std::max(weak * sizes[k], 1e-3 * weak);
        if (!(scatter[k] <= most)) return false;
        if (!(std::abs(state[k] - start[k]) <= most)) return false;
    }
    return true;
}

/// Advice to the user: which species needs the least additional diffusion so that a wave grows, and
/// by which factor its diffusion must be multiplied.
std::string remedy(const LinearModel& model, const Matrices& matrices) {
    // The factor would also change terms other than diffusion.
    if (model.has_nonlocal_parts()) return "";
    const auto grows_with = [&](Eigen::Index species, double factor) {
        Matrices scaled = matrices;
        for (std::size_t k = 1; k < scaled.terms.size(); ++k) {
            scaled.terms[k].row(species) *= factor;
        }
        return quick_dispersion(model, scaled).has_growing_waves();
    };
    constexpr double most = 100;
    double least = most;
    std::string name;
    for (Eigen::Index s = 0; s < matrices.terms[0].rows(); ++s) {
        if (!grows_with(s, least * 0.999)) continue;
        double low = 1, high = least;
        for (int round = 0; round < 30; ++round) {
            const double middle = std::sqrt(low * high);
            (grows_with(s, middle) ? high : low) = middle;
        }
        least = high;
        name = model.system().item_name(model.species[static_cast<std::size_t>(s)]);
    }
    if (name.empty()) return "";
    return fmt::format("; one would grow if {} diffused {:.3g} times as fast", name,
                       std::ceil(least * 100) / 100);
}

/// The duration of the stage. Empty if it is not known before the stage runs.
std::optional<double> duration_of(const LinearModel& model) {
    const Stage& stage = model.program->stages[model.stage];
    if (stage.time.duration) return stage.time.duration;
    const std::optional<double> step = fixed_step(model);
    if (!step || stage.time.has_duration() || stage.time.open_end) return std::nullopt;
    return *step * static_cast<double>(stage.iterations);
}

std::string lengths(const Dispersion& relation) {
    const double least = 2 * std::numbers::pi / relation.bands.front().most;
    if (relation.bands.front().least == 0) return fmt::format("above {:.3g} cells", least);
    return fmt::format("{:.3g} to {:.3g} cells", least,
                       2 * std::numbers::pi / relation.bands.front().least);
}

}  // namespace

std::optional<std::string> why_nothing_grows(const Program& program, std::uint32_t stage) {
    if (has_values_at_sides(program, stage) || !may_start_with_noise(program, stage)) {
        return std::nullopt;
    }
    const auto model = linear_model(program, stage);
    if (!model || !starts_with_noise_alone(*model)) return std::nullopt;
    const LocalRates rates(*model);
    const Vector start = rates.start();
    if (!start.allFinite()) return std::nullopt;
    const auto state = flat_state_near(rates, start, conserved_totals(rates));
    if (!state || !is_weak(rates.scatter(), *state, start)) return std::nullopt;
    const Matrices matrices = rates.matrices(*state);
    if (!matrices.are_finite()) return std::nullopt;
    const Dispersion relation = dispersion(*model, matrices);
    if (relation.grows_at_rest()) return std::nullopt;
    const std::string where = values_text(*model, *state);
    const double rate = std::max(relation.fastest.rate.real(), relation.at_rest.real());
    if (!relation.has_growing_waves()) {
        if (!(rate < -1e3 * relation.resolution)) return std::nullopt;
        return fmt::format("no wave grows from its flat state {}: the largest rate is {:.3g}{}",
                           where, rate, remedy(*model, matrices));
    }
    if (const auto fitting = fastest_fitting_wave(*model, matrices);
        fitting && fitting->rate.real() < -1e3 * relation.resolution) {
        return fmt::format(
            "no wave that grows from its flat state {} fits the domain: such waves are {} long",
            where, lengths(relation));
    }
    if (relation.fastest.cells() < 3) {
        return fmt::format(
            "the waves that grow fastest are {:.3g} cells long, too short for the grid",
            relation.fastest.cells());
    }
    if (const auto duration = duration_of(*model);
        duration && *duration * relation.fastest.rate.real() < 1) {
        return fmt::format(
            "it ends before anything can grow from its flat state {}: the fastest wave needs "
            "{:.3g} to grow e-fold, but the stage lasts {:.3g}",
            where, 1 / relation.fastest.rate.real(), *duration);
    }
    return std::nullopt;
}

}  // namespace cascade::analysis
