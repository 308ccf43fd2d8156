// Shows the present state of a simulation on a plane in smaller cells.
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

/// Values between cells follow the curves of core/between_cells.h. The domain must be a plane
/// without a mask and without a surface, and all stages must be of fields.
class FinerView {
public:
    /// Divides each cell into times × times cells, or into `times` cells on a line. The simulation
    /// of `view` must outlive this object. Throws std::bad_alloc.
    FinerView(const StageView& view, std::int64_t times);

    /// Evaluates a formula for pictures as Simulation::evaluate() does, but in the smaller cells.
    /// If the formula contains a sum over the domain, it is evaluated in the cells of the run,
    /// because the sum depends on the number of cells.
    std::vector<Field> evaluate(const Formula& formula, std::uint32_t stage) const;

private:
    const Environment& run_;
    std::span<const StageState> run_states_;
    std::unique_ptr<const CellCarrier> carrier_;
    StagesInOtherCells finer_;
};

/// Makes a view that shows each cell of a plane as times × times cells. Returns null if the domain
/// has a mask, a surface or slices, or if a stage has crawling cells. Throws std::bad_alloc.
std::unique_ptr<const FinerView> finer_view(const Simulation& simulation, std::int64_t times);

}  // namespace cascade
