// Values of cells carried to the finer cells of the same domain.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "run/domain/domain_mask.h"
#include "run/domain/model_cells.h"

#include <cstdint>
#include <memory>

namespace cascade {

/// Carries planes with a value for each cell. The same on any number of threads.
class CellCarrier {
public:
    CellCarrier() = default;
    virtual ~CellCarrier() = default;
    CellCarrier(const CellCarrier&) = delete;
    CellCarrier& operator=(const CellCarrier&) = delete;

    /// Smooth between cells, and nowhere outside of the range of the cells around unless crests are
    /// kept; of third order in their width on grids away from crests, of second on models. NaN
    /// around a cell with NaN.
    virtual Field carried(const Field& values) const = 0;
    /// Each finer cell has what the cell has in which it lies, or, on models, the nearest one.
    virtual Mask repeated(const Mask& cells) const = 0;
};

/// What becomes of crests between cells that are higher than all cells around, and of troughs.
enum class Crests : std::uint8_t {
    levelled,  ///< For values that a run goes on with, which stay in the range of the cells around.
    kept       ///< For pictures, in which a plateau would show.
};

/// Each cell of `grid` becomes times × times cells (core/resample.h). With a mask, the values of
/// its cells go on beyond its border, and are 0 outside of `finer_mask`; both are null without one.
/// All must outlive the result.
std::unique_ptr<CellCarrier> carrier_on_grid(const Grid& grid, std::int64_t times,
                                             const DomainMask* mask, const DomainMask* finer_mask,
                                             Crests crests = Crests::levelled);

/// From the cells of a model to those of `to`, which have the same mesh. All must outlive the
/// result. Throws std::bad_alloc.
std::unique_ptr<CellCarrier> carrier_on_model(const ModelCells& from, const ModelCells& to,
                                              Team& team);

}  // namespace cascade
