// How tests run simulations.
#pragma once

#include "run/simulation/simulation.h"

namespace cascade::test {

inline SimulationOptions interpreted(int threads = 1) {
    return {BackendKind::interpreter, 0, threads};
}
inline SimulationOptions compiled() {
    return {has_jit() ? BackendKind::jit : BackendKind::interpreter, 0, 1};
}

}  // namespace cascade::test
