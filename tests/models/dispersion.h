// Linear stability of a flat state: how fast each wave grows. It shares no code with the language
// and computes in double precision: the reaction is a C++ function, and its Jacobian is computed by
// differences.
#pragma once

#include <functional>
#include <vector>

namespace cascade::models {

using State = std::vector<double>;

struct ReactionDiffusion {
    std::function<State(const State&)> reaction;
    State diffusion;  ///< The diffusion coefficient of each species.
};

/// A zero of the reaction, found by Newton's method from a guess.
State flat_state(const ReactionDiffusion& system, State guess);

/// The largest real part of the eigenvalues of J − k² D.
double growth_rate(const ReactionDiffusion& system, const State& flat, double square_of_k);

/// The k² at which waves grow fastest, between 0 and `most`.
double fastest_wave(const ReactionDiffusion& system, const State& flat, double most);

}  // namespace cascade::models
