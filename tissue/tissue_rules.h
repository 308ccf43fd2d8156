// The interface between a tissue's time loop and its equations.
#pragma once

#include "core/links.h"
#include "core/vector3.h"
#include "solvers/scheme.h"
#include "solvers/step_problem.h"
#include "tissue/tissue.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace cascade {

/// The species that the time loop uses, by their number.
struct TissueSpecies {
    std::size_t place = 0;  ///< The first of the three components of the position.
    std::size_t radius = 3;
    bool crawls = true;  ///< Whether positions have rates, so that cells move.
    /// Species that never come to rest, such as the age. Tests for rest ignore them.
    std::vector<std::size_t> restless;
};

/// The position of a cell in some state of the tissue.
inline Vector3d place_in(const std::vector<Field>& state, const Tissue& tissue,
                         const TissueSpecies& species, std::size_t cell) {
    return {value_in(state[species.place], tissue, cell),
            value_in(state[species.place + 1], tissue, cell),
            value_in(state[species.place + 2], tissue, cell)};
}
/// The position of a cell in the present state.
inline Vector3d place_of(const Tissue& tissue, const TissueSpecies& species, std::size_t cell) {
    return place_in(tissue.species, tissue, species, cell);
}

/// Passes that compute values of cells. The passes read the species in register 0 and write value k
/// to plane k of register 1.
struct CellValues {
    const StepProblem* problem = nullptr;  ///< Null if there are no such values.
    std::size_t count = 0;                 ///< The number of planes in register 1.
    /// Whether a cell's values depend only on its own species and on the values that it senses, not
    /// on other cells or the time.
    bool is_of_cell_alone = false;
};

/// The passes of a step.
struct TissueStep {
    const StepProblem* problem = nullptr;
    std::vector<RegisterId> states;  ///< The result of state_registers() for the scheme.
};

/// The registers with the states in which a scheme's sweeps evaluate rates. These states include
/// the beginning of the step.
std::vector<RegisterId> state_registers(const Scheme& scheme);

/// The equations of a tissue as passes over its planes. The problems returned below stay valid
/// until the next bind(). These problems do not contain the number of cells, which may change
/// without bind().
class TissueRules {
public:
    virtual ~TissueRules() = default;

    /// Called first, and again when tissue.grid() has changed. Binds passes to the new grid and to
    /// the addresses of `links`, of the plane of numbers and of the mask of the cells.
    virtual void bind(const Tissue& tissue, const Links& links) = 0;

    /// The passes of a step. `stages` is the number of stages of a step if the solver is
    /// stabilised. The step has an error register if the error determines the length of steps.
    virtual TissueStep step(std::uint32_t stages) = 0;
    /// The rates of all species.
    virtual CellValues rates() = 0;

    /// The conditions of division and death. A condition holds where its value is above 0.
    struct Conditions {
        CellValues values;
        std::optional<std::size_t> divide, die;  ///< The planes of the two conditions.
    };
    virtual Conditions conditions() = 0;

    /// The direction of division of each dividing cell, of any length, in three planes. If there
    /// are no such values, or if the direction is 0, a cell divides in a random direction of the
    /// tangent plane.
    virtual CellValues along() = 0;

    /// The values that both cells get after a division, by the same formulas for both. The formulas
    /// are evaluated when the new cells are already at their positions but still have all values of
    /// their mothers.
    struct Restarts {
        CellValues values;
        /// Plane k is the new value of species[k]. Indices beyond the species refer to
        /// Tissue::kept.
        std::vector<std::size_t> species;
    };
    virtual Restarts restarts() = 0;
};

}  // namespace cascade
