// Makes the text in the corner of frames.
#pragma once

#include "core/result.h"
#include "run/commands/uniform_numbers.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <string>
#include <vector>

namespace cascade {

/// Interprets the words of `--label`: "stage" stands for the name of the stage, and all other words
/// are expressions or features as in `--log`.
class FrameLabels {
public:
    /// Errors in the expressions are added to `script.diagnostics`.
    static Result<FrameLabels> create(Script& script, std::vector<std::string> words);

    /// Returns the text at the present moment of a started stage, such as "small  step = 3400
    /// mean(b over domain) = 1.25". Expressions that have no meaning in the stage are left out.
    std::string text(const Simulation& simulation, std::uint32_t stage) const;

private:
    std::vector<std::string> words_;
    UniformNumbers numbers_;  ///< The values of the words that are expressions.
};

}  // namespace cascade
