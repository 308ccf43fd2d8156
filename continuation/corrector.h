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
    /// The sign of the determinant of the equations with a row for the tangent. Along a branch it
    /// changes where another branch meets this one, not where the branch turns back (H. B. Keller,
    /// 1977). It is compared between points with the same number of freedoms.
    int orientation = 1;
    Index freedoms = 0;

    void reverse() {
        state *= -1;
        parameter *= -1;
        orientation *= -1;
    }
};

/// Measures lengths of directions. A length of 1 is the usual size of each species in all cells, or
/// the whole range of the parameter.
struct Scales {
    Vector weights;        ///< Of the squares of the unknowns.
    double parameter = 1;  ///< The weight of the parameter's square.

    double product(const Direction& a, const Direction& b) const {
        return (a.state.array() * weights.array() * b.state.array()).sum() +
               parameter * a.parameter * b.parameter;
    }
    double length(const Direction& direction) const {
        return std::sqrt(product(direction, direction));
    }
    void normalise(Direction& direction) const;
};

/// The equations that a state needs besides its rates. A state that is moved is another state, and
/// a reaction that conserves totals has a state for each total. Each such freedom gets an equation
/// that chooses one of the states, and an unknown that is 0 in a steady state.
struct Freedoms {
    Matrix columns;  ///< For each freedom, the effect of its unknown on the rates.
    Matrix rows;     ///< The equations, one in each row. A change of the state is 0 in all of them.
    Index count() const { return columns.cols(); }
};

class Corrector {
public:
    Corrector(SteadyProblem& problem, Scales scales)
        : problem_(problem), scales_(std::move(scales)) {}

    const Scales& scales() const { return scales_; }
    SteadyProblem& problem() { return problem_; }
    /// Whether translations and rotations are chosen. Not if the grid itself holds patterns in
    /// their places.
    void hold_motions(bool hold) { holds_motions_ = hold; }
    /// The totals that no rate changes. Each place on the branch keeps them.
    void keep_totals(Matrix totals) { totals_ = std::move(totals); }

    Freedoms freedoms_at(const Place& place) const;

    struct Solved {
        Place place;
        Linearised at;
        int rounds = 0;
        /// How much of the rates a motion would have to make up for, in parts of the rates'
        /// size.
        double drift = 0;
    };
    /// The place near `guess` where all rates are 0, on the plane through `guess` across
    /// `direction`. Empty if the iteration does not converge.
    std::optional<Solved> solve(const Place& guess, const Direction& direction);
    /// The tangent of the branch at a solved place, on the side of `direction`, of length 1. Empty
    /// if it cannot be computed.
    std::optional<Tangent> tangent(const Solved& at, const Direction& direction) const;
    /// The neutral modes at a solved place: they do not count for stability.
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
