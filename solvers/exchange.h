// Exchanges planes and sums between the parts of a grid, which are computed separately.
//
// A part of a grid is a range of rows or, if there are several slices, of whole slices. Its cells
// keep their numbers in the grid (core/grid.h). All parts call the same functions in the same
// order, each with its own planes. Each part reduces its rows to one number a row, and every part
// gets the numbers of all rows and combines them as a single process does: the numbers of an
// aggregate in pairs (ir/reduction.h), and the squares of errors row by row
// (solvers/field_norms.h). So the results equal those of an undivided grid bit for bit.
//
// A part may compute several passes between two exchanges. For each of these passes, its halos have
// as many layers as the pass reaches rows or slices. Each pass also computes those layers of the
// halo that the later passes read, so neighbours compute the same values (solvers/part_halos.h).
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
/// counts slices. If `wraps` is true, the last rows of the grid precede the first rows, and the
/// first rows follow the last. A plane that holds these rows has a halo of width `width` plus one.
RowRange with_neighbours(const Grid& grid, RowRange part, std::int64_t width, bool wraps);

class Exchange {
public:
    /// A plane that is divided among parts.
    struct Shared {
        Field* field = nullptr;  ///< Holds this part and its halo.
        bool wraps = false;      ///< Whether the axis is periodic, so that the first rows or slices
                                 ///< follow the last.
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

    /// Fills `width` rows or slices on both sides of this part with the values of the parts that
    /// compute them, halo columns included.
    virtual void fill_halos(std::span<const Shared> planes, std::int64_t width) = 0;
    /// Completes vectors that have one number per row of the grid. Before the call, each part has
    /// set the numbers of its own rows. After it, every part has all numbers.
    virtual void share_rows(std::span<std::vector<double>* const> rows) = 0;
    /// Collects all parts of planes, the halo of the grid included, in whole planes of the root. In
    /// other parts `whole` may be empty.
    virtual void gather(std::span<const Field* const> own, std::span<Field* const> whole) = 0;
    /// Copies to every part its rows and halo from the root's planes.
    virtual void scatter(std::span<const Field* const> whole, std::span<Field* const> own) = 0;

protected:
    const Grid grid_;
    const std::vector<RowRange> parts_;
    const std::size_t number_;
    const int levels_;
};

/// Exchange between parts in one process, each in a thread of a team.
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

/// Copies all rows that both planes have in memory, halos included.
void copy_held(const Field& from, Field& to);

/// Copies the last rows or slices of a whole plane to the halo before the first, and the first to
/// the halo after the last.
void copy_across(Field& whole);

}  // namespace cascade
