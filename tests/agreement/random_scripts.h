// Random valid scripts: systems, stages and domains as a user might write them.
#pragma once

#include <cstdint>
#include <string>

namespace cascade::test {

/// A script of one to three stages over random systems. It is valid by construction and depends
/// only on the seed. Every function and operator of lang/vocabulary/functions.def that a system or
/// a value may hold is likely to occur, and so are the script's own functions, families, masks,
/// stencils, invariants, definitions, rates of rates and uniform, varying and per-cell time steps.
std::string random_script(std::uint64_t seed);

}  // namespace cascade::test
