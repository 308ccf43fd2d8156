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

/// The species that the loop itself knows, by their number.
struct TissueSpecies {
    std::size_t place = 0;  ///< The first of three components.
    std::size_t radius = 3;
    bool crawls = true;  ///< Positions have rates.
    /// Species that never come to rest, such as the age. They do not count for steadiness.
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

/// Passes that compute values of cells: they read the species in register 0 and write plane k of
/// register 1.
struct CellValues {
    const StepProblem* problem = nullptr;  ///< Null: there are no such values.
    std::size_t count = 0;                 ///< Planes in register 1.
    /// A cell's values depend only on its own species and what it senses: neither on other cells
    /// nor on the time.
    bool is_of_cell_alone = false;
};

/// The passes of a step.
struct TissueStep {
    const StepProblem* problem = nullptr;
    std::vector<RegisterId> states;  ///< The scheme's state_registers().
};

/// The registers at which the sweeps of a scheme evaluate rates, including the old step.
std::vector<RegisterId> state_registers(const Scheme& scheme);

/// The equations of a tissue as passes over its planes. Problems need not be told the number of
/// cells, which changes without bind(). They stay in memory until the next bind().
class TissueRules {
public:
    virtual ~TissueRules() = default;

    /// Called first, and again when tissue.grid() has changed. Binds passes to it, to the addresses
    /// of `links`, of the plane of numbers and of the mask of the cells.
    virtual void bind(const Tissue& tissue, const Links& links) = 0;

    /// A step, with this number of stages if the solver is stabilised. It has an error register if
    /// the error chooses the steps.
    virtual TissueStep step(std::uint32_t stages) = 0;
    /// The rates of all species.
    virtual CellValues rates() = 0;

    /// Conditions, which hold where the value is above 0.
    struct Conditions {
        CellValues values;
        std::optional<std::size_t> divide, die;  ///< Their planes.
    };
    virtual Conditions conditions() = 0;

    /// The first of three planes with the direction of division, of any length, for a dividing
    /// cell. Without it, or where the direction is 0, cells divide at random in the tangent plane.
    virtual CellValues along() = 0;

    /// Values after a division, by the same formulas for both cells. Evaluated when the new cells
    /// have their positions and still all values of their mothers.
    struct Restarts {
        CellValues values;
        /// Plane k is the new value of species[k]. Indices beyond the species refer to
        /// Tissue::kept.
        std::vector<std::size_t> species;
    };
    virtual Restarts restarts() = 0;
};

}  // namespace cascade
