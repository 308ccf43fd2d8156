// All places of a row are tried at once: bit x of a word says that a shape at x would meet a taken
// cell.
#include "atlas/cell_rows.h"

#include <algorithm>
#include <bit>

namespace cascade {

CellRows::CellRows(int side)
    : side_(side),
      stride_((side + bits - 1) / bits + 1),
      words_(static_cast<std::size_t>(side * stride_)) {}

namespace {

/// ORs bits moved down by `by` into those that are there. What is moved in is 0.
void add_moved(const std::vector<std::uint64_t>& from, int by, std::vector<std::uint64_t>& to) {
    const std::size_t whole = static_cast<std::size_t>(by / 64);
    const int rest = by % 64;
    for (std::size_t w = 0; w + whole < from.size(); ++w) {
        std::uint64_t moved = from[w + whole] >> rest;
        if (rest > 0 && w + whole + 1 < from.size()) moved |= from[w + whole + 1] << (64 - rest);
        to[w] |= moved;
    }
}

}  // namespace

/// Marks those x for which a cell x + first … x + end − 1 of a row is taken.
void CellRows::mark_blocked(const CellSpan& span, int y, std::vector<Word>& blocked,
                            std::vector<Word>& some) const {
    some.assign(row(y), row(y) + stride_);
    // After each round bit x stands for `count` cells from x on.
    const int length = span.end - span.first;
    for (int count = 1; count < length;) {
        const int more = std::min(count, length - count);
        // In place: words are read before those that they are added to are changed.
        add_moved(some, more, some);
        count += more;
    }
    add_moved(some, span.first, blocked);
}

std::optional<CellPlace> CellRows::find_room(const CellShape& shape, int lowest, int limit) const {
    if (shape.width > side_) return std::nullopt;
    std::vector<Word> outside(static_cast<std::size_t>(stride_), ~Word{0});
    for (int x = 0; x + shape.width <= side_; ++x) {
        outside[static_cast<std::size_t>(x / bits)] &= ~(Word{1} << (x % bits));
    }
    const auto is_full = [](const std::vector<Word>& words) {
        return std::all_of(words.begin(), words.end(), [](Word w) { return w == ~Word{0}; });
    };
    std::vector<Word> blocked, some;
    for (int y = lowest; y + shape.height < limit && y + shape.height <= side_; ++y) {
        blocked = outside;
        for (std::size_t k = 0; k < shape.spans.size(); ++k) {
            mark_blocked(shape.spans[k], y + shape.spans[k].row, blocked, some);
            if (k % 4 == 3 && is_full(blocked)) break;
        }
        for (int w = 0; w < stride_; ++w) {
            const Word free = ~blocked[static_cast<std::size_t>(w)];
            if (free != 0) return CellPlace{w * bits + std::countr_zero(free), y};
        }
    }
    return std::nullopt;
}

void CellRows::take(const CellShape& shape, CellPlace place) {
    for (const CellSpan& span : shape.spans) {
        const int first = std::max(0, place.x + span.first - 1);
        const int end = std::min(side_, place.x + span.end + 1);
        for (int y = std::max(0, place.y + span.row - 1);
             y <= std::min(side_ - 1, place.y + span.row + 1); ++y) {
            for (int x = first; x < end; ++x) {
                words_[static_cast<std::size_t>(y * stride_ + x / bits)] |= Word{1} << (x % bits);
            }
        }
    }
}

}  // namespace cascade
