// Scales charts by powers of a number slightly below 1. Finds, by bisection, the largest power with
// which the charts fit.
#include "atlas/pack_charts.h"

#include "atlas/chart_box.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

namespace cascade {

namespace {

// The occupied cells of a grid, and the search for free cells (internal to atlas/).

/// Cells first … end − 1 of a row.
struct CellSpan {
    int row = 0, first = 0, end = 0;
};

/// A set of cells in a rectangle of width × height.
struct CellShape {
    int width = 0, height = 0;
    std::vector<CellSpan> spans;
};

struct CellPlace {
    int x = 0, y = 0;
};

class CellRows {
public:
    /// Makes a square of free cells.
    explicit CellRows(int side);

    /// Finds the free position for a shape with the smallest y and, among these, the smallest x. y
    /// is at least `lowest`, and y + height is below `limit`.
    std::optional<CellPlace> find_room(const CellShape& shape, int lowest, int limit) const;

    /// Occupies the cells of a shape and the eight cells around each of them.
    void take(const CellShape& shape, CellPlace place);

private:
    using Word = std::uint64_t;
    static constexpr int bits = 64;
    const Word* row(int y) const { return words_.data() + static_cast<std::size_t>(y * stride_); }
    void mark_blocked(const CellSpan& span, int y, std::vector<Word>& blocked,
                      std::vector<Word>& some) const;

    int side_, stride_;  ///< `side_` is in cells, `stride_` in words.
    /// One bit per cell: 1 if the cell is occupied. Each row has one extra word.
    std::vector<Word> words_;
};

CellRows::CellRows(int side)
    : side_(side),
      stride_((side + bits - 1) / bits + 1),
      words_(static_cast<std::size_t>(side * stride_)) {}

/// Moves bits down by `by`, shifting in zeros, and ORs them into `to`.
void add_moved(const std::vector<std::uint64_t>& from, int by, std::vector<std::uint64_t>& to) {
    const std::size_t whole = static_cast<std::size_t>(by / 64);
    const int rest = by % 64;
    for (std::size_t w = 0; w + whole < from.size(); ++w) {
        std::uint64_t moved = from[w + whole] >> rest;
        if (rest > 0 && w + whole + 1 < from.size()) moved |= from[w + whole + 1] << (64 - rest);
        to[w] |= moved;
    }
}

/// Marks each x for which one of the cells x + first … x + end − 1 of a row is occupied.
void CellRows::mark_blocked(const CellSpan& span, int y, std::vector<Word>& blocked,
                            std::vector<Word>& some) const {
    some.assign(row(y), row(y) + stride_);
    // After each round, bit x is the OR of the `count` cells that begin at x.
    const int length = span.end - span.first;
    for (int count = 1; count < length;) {
        const int more = std::min(count, length - count);
        // Works in place, because each word is read before it changes.
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

constexpr double step_of_scale = 0.98;
constexpr int most_steps = 700;  ///< 0.98⁷⁰⁰ is 10⁻⁶.
/// The largest size, in cells, of a shape that is tried in one orientation only.
constexpr int small_shape = 12;

Vector2d quarter_turned(Vector2d v, int quarters) {
    const std::array<Vector2d, 4> turned = {v, Vector2d{-v.y, v.x}, Vector2d{-v.x, -v.y},
                                            Vector2d{v.y, -v.x}};
    return turned[static_cast<std::size_t>(quarters)];
}

/// The cells that a scaled chart touches. The lower corner of the chart's bounds is the corner of a
/// cell.
CellShape shape_of_chart(const Chart& chart, double scale, int quarters) {
    FlatBox bounds;
    for (const Vector2d p : chart.places) bounds.add(quarter_turned(p, quarters) * scale);
    CellShape shape;
    const auto cell = [](double x) { return static_cast<int>(std::floor(x)); };
    shape.width = cell(bounds.size().x) + 1;
    shape.height = cell(bounds.size().y) + 1;
    std::vector<CellSpan> spans;
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
        FlatTriangle flat = chart.flat(n);
        for (Vector2d& p : flat) p = quarter_turned(p, quarters) * scale - bounds.low;
        const auto [low, high] = std::minmax({flat[0].y, flat[1].y, flat[2].y});
        for (int row = cell(low); row <= cell(high); ++row) {
            // The range along x in which the triangle covers this row.
            double left = std::numeric_limits<double>::infinity(), right = -left;
            for (std::size_t k = 0; k < 3; ++k) {
                Vector2d a = flat[k], b = flat[corner_after(k)];
                if (a.y > b.y) std::swap(a, b);
                if (b.y < row || a.y > row + 1) continue;
                const auto x_at = [&](double y) {
                    return b.y > a.y ? a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)) : a.x;
                };
                const double from = a.y < row ? x_at(row) : a.x;
                const double to = b.y > row + 1 ? x_at(row + 1) : b.x;
                left = std::min({left, from, to});
                right = std::max({right, from, to});
            }
            if (!(left <= right)) continue;
            spans.push_back({row, std::clamp(cell(left), 0, shape.width - 1),
                             std::clamp(cell(right), 0, shape.width - 1) + 1});
        }
    }
    std::sort(spans.begin(), spans.end(), [](const CellSpan& a, const CellSpan& b) {
        return std::pair(a.row, a.first) < std::pair(b.row, b.first);
    });
    for (const CellSpan& span : spans) {
        if (span.row >= shape.height) continue;
        if (!shape.spans.empty() && shape.spans.back().row == span.row &&
            span.first <= shape.spans.back().end) {
            shape.spans.back().end = std::max(shape.spans.back().end, span.end);
        } else {
            shape.spans.push_back(span);
        }
    }
    // Sorts the longest spans first, because they exclude most positions.
    std::stable_sort(shape.spans.begin(), shape.spans.end(),
                     [](const CellSpan& a, const CellSpan& b) {
                         return a.end - a.first > b.end - b.first;
                     });
    return shape;
}

struct Placed {
    int quarters = 0;
    CellPlace place;
};

class Packer {
public:
    Packer(std::span<Chart> charts, int cells) : charts_(charts), cells_(cells) {
        std::array<std::vector<double>, 3> sizes;
        for (Chart& chart : charts) {
            chart.turn(smallest_box(chart).turn);
            FlatBox bounds;
            for (const Vector2d p : chart.places) bounds.add(p);
            const Vector2d size = bounds.size();
            const double shorter = std::min(size.x, size.y), longer = std::max(size.x, size.y);
            sizes[0].push_back(longer);
            sizes[1].push_back(longer + shorter);
            sizes[2].push_back(shorter);
            for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
                area_ += double_area(chart.flat(n)) / 2;
            }
        }
        for (std::size_t k = 0; k < orders_.size(); ++k) {
            orders_[k].resize(charts.size());
            std::iota(orders_[k].begin(), orders_[k].end(), std::size_t{0});
            std::stable_sort(orders_[k].begin(), orders_[k].end(),
                             [&](std::size_t a, std::size_t b) {
                                 return sizes[k][a] > sizes[k][b];
                             });
        }
    }

    double run(const std::atomic<bool>& cancel) {
        for (const auto& order : orders_) {
            // Searches with this order of charts only if it fits at a smaller step than the best
            // order so far.
            if (fitting_ <= most_steps && !fits(fitting_ - 1, order, cancel)) continue;
            search(order, cancel);
            if (fitting_ > most_steps) break;  // Other orders would not fit either.
        }
        if (fitting_ > most_steps || cancel) return 0;
        return move_charts(best_, scale_of(fitting_));
    }

private:
    using Order = std::vector<std::size_t>;

    /// The number of cells per unit of length. At step 0 the charts' area equals the area of the
    /// square.
    double scale_of(int step) const {
        double scale = cells_ / std::sqrt(area_);
        for (int k = 0; k < step; ++k) scale *= step_of_scale;
        return scale;
    }

    /// Finds the first step at which the charts fit in this order, if it is below the best step so
    /// far.
    void search(const Order& order, const std::atomic<bool>& cancel) {
        // Begins at step 7, because charts usually fill at most three quarters of the square's
        // area.
        int too_large = -1;
        for (int next = std::min(7, fitting_ / 2); fitting_ - too_large > 1 && !cancel;) {
            if (!fits(next, order, cancel)) too_large = next;
            next = fitting_ <= most_steps ? (fitting_ + too_large) / 2
                                          : std::min(2 * too_large + 1, most_steps);
        }
    }

    /// Whether all charts fit into the square with the scale number `step`. If so, stores their
    /// positions.
    bool fits(int step, const Order& order, const std::atomic<bool>& cancel) {
        auto placed = place_all(scale_of(step), order, cancel);
        if (!placed) return false;
        fitting_ = step;
        best_ = *std::move(placed);
        return true;
    }

    std::optional<std::vector<Placed>> place_all(double scale, const Order& order,
                                                 const std::atomic<bool>& cancel) {
        // One row and one column of cells at the upper sides stay free. Half of their width is
        // later moved to the lower sides.
        CellRows rows(cells_ - 1);
        std::vector<Placed> placed(charts_.size());
        std::map<std::pair<int, int>, int> full_below;
        for (const std::size_t c : order) {
            if (cancel) return std::nullopt;
            std::optional<Placed> best;
            int limit = cells_;
            CellShape best_shape;
            for (int quarters = 0; quarters < 4; ++quarters) {
                CellShape shape = shape_of_chart(charts_[c], scale, quarters);
                const bool is_small = std::max(shape.width, shape.height) <= small_shape;
                int& lowest = full_below[{shape.width, shape.height}];
                if (auto place = rows.find_room(shape, is_small ? lowest : 0, limit)) {
                    limit = place->y + shape.height;
                    best = Placed{quarters, *place};
                    if (is_small) lowest = place->y;
                    best_shape = std::move(shape);
                }
                if (is_small && best) break;
            }
            if (!best) return std::nullopt;
            rows.take(best_shape, best->place);
            placed[c] = *best;
        }
        return placed;
    }

    /// Moves the charts to their positions and returns the factor by which they are scaled.
    double move_charts(const std::vector<Placed>& placed, double scale) {
        for (std::size_t c = 0; c < charts_.size(); ++c) {
            FlatBox bounds;
            for (Vector2d& p : charts_[c].places) {
                p = quarter_turned(p, placed[c].quarters) * scale;
                bounds.add(p);
            }
            const Vector2d corner = {placed[c].place.x + 0.5, placed[c].place.y + 0.5};
            for (Vector2d& p : charts_[c].places) {
                p = (p - bounds.low + corner) * (1.0 / cells_);
            }
        }
        return scale / cells_;
    }

    std::span<Chart> charts_;
    int cells_;
    double area_ = 0;
    std::array<Order, 3> orders_;   ///< Orders by three measures of size, the largest chart first.
    int fitting_ = most_steps + 1;  ///< The best step so far.
    std::vector<Placed> best_;      ///< The positions of the charts at this step.
};

}  // namespace

double pack_charts(std::span<Chart> charts, int cells, const std::atomic<bool>& cancel) {
    return Packer(charts, cells).run(cancel);
}

}  // namespace cascade
