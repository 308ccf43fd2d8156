// Evaluates values of cells, such as rates and conditions, in any state of a tissue.
#pragma once

#include "core/parallel.h"
#include "solvers/pass_runner.h"
#include "tissue/tissue_rules.h"

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// Evaluates values of cells. Owns the planes of each problem's results until clear().
class ValueRunner {
public:
    explicit ValueRunner(Team& team) : team_(team) {}

    /// The values in this state. The next call for the same CellValues overwrites the returned
    /// planes. If `among` is not empty, only the values of these cells are needed.
    std::vector<Field>& run(const CellValues& values, std::vector<Field>& state,
                            const Tissue& tissue, const StepMoment& moment,
                            std::span<const std::uint32_t> among = {});
    Team& team() const { return team_; }
    /// Must be called when problems are destroyed.
    void clear() { known_.clear(); }
    /// Must be called when links have changed or cells have moved in memory.
    void links_changed() {
        for (auto& [problem, known] : known_) known.among.clear();
    }

private:
    struct Known {
        StepProblem problem;
        std::unique_ptr<PassRunner> runner;
        std::vector<Field> results;
        std::vector<std::uint32_t> among;  ///< The argument `among` of the last call.
        std::vector<std::vector<Patch>>
            patches;  ///< The patches that each pass must compute for `among`.
    };
    Team& team_;
    std::map<const StepProblem*, Known> known_;
};

}  // namespace cascade
