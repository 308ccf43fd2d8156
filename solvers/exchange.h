// What the parts of a grid tell each other while each takes its own share of the steps.
//
// A part of a grid is a range of rows, or of whole slices where there are several, and keeps the
// numbers of its cells (core/grid.h). All parts call the same functions in the same order, each
// with its own planes. Sums keep their bits, because they are made of the sums of rows, in the
// order of rows.
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

/// Cuts a grid into nearly equal parts: `count`, or fewer if it has fewer rows or slices.
std::vector<RowRange> cut_grid(const Grid& grid, int count);

/// A part's rows with `width` rows on both sides, or slices of a grid with several. If `wraps`,
/// rows before the first and after the last one of the grid count as well. A plane that holds them
/// has a halo of that width and one more.
RowRange with_neighbours(const Grid& grid, RowRange part, std::int64_t width, bool wraps);

class Exchange {
public:
    /// A plane that lies in parts.
    struct Shared {
        Field* field = nullptr;  ///< Holds the part, and its halo.
        bool wraps = false;      ///< The first rows or slices follow the last ones.
    };

    Exchange(const Grid& grid, std::vector<RowRange> parts, std::size_t number)
        : grid_(grid), parts_(std::move(parts)), number_(number) {}
    virtual ~Exchange() = default;
    Exchange(const Exchange&) = delete;
    Exchange& operator=(const Exchange&) = delete;

    std::size_t count() const { return parts_.size(); }
    RowRange rows() const { return parts_[number_]; }
    /// Does this part compute what takes the whole grid?
    bool is_root() const { return number_ == 0; }

    /// Fills `width` rows or slices on both sides of the part from the parts that compute them.
    /// They come with the columns of their halo.
    virtual void fill_halos(std::span<const Shared> planes, std::int64_t width) = 0;
    /// Completes vectors of one number per row of the grid, of which each part has set its own.
    virtual void share_rows(std::span<std::vector<double>* const> rows) = 0;
    /// Puts all parts of planes, the halo of the grid included, into whole planes of the root. At
    /// other parts `whole` may be empty.
    virtual void gather(std::span<const Field* const> own, std::span<Field* const> whole) = 0;
    /// Gives every part its rows of the root's planes, its halo included.
    virtual void scatter(std::span<const Field* const> whole, std::span<Field* const> own) = 0;

protected:
    const Grid grid_;
    const std::vector<RowRange> parts_;
    const std::size_t number_;
};

/// Parts in one process, each in a thread of a team.
class LocalExchange final : public Exchange {
public:
    /// What the parts show each other, which they share.
    struct Board {
        Team& team;
        std::vector<std::span<const Shared>> shared;
        std::vector<std::span<const Field* const>> fields;
        std::vector<std::span<std::vector<double>* const>> rows;

        Board(Team& of, std::size_t parts) : team(of), shared(parts), fields(parts), rows(parts) {}
    };

    LocalExchange(const Grid& grid, std::vector<RowRange> parts, std::size_t number, Board& board)
        : Exchange(grid, std::move(parts), number), board_(board) {}

    void fill_halos(std::span<const Shared> planes, std::int64_t width) override;
    void share_rows(std::span<std::vector<double>* const> rows) override;
    void gather(std::span<const Field* const> own, std::span<Field* const> whole) override;
    void scatter(std::span<const Field* const> whole, std::span<Field* const> own) override;

private:
    Board& board_;
};

/// Copies all rows that both planes hold, halos included.
void copy_held(const Field& from, Field& to);

}  // namespace cascade
