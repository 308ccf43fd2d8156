// Messages are sent from planes and received into planes, without a copy in between. This is
// possible because adjacent rows are adjacent in memory.
#include "ranks/rank_exchange.h"

#include "core/check.h"
#include "solvers/layers_in_memory.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace cascade {
namespace {

using Message = Messenger::Message;

/// A message to be sent. Its bytes are only read, so they may be in constant memory.
Message message(int rank, std::span<const std::byte> bytes) {
    return {rank, {const_cast<std::byte*>(bytes.data()), bytes.size()}};
}

void copy(std::span<const std::byte> from, std::span<std::byte> to) {
    CHECK(from.size() == to.size(), "parts of equal sizes are copied");
    std::memcpy(to.data(), from.data(), from.size());
}

}  // namespace

RankExchange::RankExchange(const Grid& grid, Messenger& messenger, RankLoad& load, int levels)
    : Exchange(grid, cut_grid(grid, messenger.count()), static_cast<std::size_t>(messenger.rank()),
               levels),
      messenger_(messenger),
      load_(load),
      layer_(rows_of_layer(PlaneLayout(grid))) {
    CHECK(parts_.size() == static_cast<std::size_t>(messenger.count()), "a part for each rank");
}

/// Adds to `all` the transfers that fill the rows `needed` of the halo of part `to`. Some of these
/// rows may be beyond the grid.
void RankExchange::add_transfers(int to, RowRange needed, std::vector<Transfer>& all) const {
    const std::int64_t rows = grid_.height * grid_.depth;
    for (std::int64_t row = needed.begin; row < needed.end; row += layer_) {
        const std::int64_t source = ((row % rows) + rows) % rows;
        const auto owner = std::find_if(parts_.begin(), parts_.end(),
                                        [&](RowRange part) { return source < part.end; });
        const auto from = static_cast<int>(owner - parts_.begin());
        const bool is_across = source != row;
        if (!all.empty()) {
            Transfer& last = all.back();
            const bool follows = last.from == from && last.to == to &&
                                 last.is_across == is_across && last.rows.end == source &&
                                 last.target + last.rows.count() == row;
            if (follows) {
                last.rows.end += layer_;
                continue;
            }
        }
        all.push_back({from, to, {source, source + layer_}, row, is_across});
    }
}

const std::vector<RankExchange::Transfer>& RankExchange::transfers(std::int64_t width) {
    const auto [place, is_new] = transfers_.try_emplace(width);
    if (!is_new) return place->second;
    const auto own = static_cast<int>(number_);
    std::vector<Transfer>& wanted = place->second;
    for (std::size_t part = 0; part < count(); ++part) {
        std::vector<Transfer> all;
        const RowRange rows = parts_[part];
        add_transfers(static_cast<int>(part), {rows.begin - width * layer_, rows.begin}, all);
        add_transfers(static_cast<int>(part), {rows.end, rows.end + width * layer_}, all);
        std::copy_if(all.begin(), all.end(), std::back_inserter(wanted),
                     [&](const Transfer& each) { return each.from == own || each.to == own; });
    }
    return wanted;
}

void RankExchange::fill_halos(std::span<const Shared> planes, std::int64_t width) {
    const TimeOfMessages time(load_);
    const auto own = static_cast<int>(number_);
    std::vector<Message> out, in;
    ++load_.halo_exchanges;
    for (const Shared& plane : planes) {
        for (const Transfer& each : transfers(width)) {
            if (each.is_across && !plane.wraps) continue;
            const RowRange halo{each.target, each.target + each.rows.count()};
            if (each.from == own && each.to == own) {
                copy(memory_of(std::as_const(*plane.field), each.rows),
                     memory_of(*plane.field, halo));
            } else if (each.to == own) {
                in.push_back({each.from, memory_of(*plane.field, halo)});
            } else {
                out.push_back(message(each.to, memory_of(std::as_const(*plane.field), each.rows)));
                load_.halo_bytes += static_cast<std::int64_t>(out.back().bytes.size());
            }
        }
    }
    messenger_.exchange(out, in);
}

void RankExchange::share_rows(std::span<std::vector<double>* const> rows) {
    const TimeOfMessages time(load_);
    for (std::vector<double>* const each : rows) {
        std::vector<std::span<std::byte>> blocks;
        for (const RowRange part : parts_) {
            blocks.push_back(std::as_writable_bytes(
                std::span(each->data() + part.begin, static_cast<std::size_t>(part.count()))));
        }
        messenger_.complete(blocks);
    }
}

RowRange RankExchange::given_rows(std::size_t part) const {
    RowRange rows = parts_[part];
    if (part == 0) rows.begin -= layer_;
    if (part + 1 == count()) rows.end += layer_;
    return rows;
}

void RankExchange::gather(std::span<const Field* const> own, std::span<Field* const> whole) {
    const TimeOfMessages time(load_);
    std::vector<Message> out, in;
    for (std::size_t k = 0; k < own.size(); ++k) {
        const auto mine = memory_of(*own[k], given_rows(number_));
        if (!is_root()) {
            out.push_back(message(0, mine));
            continue;
        }
        copy(mine, memory_of(*whole[k], given_rows(0)));
        for (std::size_t part = 1; part < count(); ++part) {
            in.push_back({static_cast<int>(part), memory_of(*whole[k], given_rows(part))});
        }
    }
    messenger_.exchange(out, in);
}

void RankExchange::scatter(std::span<const Field* const> whole, std::span<Field* const> own) {
    if (own.empty()) return;
    const TimeOfMessages time(load_);
    // On linked grids, a part stores more rows than its own rows and a halo of one layer.
    std::vector<RowRange> rows(count());
    rows[number_] = common(held(own[0]->layout()), held(PlaneLayout(grid_)));
    std::vector<std::span<std::byte>> blocks;
    for (RowRange& each : rows) blocks.push_back(std::as_writable_bytes(std::span(&each, 1)));
    messenger_.complete(blocks);
    std::vector<Message> out, in;
    for (std::size_t k = 0; k < own.size(); ++k) {
        if (!is_root()) {
            in.push_back({0, memory_of(*own[k], rows[number_])});
            continue;
        }
        copy_held(*whole[k], *own[k]);
        for (std::size_t part = 1; part < count(); ++part) {
            out.push_back(
                message(static_cast<int>(part), memory_of(std::as_const(*whole[k]), rows[part])));
        }
    }
    messenger_.exchange(out, in);
}

bool RankExchange::all_agree(bool own) {
    const TimeOfMessages time(load_);
    std::vector<std::byte> answers(count());
    answers[number_] = std::byte{own};
    std::vector<std::span<std::byte>> blocks;
    for (std::byte& each : answers) blocks.emplace_back(&each, 1);
    messenger_.complete(blocks);
    return std::find(answers.begin(), answers.end(), std::byte{0}) == answers.end();
}

void RankExchange::gather_everywhere(std::span<const Field> own, std::span<Field> whole) {
    for (std::size_t k = 0; k < own.size(); ++k) {
        std::vector<std::span<std::byte>> blocks;
        for (std::size_t part = 0; part < count(); ++part) {
            blocks.push_back(memory_of(whole[k], given_rows(part)));
        }
        copy(memory_of(own[k], given_rows(number_)), blocks[number_]);
        messenger_.complete(blocks);
    }
}

}  // namespace cascade
