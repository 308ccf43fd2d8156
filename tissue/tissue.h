// A tissue: cells that crawl, divide and die, and the planes that hold their values.
//
// Each cell has a birth number, which never changes. Cells may have any order in memory. Every sum
// over cells and every list of neighbours is in the order of numbers, so that no result depends on
// the order in memory.
#pragma once

#include "core/grid.h"
#include "core/plane.h"
#include "core/precision.h"
#include "solvers/step_control.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace cascade {

/// Everything, besides the cells, that must be known to continue a tissue's stage.
struct TissueTime {
    double t = 0;
    std::int64_t steps = 0;
    StepControl::State control;
    /// An upper bound of the eigenvalues of the rates' Jacobian, in 1 / time, and the number of
    /// complete steps when it was estimated (−1 if it was not yet estimated).
    double stiffness = 0;
    std::int64_t estimated_at = -1;
    double last_event = 0;  ///< The time of the last division or death.
    double progress = 0;    ///< The greatest progress since the last event (tissue/tissue_loop.h).
    // The time and the counts when compare_turnover() last compared births and deaths with the
    // number of cells.
    double compared_at = 0;
    std::int64_t compared_births = 0, compared_deaths = 0, compared_cells = 0;
};

/// A tissue as plain data, cell after cell in ascending order of their numbers. A run that
/// continues from a record gets the same bits as an uninterrupted run.
struct TissueRecord {
    std::vector<std::uint32_t> numbers;
    std::vector<std::vector<double>> species;  ///< By species, then by cell.
    /// By species, then by cell: the direction, in the space of values, in which the rates change
    /// fastest.
    std::vector<std::vector<double>> stiffest;
    /// The values of the planes of Tissue::kept, by plane, then by cell. Empty for a plane that is
    /// empty.
    std::vector<std::vector<double>> kept;
    std::optional<std::size_t> frozen;     ///< The plane of `kept` that marks frozen cells.
    std::vector<std::uint32_t> triangles;  ///< The surface's triangle nearest to each cell.
    std::uint32_t next_number = 0;
    std::int64_t births = 0, deaths = 0;
    TissueTime time;
};

/// The cells in memory. Cell k is in column k mod width of row k / width. The elements after the
/// last cell repeat its values. New planes have room for an eighth more cells than exist, so that
/// births seldom require new planes.
class Tissue {
public:
    static constexpr std::uint32_t no_triangle = 0xffffffff;

    /// Makes a tissue from a record. Throws std::bad_alloc.
    Tissue(const TissueRecord& record, Precision precision);
    TissueRecord record() const;

    std::size_t count() const { return numbers_.size(); }
    Precision precision() const { return precision_; }
    const Grid& grid() const { return grid_; }
    const PlaneLayout& layout() const { return layout_; }
    /// The number of elements from cell 0 to this cell.
    std::int64_t element(std::size_t cell) const {
        const auto k = static_cast<std::int64_t>(cell);
        return layout_.row_start(k / layout_.width) + k % layout_.width;
    }

    /// Calls `use(cell, element)` for all cells in the order of memory.
    void each_cell(const auto& use) const {
        for (std::size_t cell = 0, row = 0; cell < count(); ++row) {
            const std::int64_t first = layout_.row_start(static_cast<std::int64_t>(row));
            for (std::int64_t i = 0; i < layout_.width && cell < count(); ++i) {
                use(cell++, first + i);
            }
        }
    }

    /// The values of all species: one plane for each species. While a step runs, these planes
    /// belong to the step.
    std::vector<Field> species;
    /// Planes of values that have no rates. The values are moved and copied together with their
    /// cells. Some planes may be empty.
    std::vector<Field> kept;
    /// The direction, in the space of values, in which the rates change fastest. Empty until it is
    /// known.
    std::vector<Field> stiffest;
    /// The triangle that was nearest to each cell at the last complete step, or no_triangle.
    std::vector<std::uint32_t> triangles;
    /// By cell: the movement in the last step (1 after a division), expressed as the skin of a list
    /// that would allow this movement. No result depends on it.
    std::vector<float> restlessness;
    std::uint32_t next_number = 0;
    std::int64_t births = 0, deaths = 0;
    TissueTime time;

    /// The number of each cell, in the order of memory.
    std::span<const std::uint32_t> numbers() const { return numbers_; }
    /// The cells in ascending order of their numbers.
    std::span<const std::uint32_t> by_number() const { return by_number_; }
    /// The elements of the cells in ascending order of numbers, counted from cell 0.
    std::span<const std::uint32_t> elements_by_number() const { return elements_by_number_; }
    /// The index of each cell in by_number(), in the order of memory.
    std::span<const std::uint32_t> ranks() const { return ranks_; }
    /// The cells' numbers as a plane, for kernels that draw random numbers.
    const Field& number_plane() const { return number_plane_; }
    /// A mask that is 1 for cells, and 0 for the elements that repeat the last cell.
    const Mask& inside() const { return inside_; }

    /// The mask inside() as a plane of numbers 1 and 0.
    const Field& ones() const { return ones_; }
    /// A mask that is 1 for frozen cells. Empty if no cell can be frozen.
    const Mask& frozen() const { return frozen_; }
    bool is_frozen(std::size_t cell) const {
        return !frozen_.empty() && frozen_.origin()[element(cell)] != 0;
    }
    /// Whether all cells are frozen.
    bool is_frozen() const;
    /// From now on, freezes cells where this plane of `kept` is not 0.
    void freeze_by(std::size_t kept_plane);

    /// Puts a copy of cell sources[k] at index k, for all k. Cells that are not among the sources
    /// disappear. The cells at the indices `born` get the next numbers, in this order. Only cells
    /// in `born` may have the same source as another cell. Returns whether the layout has changed.
    /// If not, all planes stay in memory. Throws std::bad_alloc.
    bool rearrange(std::span<const std::uint32_t> sources,
                   std::span<const std::uint32_t> born = {});
    /// Copies the values of the last cell to the elements after it.
    void pad();

    double value(std::size_t species_index, std::size_t cell) const;
    void set(std::size_t species_index, std::size_t cell, double value);
    void set_kept(std::size_t kept_index, std::size_t cell, double value);

private:
    void choose_layout(std::size_t cells);
    void number_cells(std::size_t first);
    void keep_order(std::span<const std::uint32_t> sources, std::span<const std::uint32_t> born);
    void find_frozen();

    Precision precision_;
    Grid grid_;
    PlaneLayout layout_;
    std::vector<std::uint32_t> numbers_, by_number_, elements_by_number_, ranks_;
    Field number_plane_, ones_;
    Mask inside_, frozen_;
    std::optional<std::size_t> frozen_by_;  ///< The plane of `kept` that freezes cells.
};

/// The value of a cell in a plane of the tissue's layout.
inline double value_in(const Field& field, const Tissue& tissue, std::size_t cell) {
    return field.visit([&](const auto& plane) {
        return static_cast<double>(plane.origin()[tissue.element(cell)]);
    });
}

inline double Tissue::value(std::size_t species_index, std::size_t cell) const {
    return value_in(species[species_index], *this, cell);
}

}  // namespace cascade
