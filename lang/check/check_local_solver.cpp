// Checks the derivatives within a cell that lang/calculus finds.
#include "lang/check/check_local_solver.h"

#include "lang/calculus/derivative.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace cascade::checking {

namespace {

/// Does a rate depend on the values in its cell?
bool has_reaction(const LocalJacobian& jacobian) {
    return std::ranges::any_of(jacobian.rows, [&](const auto& row) {
        return std::ranges::any_of(row,
                                   [&](NodeId id) { return !jacobian.algebra.is_number(id, 0); });
    });
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
                          fmt::format("{} solves equations of all species in each cell, and {} are "
                                      "too many: at most {}",
                                      subject, species, most_species_in_equations),
                          "rkl2 takes any number of species");
        return;
    }
    const auto jacobian = local_jacobian(program, stage);
    if (!jacobian) {
        diagnostics.error(
            span,
            subject +
                " needs the derivatives of the rates by the species, and there "
                "is no rule for one of them",
            "there is none through the thresholds of smoothstep and tensors that turn "
            "with a species; rkl2 takes any rate");
    } else if (!has_reaction(*jacobian)) {
        diagnostics.error(span, subject + " finds no reaction to take implicitly",
                          "it looks for species in the rates outside of operators; rkl2 takes "
                          "long steps of diffusion");
    }
}

}  // namespace cascade::checking
