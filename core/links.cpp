// Builds the slices: the links of a cell in the order of its list, padded by links of weight 0.
#include "core/links.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr std::size_t slice_cells = LinkTable<float>::slice_cells;

constexpr bool fits_offset(std::int64_t elements) {
    return elements == static_cast<std::int16_t>(elements);
}

}  // namespace

/// The positions of a list's cells in the rows of a plane. The links of cell i end before ends[i].
class Links::Placing {
public:
    Placing(std::span<const std::size_t> ends, const PlaneLayout& layout,
            std::span<const std::uint32_t> order)
        : ends_(ends), layout_(layout), order_(order) {
        CHECK(order.empty() || order.size() == ends.size(), "an order has all cells");
    }

    struct Range {
        std::size_t first = 0, count = 0;
        std::size_t drop_first() {
            --count;
            return first++;
        }
    };
    /// The links of the cell at this position; none in the padding of a row.
    Range links_at(std::int64_t row, std::int64_t column) const {
        if (column >= layout_.width) return {};
        const auto last = static_cast<std::int64_t>(ends_.size()) - 1;
        const auto k = static_cast<std::size_t>(std::min(row * layout_.width + column, last));
        const std::size_t cell = order_.empty() ? k : order_[k];
        const std::size_t first = cell == 0 ? 0 : ends_[cell - 1];
        return {first, ends_[cell] - first};
    }

    /// For each cell of the list, its element counted from cell (0, 0).
    std::vector<std::int32_t> elements() const {
        std::vector<std::int32_t> result(ends_.size());
        for (std::size_t k = 0; k < result.size(); ++k) {
            const auto place = static_cast<std::int64_t>(k);
            result[order_.empty() ? k : order_[k]] = static_cast<std::int32_t>(
                layout_.row_start(place / layout_.width) + place % layout_.width);
        }
        return result;
    }

    struct Slice {
        std::int64_t first = 0;  ///< The element of its first cell.
        std::array<Range, slice_cells> links;
        std::array<std::int64_t, slice_cells> own{};

        /// Null if no links are left.
        const Range* longest() const {
            const auto most =
                std::max_element(links.begin(), links.end(),
                                 [](const Range& a, const Range& b) { return a.count < b.count; });
            return most->count > 0 ? &*most : nullptr;
        }
    };
    /// Calls `use(slice)` for each slice, row after row.
    void for_each_slice(auto use) const {
        constexpr auto lanes = static_cast<std::int64_t>(slice_cells);
        for (std::int64_t row = 0; row < layout_.height; ++row) {
            for (std::int64_t column = 0; column < layout_.width; column += lanes) {
                Slice slice;
                slice.first = layout_.row_start(row) + column;
                for (std::int64_t lane = 0; lane < lanes; ++lane) {
                    const auto k = static_cast<std::size_t>(lane);
                    slice.links[k] = links_at(row, column + lane);
                    slice.own[k] =
                        layout_.row_start(row) + std::min(column + lane, layout_.width - 1);
                }
                use(slice);
            }
        }
    }

private:
    std::span<const std::size_t> ends_;
    const PlaneLayout& layout_;
    std::span<const std::uint32_t> order_;
};

Links::Links(const LinkList& list, const PlaneLayout& layout, Precision precision,
             std::span<const std::uint32_t> order) {
    const Placing placing(list.ends, layout, order);
    const std::vector<std::int32_t> elements = placing.elements();
    const auto target = [&](std::size_t link) { return elements[list.neighbours[link]]; };
    starts_.assign(1, 0);
    placing.for_each_slice([&](Placing::Slice& slice) {
        while (const Placing::Range* const some = slice.longest()) {
            const auto fits = [&](std::int64_t base, std::size_t link) {
                return fits_offset(target(link) - base);
            };
            const bool all_fit =
                std::all_of(slice.links.begin(), slice.links.end(),
                            [&](const Placing::Range& links) {
                                return links.count == 0 || fits(slice.first, links.first);
                            });
            const std::int64_t base = all_fit ? slice.first : target(some->first);
            unsigned filled = 0;
            for (std::size_t lane = 0; lane < slice_cells; ++lane) {
                Placing::Range& links = slice.links[lane];
                if (links.count == 0 || !fits(base, links.first)) continue;
                filled |= 1U << lane;
                const std::int64_t there = target(links.drop_first()) / layout.stride;
                reach_ = std::max(reach_, std::abs(there - slice.first / layout.stride));
            }
            bases_.push_back(static_cast<std::int32_t>(base));
            filled_.push_back(static_cast<std::uint16_t>(filled));
        }
        starts_.push_back(static_cast<std::uint32_t>(bases_.size()));
    });
    offsets_ = AlignedArray<std::int16_t>(bases_.size() * slice_cells);
    with_number(precision, [&](auto zero) {
        Weights<decltype(zero)> weights;
        weights.laplacian = AlignedArray<decltype(zero)>(bases_.size() * slice_cells);
        const auto set_offset = [&](std::size_t at, std::int64_t element) {
            const std::int64_t offset = element - bases_[at / slice_cells];
            if (fits_offset(offset)) offsets_.data()[at] = static_cast<std::int16_t>(offset);
        };
        const auto put = [&](std::size_t at, std::size_t link) {
            set_offset(at, target(link));
            weights.laplacian.data()[at] = static_cast<decltype(zero)>(list.weights[link]);
        };
        for_each_element(placing, put, set_offset);
        weights_ = std::move(weights);
    });
    if (!list.gradients.empty()) *this = with_gradients(list.gradients, list.ends, layout, order);
}

/// Calls `use(at, link)` for each link and `fill_up(at, own)` for each padding link, where `at` is
/// its place in the arrays and `own` the element of its cell.
void Links::for_each_element(const Placing& placing, const auto& use, const auto& fill_up) const {
    std::size_t entry = 0, slices = 0;
    placing.for_each_slice([&](Placing::Slice& slice) {
        for (const std::size_t end = starts_[++slices]; entry < end; ++entry) {
            for (std::size_t lane = 0; lane < slice_cells; ++lane) {
                const std::size_t at = entry * slice_cells + lane;
                if ((filled_[entry] >> lane & 1U) != 0) {
                    use(at, slice.links[lane].drop_first());
                } else {
                    fill_up(at, slice.own[lane]);
                }
            }
        }
    });
}

Links Links::with_gradients(std::span<const Vector3d> gradients, std::span<const std::size_t> ends,
                            const PlaneLayout& layout, std::span<const std::uint32_t> order) const {
    Links links = *this;
    const auto add = [&]<typename Number>(Weights<Number>& weights) {
        for (auto& component : weights.gradients) {
            component = AlignedArray<Number>(bases_.size() * slice_cells);
        }
        const auto put = [&](std::size_t at, std::size_t link) {
            weights.gradients[0].data()[at] = static_cast<Number>(gradients[link].x);
            weights.gradients[1].data()[at] = static_cast<Number>(gradients[link].y);
            weights.gradients[2].data()[at] = static_cast<Number>(gradients[link].z);
        };
        for_each_element(Placing(ends, layout, order), put, [](auto...) {});
    };
    std::visit(add, links.weights_);
    return links;
}

template <typename Number>
LinkTable<Number> Links::table() const {
    const auto& weights = *std::get_if<Weights<Number>>(&weights_);
    LinkTable<Number> table{
        starts_.data(), bases_.data(), offsets_.data(), weights.laplacian.data(), {}, reach_};
    for (std::size_t k = 0; k < 3; ++k) table.gradients[k] = weights.gradients[k].data();
    return table;
}

template LinkTable<float> Links::table<float>() const;
template LinkTable<double> Links::table<double>() const;

std::size_t Links::bytes() const {
    const std::size_t weights = std::visit(
        [](const auto& all) {
            std::size_t sum = all.laplacian.bytes();
            for (const auto& each : all.gradients) sum += each.bytes();
            return sum;
        },
        weights_);
    return (starts_.size() + bases_.size()) * sizeof(std::uint32_t) + offsets_.bytes() + weights;
}

}  // namespace cascade
