// Exchanges planes and sums between the parts of a grid, which are computed separately.
//
// A part of a grid is a range of rows or, if there are several slices, of whole slices. Its cells
// keep their numbers in the grid (core/grid.h). All parts call the same functions in the same
// order, each with its own planes. Each part reduces every row to one number. Every part then gets
// the numbers of all rows and combines them as a single process does: the numbers of an aggregate
// in pairs (ir/reduction.h), and the squares of errors row by row (solvers/field_norms.h). So the
// results equal the results of an undivided grid bit for bit.
//
// A part may compute several passes between two exchanges. Its halo then has layers for all of
// them: for each pass, as many layers as the pass reaches rows or slices. Each pass also computes
// those layers of the halo that the later passes read, so neighbours compute the same values
// (solvers/part_halos.h).
#pragma once

#include "core/grid.h"
#include "core/parallel.h"
#include "core/plane.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// Cuts a grid into `count` nearly equal parts, or fewer if there are fewer rows or slices.
std::vector<RowRange> cut_grid(const Grid& grid, int count);

/// A part's rows and `width` more rows on both sides. If the grid has several slices, `width`
/// counts slices instead of rows. If `wraps` is true, the last rows of the grid precede the first
/// rows, and the first rows follow the last. Otherwise rows end at the sides of the grid. A plane
/// that holds these rows has one more row or slice around them as its halo.
RowRange with_neighbours(const Grid& grid, RowRange part, std::int64_t width, bool wraps);

class Exchange {
public:
    /// A plane that is divided among parts.
    struct Shared {
        Field* field = nullptr;  ///< Holds this part and its halo.
        /// Whether the axis is periodic, so that the first rows or slices follow the last.
        bool wraps = false;
    };

    /// `levels` is the largest number of passes between two exchanges; see levels_of_halo().
    Exchange(const Grid& grid, std::vector<RowRange> parts, std::size_t number, int levels)
        : grid_(grid), parts_(std::move(parts)), number_(number), levels_(levels) {}
    virtual ~Exchange() = default;
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;

    std::size_t count() const { return parts_.size(); }
    RowRange rows() const { return parts_[number_]; }
    const std::vector<RowRange>& parts() const { return parts_; }
    int levels() const { return levels_; }
    /// Whether this part does the computations that need the whole grid.
    bool is_root() const { return number_ == 0; }

    /// Fills `width` rows or slices on both sides of this part, including their halo columns, with
    /// values from the parts that compute them.
    virtual void fill_halos(std::span<const Shared> planes, std::int64_t width) = 0;
    /// Completes vectors that have one number per row of the grid. Before the call, each part has
    /// set the numbers of its own rows. Afterwards every part has the numbers of all rows.
    virtual void share_rows(std::span<std::vector<double>* const> rows) = 0;
    /// Assembles whole planes at the root from the planes of all parts, including the halo of the
    /// grid. In other parts `whole` may be empty.
    virtual void gather(std::span<const Field* const> own, std::span<Field* const> whole) = 0;
    /// Copies from the root's planes to every part the part's rows and halo.
    virtual void scatter(std::span<const Field* const> whole, std::span<Field* const> own) = 0;

protected:
    const Grid grid_;
    const std::vector<RowRange> parts_;
    const std::size_t number_;
    const int levels_;
};

/// Exchanges data between parts in one process. Each part has a thread of a team.
class LocalExchange final : public Exchange {
public:
    /// Pointers to each part's data, which all parts can read.
    struct Board {
        Team& team;
        std::vector<std::span<const Shared>> shared;
        std::vector<std::span<const Field* const>> fields;
        std::vector<std::span<std::vector<double>* const>> rows;

        Board(Team& of, std::size_t parts) : team(of), shared(parts), fields(parts), rows(parts) {}
    };

    LocalExchange(const Grid& grid, std::vector<RowRange> parts, std::size_t number, Board& board,
                  int levels = 1)
        : Exchange(grid, std::move(parts), number, levels), board_(board) {}

    void fill_halos(std::span<const Shared> planes, std::int64_t width) override;
    void share_rows(std::span<std::vector<double>* const> rows) override;
    void gather(std::span<const Field* const> own, std::span<Field* const> whole) override;
    void scatter(std::span<const Field* const> whole, std::span<Field* const> own) override;

private:
    Board& board_;
};

/// Copies all rows, halos included, that both planes have in memory.
void copy_held(const Field& from, Field& to);

/// Copies the last row or slice of a whole plane to the halo before the first, and the first to the
/// halo after the last.
void copy_across(Field& whole);

}  // namespace cascade
