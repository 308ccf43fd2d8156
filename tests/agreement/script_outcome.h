// Runs scripts on different executors, and compares the bits of their fields.
#pragma once

#include "core/plane.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <string>
#include <vector>

namespace cascade::test {

/// The result of a run: the fields of all stages, and the message of a failure.
struct Outcome {
    std::vector<Field> fields;
    std::string failure;
};

/// Runs the stages of a script one after another, each for at most `last_step` steps, until one
/// fails. Files that the script reads are in the folder of the examples.
Outcome run_script(const std::string& name, const std::string& text, Overrides overrides,
                   const SimulationOptions& options,
                   std::int64_t last_step = std::int64_t{1} << 40);

void expect_same(const Outcome& expected, const Outcome& found, const std::string& what);

}  // namespace cascade::test
