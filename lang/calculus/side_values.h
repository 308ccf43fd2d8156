// What scripts say of sides, as halos are filled by it: values and slopes at the faces.
//
// A flux becomes the slope that carries it. A formula that reads species means their values at the
// face, the mean of the cell beside the side and the one beyond it, and these depend on the formula
// in turn. One step of Newton's method from the values in the cell solves for them: exactly if the
// formula is linear, and otherwise with an error of second order in the spacing, like that of
// operators. It also keeps a stiff side stable: as k grows, slope(-k * u) becomes fixed(0).
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

/// The rules of a stage's species without fluxes and definitions; species in their formulas are
/// those of the cell beside the side. A formula that reads no species stays as it was written. All
/// rules must have passed check_side_values().
IdVector<SpeciesId, SideSettings> side_settings(const Program& program, std::uint32_t stage);
/// The same of the border of a mask; those at the sides are as they were written.
IdVector<SpeciesId, SideSettings> border_settings(const Program& program, std::uint32_t stage);

/// The factor d of a species' diffusion d * ∂u/∂n through a side: that of lap(u), of
/// div(d * grad(u)) or, at sides of the grid, of a second derivative across the side.
struct Conductivity {
    std::optional<Formula> factor;
    std::string_view why_not;  ///< Why there is none, with the species as subject.
};
/// `diffusion` is that of the stage (diffusion_of).
Conductivity conductivity_at(const System& system,
                             const IdVector<SpeciesId, SpeciesDiffusion>& diffusion,
                             SpeciesId species, Side side);

/// Does an operator in some rate read the species or definition at neighbours?
bool is_read_beside(const System& system, const SideSubject& subject);

/// Must the formula be computed whenever the rates are? It reads a species, t or step, in itself or
/// in a definition.
bool changes_at_side(const System& system, const Formula& formula);

/// The first node of a formula without definitions that needs other cells and does not stay the
/// same: an operator or aggregate of a species, t or step. The value of a side knows only cells
/// beside it.
const Node* beyond_reach_of_side(const System& system, const Formula& formula);

/// The species whose values at the face depend on each other through the formulas of a side, `of`
/// among them.
std::vector<SpeciesId> coupled_at_side(const Program& program, std::uint32_t stage, SpeciesId of,
                                       Side side);
/// The most of them for which the equations of the face are solved.
inline constexpr std::size_t most_coupled_at_side = 16;

}  // namespace cascade
