// Values carried from the cells of a domain to finer or wider cells of the same domain.
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

/// Carries planes with a value for each cell. The result is the same on any number of threads.
class CellCarrier {
public:
    CellCarrier() = default;
    virtual ~CellCarrier() = default;
    CellCarrier(const CellCarrier&) = delete;
    CellCarrier& operator=(const CellCarrier&) = delete;

    /// Wider cells get the mean of the cells that they cover. Finer cells get smooth values, within
    /// the range of the cells around unless crests are kept. They are of third order in the cell
    /// width on grids away from crests, and of second on models. NaN around a cell with NaN.
    virtual Field carried(const Field& values) const = 0;
    /// A finer cell gets the value of the cell that contains it, or, on models, of the nearest one.
    /// A wider cell is 1 where at least half of its cells are not 0.
    virtual Mask carried(const Mask& cells) const = 0;
    /// The values of the side with this number: means along it, or each repeated. Grids only.
    virtual std::shared_ptr<const SideValues> carried(const SideValues& values,
                                                      std::size_t side) const = 0;
};

/// The treatment of crests between cells that are higher than all cells around, and of troughs.
enum class Crests : std::uint8_t {
    levelled,  ///< For a run's values, which stay in the range of the cells around.
    kept       ///< For pictures, which would show a plateau.
};

/// Divides each cell of `grid` into times × times cells (core/resample.h). With a mask, the values
/// of its cells continue beyond its border, and are 0 outside of `finer_mask`. Both are null
/// without one. All must outlive the result.
std::unique_ptr<CellCarrier> carrier_to_finer(const Grid& grid, std::int64_t times,
                                              const DomainMask* mask, const DomainMask* finer_mask,
                                              Crests crests = Crests::levelled);

/// From the cells of a grid without a mask to wider ones (core/resample.h).
std::unique_ptr<CellCarrier> carrier_to_wider(const Grid& grid, const Grid& wider);

/// From the cells of a model to those of `to`, which have the same mesh. All must outlive the
/// result. Throws std::bad_alloc.
std::unique_ptr<CellCarrier> carrier_on_model(const ModelCells& from, const ModelCells& to,
                                              Team& team);

}  // namespace cascade
