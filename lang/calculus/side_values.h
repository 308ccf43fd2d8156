// Turns the rules that scripts give for sides into values and slopes at the faces. These values and
// slopes are used to fill halos.
//
// A flux becomes the slope that causes this flux. A species in a formula means its value at the
// face: the mean of the values in the cell beside the side and in the cell beyond the side. The
// value in the cell beyond depends on the formula's value, so both are found together, by one step
// of Newton's method from the values in the cell. The result is exact if the formula is linear.
// Otherwise its error is of second order in the spacing, like the errors of operators. The method
// also keeps stiff sides stable: as k grows, slope(-k * u) approaches fixed(0).
#pragma once

#include "lang/calculus/diffusion.h"
#include "lang/program/program.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace cascade {

/// The rules at the sides for the species of a stage, without fluxes and definitions. A species in
/// a formula means its value in the cell beside the side. A formula that reads no species is
/// unchanged. All rules must have passed check_side_values().
IdVector<SpeciesId, SideSettings> side_settings(const Program& program, std::uint32_t stage);
/// The rules at the border of a mask for the species of a stage, converted like the rules in
/// side_settings(). Rules for the sides of the grid are returned unchanged.
IdVector<SpeciesId, SideSettings> border_settings(const Program& program, std::uint32_t stage);

/// The factor d in the diffusion d * ∂u/∂n of a species through a side. d is the factor of lap(u),
/// of div(d * grad(u)) or, at sides of the grid, of a second derivative across the side.
struct Conductivity {
    std::optional<Formula> factor;
    /// The reason why there is no factor, as the rest of a sentence that begins with the name of
    /// the species.
    std::string_view why_not;
};
/// `diffusion` must be the result of diffusion_of() for the stage.
Conductivity conductivity_at(const System& system,
                             const IdVector<SpeciesId, SpeciesDiffusion>& diffusion,
                             SpeciesId species, Side side);

/// Whether an operator in some rate reads this species or definition at neighbours.
bool is_read_beside(const System& system, const SideSubject& subject);

/// Whether the formula must be computed whenever the rates are computed, because the formula, or a
/// definition that it reads, reads a species, t or step.
bool changes_at_side(const System& system, const Formula& formula);

/// The first node that reads other cells and may change: an operator or aggregate that depends on a
/// species, t or step. Such a node is not allowed in the value of a side, because the value can
/// read only the cells beside the side. The formula must not contain definitions.
const Node* beyond_reach_of_side(const System& system, const Formula& formula);

/// The species (including `of`) whose values at the face depend on each other through the formulas
/// of a side.
std::vector<SpeciesId> coupled_at_side(const Program& program, std::uint32_t stage, SpeciesId of,
                                       Side side);
/// The largest number of coupled species for which the values at a face are solved.
inline constexpr std::size_t most_coupled_at_side = 16;

}  // namespace cascade
