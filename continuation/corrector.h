// Newton's method for a state and its parameter together.
#pragma once

#include "continuation/decompositions.h"
#include "continuation/steady_problem.h"

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace cascade::continuation {

/// A state with its parameter.
struct Place {
    Vector state;
    double parameter = 0;
};

/// A direction in the space of states and parameters.
using Direction = Place;

/// The direction of a branch at one of its points.
struct Tangent : Direction {
    /// The sign of the determinant of the matrix of all equations, including a row for the tangent.
    /// Along a branch, the sign changes where another branch meets this one, but not where the
    /// branch turns back (H. B. Keller, 1977). Only signs at points with equal `freedoms` can be
    /// compared.
    int orientation = 1;
    Index freedoms = 0;

    void reverse() {
        state *= -1;
        parameter *= -1;
        orientation *= -1;
    }
};

/// Measures lengths of directions. A change of all species by their usual sizes in all cells has
/// length 1, and so has a change of the parameter by its whole range.
struct Scales {
    Vector weights;        ///< The weights of the squares of the unknowns in a squared length.
    double parameter = 1;  ///< The weight of the parameter's square in a squared length.

    double product(const Direction& a, const Direction& b) const {
        return (a.state.array() * weights.array() * b.state.array()).sum() +
               parameter * a.parameter * b.parameter;
    }
    double length(const Direction& direction) const {
        return std::sqrt(product(direction, direction));
    }
    void normalise(Direction& direction) const;
};

/// The equations that determine a steady state, besides the rates. A steady state remains steady
/// when it is moved, and if the reaction conserves totals, there is a steady state for each total.
/// Each such freedom gets an equation that chooses one of the states, and an unknown that is 0 in a
/// steady state.
struct Freedoms {
    Matrix columns;  ///< For each freedom, the effect of its unknown on the rates.
    Matrix rows;     ///< One equation per row: its product with a change of the state is 0.
    Index count() const { return columns.cols(); }
};

class Corrector {
public:
    Corrector(SteadyProblem& problem, Scales scales)
        : problem_(problem), scales_(std::move(scales)) {}

    const Scales& scales() const { return scales_; }
    SteadyProblem& problem() { return problem_; }
    /// Whether translations and rotations count as freedoms. They do not count if the grid itself
    /// holds patterns in their places.
    void hold_motions(bool hold) { holds_motions_ = hold; }
    /// Sets the totals that no rate changes. They are the same at each place on the branch.
    void keep_totals(Matrix totals) { totals_ = std::move(totals); }

    Freedoms freedoms_at(const Place& place) const;

    struct Solved {
        Place place;
        Linearised at;
        int rounds = 0;
        /// The largest rate that the freedoms leave at this place, as a multiple of
        /// size_of_rates().
        double drift = 0;
    };
    /// The place near `guess` where all rates are 0, in the plane through `guess` that is
    /// perpendicular to `direction`. Empty if the iteration does not converge.
    std::optional<Solved> solve(const Place& guess, const Direction& direction);
    /// The tangent of the branch at a solved place. It has length 1 and points to the same side as
    /// `direction`. Empty if it cannot be computed.
    std::optional<Tangent> tangent(const Solved& at, const Direction& direction) const;
    /// The neutral modes at a solved place, which do not count for stability.
    std::vector<NeutralMode> neutral_modes(const Solved& at) const;

private:
    SparseColumns whole(const Linearised& at, const Freedoms& freedoms,
                        const Direction& direction) const;
    double size_of_rates(const Linearised& at, const Vector& state) const;

    SteadyProblem& problem_;
    Scales scales_;
    bool holds_motions_ = true;
    Matrix totals_;
};

}  // namespace cascade::continuation
