// Transfers values from the cells of a domain to smaller or larger cells of the same domain.
#pragma once

#include "core/parallel.h"
#include "core/plane.h"
#include "core/side.h"
#include "run/domain/domain_mask.h"
#include "run/domain/model_cells.h"

#include <cstddef>
#include <cstdint>
#include <memory>

namespace cascade {

/// Transfers planes with a value for each cell to other cells. The result does not depend on the
/// number of threads.
class CellCarrier {
public:
    CellCarrier() = default;
    virtual ~CellCarrier() = default;
    CellCarrier(const CellCarrier&) = delete;
    CellCarrier& operator=(const CellCarrier&) = delete;

    /// Returns the values in the new cells. A larger cell gets the mean of the cells that it
    /// covers. Smaller cells get smooth values. These stay in the range of the surrounding cells,
    /// unless Crests::kept permits larger and smaller values. The error is of third order in the
    /// cell width on grids (away from crests), and of second order on models. The result is NaN
    /// near a cell with NaN.
    virtual Field carried(const Field& values) const = 0;
    /// Returns the mask in the new cells. A smaller cell gets the value of the cell that contains
    /// it or, on models, the value of the nearest cell. A larger cell is 1 if at least half of the
    /// cells that it covers are not 0.
    virtual Mask carried(const Mask& cells) const = 0;
    /// Transfers the values along side number `side` of a grid. Larger cells get means along the
    /// side, and smaller cells repeat values.
    virtual std::shared_ptr<const SideValues> carried(const SideValues& values,
                                                      std::size_t side) const = 0;
};

/// A crest is a maximum between cells that is above the values of all cells around it. Troughs are
/// treated in the same way as crests.
enum class Crests : std::uint8_t {
    levelled,  ///< Values stay in the range of the surrounding cells. This is for runs.
    kept       ///< Values may leave that range. For pictures, which would otherwise show plateaus.
};

/// Divides each cell of `grid` into times × times cells (core/resample.h). If the domain has a
/// mask, values are first continued beyond its border, and the result is 0 outside `finer_mask`. If
/// the domain has no mask, both pointers are null. All arguments must outlive the result.
std::unique_ptr<CellCarrier> carrier_to_finer(const Grid& grid, std::int64_t times,
                                              const DomainMask* mask, const DomainMask* finer_mask,
                                              Crests crests = Crests::levelled);

/// Transfers values from the cells of a grid without a mask to the larger cells of `wider`
/// (core/resample.h).
std::unique_ptr<CellCarrier> carrier_to_wider(const Grid& grid, const Grid& wider);

/// Transfers values from the cells of a model to the cells of `to`, which has the same mesh. All
/// arguments must outlive the result. Throws std::bad_alloc.
std::unique_ptr<CellCarrier> carrier_on_model(const ModelCells& from, const ModelCells& to,
                                              Team& team);

}  // namespace cascade
