// Checks solvers. A semi-implicit solver needs the diffusion that lang/calculus finds, and a domain
// in which plane waves exist.
#include "lang/check/systems/check_solver.h"

#include "lang/calculus/derivative.h"
#include "lang/calculus/diffusion.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::checking {

namespace {

/// Whether the rate of a species depends on values in its own cell.
bool has_reaction(const LocalJacobian& jacobian) {
    return std::ranges::any_of(jacobian.rows, [&](const auto& row) {
        return std::ranges::any_of(row,
                                   [&](NodeId id) { return !jacobian.algebra.is_number(id, 0); });
    });
}

bool is_there(const Formula& factor) { return !factor.nodes.empty(); }

bool has_diffusion(const IdVector<SpeciesId, SpeciesDiffusion>& diffusion) {
    return std::any_of(diffusion.begin(), diffusion.end(), [](const SpeciesDiffusion& species) {
        return std::any_of(species.begin(), species.end(), is_there);
    });
}

/// Finds a species that has a fixed value or slope at a side and whose rate contains lap(lap(…)) of
/// this species. The inner lap is stored in a plane that is mirrored at sides, so the waves in this
/// plane differ from the waves of the species.
std::optional<SpeciesId> held_and_nested(const Stage& stage,
                                         const IdVector<SpeciesId, SpeciesDiffusion>& diffusion) {
    for (const SpeciesId s : stage.sides.ids()) {
        const bool is_held =
            std::any_of(stage.sides[s].begin(), stage.sides[s].end(),
                        [](const SideSetting& side) { return side.kind == SideKind::fixed; });
        const auto powers = diffusion[s].begin() + laplacian_powers;
        if (is_held && std::any_of(diffusion[s].begin() + 1, powers, is_there)) return s;
    }
    return std::nullopt;
}

}  // namespace

void check_local_solver(const Program& program, std::uint32_t stage, Span span,
                        Diagnostics& diagnostics) {
    const Stage& checked = program.stages[stage];
    if (!is_locally_implicit(checked.time.solver)) return;
    const std::string subject =
        fmt::format("stage '{}': {}", checked.name, name_of(checked.time.solver));
    const std::size_t species = program.system_of(stage).species_count();
    if (species > most_species_in_equations) {
        diagnostics.error(span,
                          fmt::format("{} solves equations of all species in each cell, but {} "
                                      "species are too many: at most {} can be solved",
                                      subject, species, most_species_in_equations),
                          "write solver: rkl2, which takes any number of species");
        return;
    }
    const auto jacobian = local_jacobian(program, stage);
    if (!jacobian) {
        diagnostics.error(span,
                          subject +
                              " needs the derivatives of the rates with respect to the species, "
                              "but one of them cannot be computed",
                          "write solver: rkl2, which takes any rate; thresholds of smoothstep "
                          "and tensors that turn with a species have no derivative");
    } else if (!has_reaction(*jacobian)) {
        diagnostics.error(span, subject + " finds no reaction to treat implicitly",
                          "write solver: rkl2 for rates that contain only diffusion; a reaction "
                          "reads species outside of operators");
    }
}

namespace {

struct Refusal {
    std::string message, hint;
};

/// The reason why a semi-implicit solver cannot compute a stage in the stage's domain; nullopt if
/// it can.
std::optional<Refusal> refusal_of_domain(const Program& program, const Stage& stage) {
    const DomainSettings& domain = program.domain;
    const std::string_view solver = name_of(stage.time.solver);
    if (domain.model) {
        return Refusal{fmt::format("stage '{}': the solver {} works only on a grid, not on a model",
                                   stage.name, solver),
                       "write solver: rkl1, which takes long steps on models"};
    }
    if (domain.surface && domain.surface->has_metric) {
        return Refusal{fmt::format("stage '{}': {} needs square cells, but these cells lie on a "
                                   "surface",
                                   stage.name, solver),
                       "write solver: rkl1, which takes long steps there"};
    }
    if (domain.mask) {
        return Refusal{fmt::format("stage '{}': {} needs all cells of the grid, but the domain "
                                   "has a mask",
                                   stage.name, solver),
                       "write solver: rkl1, which takes long steps there"};
    }
    if (domain.stencil != StencilKind::cross) {
        return Refusal{fmt::format("stage '{}': {} works only with stencil: cross", stage.name,
                                   solver),
                       "write solver: rkl2, which takes long steps with any stencil"};
    }
    return std::nullopt;
}

/// The reason why a semi-implicit solver cannot compute a stage with the stage's system; nullopt if
/// it can.
std::optional<Refusal> refusal_of_system(const Program& program, std::uint32_t number) {
    const Stage& stage = program.stages[number];
    const System& system = program.system_of(number);
    const std::string_view solver = name_of(stage.time.solver);
    if (!stage.uniform[system.frozen_item()]) {
        return Refusal{
            fmt::format("stage '{}' freezes cells, but the solver {} cannot keep cells frozen, "
                        "because it changes all cells together",
                        stage.name, solver),
            "write solver: rkl1, which takes long steps around frozen cells"};
    }
    const auto diffusion = diffusion_of(program, number);
    if (const auto held = held_and_nested(stage, diffusion)) {
        return Refusal{
            fmt::format("stage '{}': {} cannot hold the value of {} at a side, because the rate "
                        "of this species contains lap(lap(…))",
                        stage.name, solver, system.item_name(system.species()[*held])),
            "write solver: rkl1"};
    }
    if (has_diffusion(diffusion)) return std::nullopt;
    return Refusal{
        fmt::format("stage '{}': {} finds no diffusion to treat implicitly", stage.name, solver),
        "write solver: rk45, which takes any rate; diffusion is lap, dxx, diffuse or div(k * "
        "grad(u)) in the rate of u"};
}

}  // namespace

void check_semi_implicit(const Program& program, std::uint32_t stage, Span span,
                         Diagnostics& diagnostics) {
    if (!is_semi_implicit(program.stages[stage].time.solver)) return;
    auto refusal = refusal_of_domain(program, program.stages[stage]);
    if (!refusal) refusal = refusal_of_system(program, stage);
    if (refusal) diagnostics.error(span, refusal->message, refusal->hint);
}

}  // namespace cascade::checking
