// Linear stability of a flat state: how fast each wave grows. Written apart from the language, in
// double precision: the reaction is a C++ function, its Jacobian comes from differences.
#pragma once

#include <functional>
#include <vector>

namespace cascade::models {

using State = std::vector<double>;

struct ReactionDiffusion {
    std::function<State(const State&)> reaction;
    State diffusion;  ///< Of each species.
};

/// A root of the reaction, by Newton's method from a guess.
State flat_state(const ReactionDiffusion& system, State guess);

/// The largest real part of the eigenvalues of J − k² D.
double growth_rate(const ReactionDiffusion& system, const State& flat, double square_of_k);

/// The k² at which waves grow fastest, between 0 and `most`.
double fastest_wave(const ReactionDiffusion& system, const State& flat, double most);

}  // namespace cascade::models
