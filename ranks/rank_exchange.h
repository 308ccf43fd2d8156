// Exchanges planes and sums between the ranks of a run, each of which has a part of the grid.
#pragma once

#include "ranks/messenger.h"
#include "ranks/rank_load.h"
#include "solvers/exchange.h"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace cascade {

class RankExchange final : public Exchange {
public:
    /// Divides the grid among all ranks of the messenger. The grid must have at least as many rows
    /// as there are ranks. If the grid has several slices, it must have at least as many slices as
    /// there are ranks. `levels` is the largest number of passes between two exchanges. Adds to
    /// `load` the time spent in messages, and the bytes and the number of exchanges of halos.
    /// Messenger and load must outlive the exchange.
    RankExchange(const Grid& grid, Messenger& messenger, RankLoad& load, int levels = 1);

    void fill_halos(std::span<const Shared> planes, std::int64_t width) override;
    void share_rows(std::span<std::vector<double>* const> rows) override;
    void gather(std::span<const Field* const> own, std::span<Field* const> whole) override;
    void scatter(std::span<const Field* const> whole, std::span<Field* const> own) override;

    /// Combines the parts of planes to whole planes on every rank. The whole planes include the
    /// halo of the grid.
    void gather_everywhere(std::span<const Field> own, std::span<Field> whole);

    /// Whether all ranks pass true.
    bool all_agree(bool own);

private:
    /// Layers that part `from` computes and that part `to` needs in its halo. `from` and `to` may
    /// be the same part.
    struct Transfer {
        int from = 0, to = 0;
        RowRange rows;            ///< The rows of the layers in part `from`.
        std::int64_t target = 0;  ///< The first row of the layers in the halo.
        bool is_across = false;   ///< Whether the halo lies beyond a side of the grid.
    };

    const std::vector<Transfer>& transfers(std::int64_t width);
    void add_transfers(int to, RowRange needed, std::vector<Transfer>& all) const;
    /// The rows that a part contributes to a whole plane: the part's own rows and, at the ends of
    /// the grid, the rows of the halo.
    RowRange given_rows(std::size_t part) const;

    Messenger& messenger_;
    RankLoad& load_;
    std::int64_t layer_ = 1;  ///< The number of rows in a layer.
    /// The transfers for each width of the halo.
    std::map<std::int64_t, std::vector<Transfer>> transfers_;
};

}  // namespace cascade
