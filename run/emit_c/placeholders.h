// States of stages that have not run: every item has a plane of a few cells. Plans that are bound
// to them show the registers and temporaries of a step without a run.
#pragma once

#include "run/domain/input_files.h"
#include "run/simulation/simulation.h"
#include "run/stage/bound_kernel.h"

#include <vector>

namespace cascade {

class Placeholders {
public:
    /// For stages 0 … `last`.
    Placeholders(const Program& program, std::uint32_t last);

    std::vector<StageState>& states() { return states_; }
    /// On a tiny grid.
    BindingContext context() const {
        return {states_, files_, 0, grid_, Precision::single, 0, metric_};
    }

private:
    Grid grid_{1, 1};
    std::vector<StageState> states_;
    InputFiles files_;
    std::vector<Field> metric_;
};

}  // namespace cascade
