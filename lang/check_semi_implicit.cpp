#include "lang/check_semi_implicit.h"

#include "lang/diffusion.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::checking {

namespace {

bool has_diffusion(const Program& program, std::uint32_t stage) {
    for (const SpeciesDiffusion& species : diffusion_of(program, stage)) {
        const auto is_there = [](const Formula& factor) { return !factor.nodes.empty(); };
        if (std::any_of(species.begin(), species.end(), is_there)) return true;
    }
    return false;
}

}  // namespace

void check_semi_implicit(const Program& program, std::uint32_t stage, Span span,
                         Diagnostics& diagnostics) {
    const Stage& checked = program.stages[stage];
    const Solver solver = checked.time.solver;
    if (!is_semi_implicit(solver)) return;
    if (program.domain.surface && program.domain.surface->has_metric) {
        diagnostics.error(span, fmt::format("stage '{}': {} needs cells that are squares, and these "
                                            "lie on a surface", checked.name, name_of(solver)),
                          "rkl1 takes long steps there");
    } else if (program.domain.mask) {
        diagnostics.error(span, fmt::format("stage '{}': {} needs all cells of the grid, and the domain has "
                                            "a mask", checked.name, name_of(solver)),
                          "rkl1 takes long steps there");
    } else if (!checked.uniform[program.system_of(stage).frozen_item()]) {
        diagnostics.error(span, fmt::format("stage '{}' freezes cells, which {} cannot: its waves run "
                                            "through all of them", checked.name, name_of(solver)),
                          "rkl1 takes long steps around frozen cells");
    } else if (!has_diffusion(program, stage)) {
        diagnostics.error(span, fmt::format("stage '{}': {} finds no diffusion to take implicitly",
                                            checked.name, name_of(solver)),
                          "it looks for lap, dxx, diffuse or div(k * grad(u)) in the rate of u; "
                          "rk45 takes what comes");
    }
}

}  // namespace cascade::checking
