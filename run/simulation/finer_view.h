// The present state of a simulation on a plane, seen on a finer grid.
#pragma once

#include "lang/program/program.h"
#include "run/domain/cell_carrier.h"
#include "run/simulation/other_cells.h"
#include "run/simulation/simulation.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace cascade {

/// Values between cells lie on the curves of core/between_cells.h. The grid is a plane without a
/// mask and without a surface, and its stages are of fields.
class FinerView {
public:
    /// Each cell becomes times × times cells, of a line `times`. The simulation of `run` must
    /// outlive this. Throws std::bad_alloc.
    FinerView(const StageView& view, std::int64_t times);

    /// Evaluates a formula for pictures, as Simulation::evaluate() does. One with a sum over the
    /// domain, which depends on the number of cells, is evaluated in the cells of the run.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;

private:
    const Environment& run_;
    std::span<const StageState> run_states_;
    std::unique_ptr<const CellCarrier> carrier_;
    StagesInOtherCells finer_;
};

/// The present state of a simulation with each cell of a plane divided into times × times; null
/// where the domain has a mask, a surface or slices, or a stage is of cells that crawl. Throws
/// std::bad_alloc.
std::unique_ptr<const FinerView> finer_view(const Simulation& simulation, std::int64_t times);

}  // namespace cascade
