// Evaluates values of cells, such as rates and conditions, at any state of a tissue.
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

/// Keeps the planes of each problem's values until clear().
class ValueRunner {
public:
    explicit ValueRunner(Team& team) : team_(team) {}

    /// The values at this state, in planes that the next call for the same values overwrites.
    /// `among`: the only cells needed. Empty: all.
    std::vector<Field>& run(const CellValues& values, std::vector<Field>& state,
                            const Tissue& tissue, const StepMoment& moment,
                            std::span<const std::uint32_t> among = {});
    Team& team() const { return team_; }
    /// Call when problems are gone.
    void clear() { known_.clear(); }
    /// Call when links have changed or cells have moved in memory.
    void links_changed() {
        for (auto& [problem, known] : known_) known.among.clear();
    }

private:
    struct Known {
        StepProblem problem;
        std::unique_ptr<PassRunner> runner;
        std::vector<Field> results;
        std::vector<std::uint32_t> among;         ///< The last cells requested.
        std::vector<std::vector<Patch>> patches;  ///< The patches of each pass for them.
    };
    Team& team_;
    std::map<const StepProblem*, Known> known_;
};

}  // namespace cascade
