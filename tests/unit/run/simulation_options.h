// The options with which tests run simulations.
#pragma once

#include "run/simulation/simulation.h"

namespace cascade::test {

inline SimulationOptions interpreted(int threads = 1) { return {"interp", 0, threads}; }
inline SimulationOptions compiled() { return {fastest_backend().name, 0, 1}; }

}  // namespace cascade::test
