// Builds the slices: the links of a cell in the order of its list, padded by links of weight 0.
#include "core/links.h"

#include "core/check.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr std::int64_t slice_cells = LinkTable<float>::slice_cells;

/// The positions of a list's cells in the rows of a plane. The links of cell i end before ends[i].
class Placing {
public:
    Placing(std::span<const std::size_t> ends, const PlaneLayout& layout,
            std::span<const std::uint32_t> order)
        : ends_(ends), layout_(layout), order_(order) {
        CHECK(order.empty() || order.size() == ends.size(), "an order has all cells");
    }

    struct Range {
        std::size_t first = 0, count = 0;
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
    std::vector<std::int32_t> offsets() const {
        std::vector<std::int32_t> result(ends_.size());
        for (std::size_t k = 0; k < result.size(); ++k) {
            const auto place = static_cast<std::int64_t>(k);
            result[order_.empty() ? k : order_[k]] = static_cast<std::int32_t>(
                layout_.row_start(place / layout_.width) + place % layout_.width);
        }
        return result;
    }

    std::int64_t slices_of_row() const { return (layout_.width + slice_cells - 1) / slice_cells; }

    /// Calls `use(at, link)` for each link and `fill_up(at, row, column)` for each padding element.
    /// `at` is the index of the element, with slices that begin at the entries `starts`.
    void for_each(const std::vector<std::uint32_t>& starts, const auto& use,
                  const auto& fill_up) const {
        for (std::int64_t row = 0; row < layout_.height; ++row) {
            for (std::int64_t column = 0; column < slices_of_row() * slice_cells; ++column) {
                const auto slice =
                    static_cast<std::size_t>(row * slices_of_row() + column / slice_cells);
                const auto lane = static_cast<std::size_t>(column % slice_cells);
                const Range links = links_at(row, column);
                for (std::uint32_t entry = starts[slice]; entry < starts[slice + 1]; ++entry) {
                    const std::size_t at = std::size_t{entry} * slice_cells + lane;
                    const std::size_t k = entry - starts[slice];
                    if (k < links.count) {
                        use(at, links.first + k);
                    } else {
                        fill_up(at, row, column);
                    }
                }
            }
        }
    }

private:
    std::span<const std::size_t> ends_;
    const PlaneLayout& layout_;
    std::span<const std::uint32_t> order_;
};

}  // namespace

Links::Links(const LinkList& list, const PlaneLayout& layout, Precision precision,
             std::span<const std::uint32_t> order) {
    const Placing placing(list.ends, layout, order);
    starts_.assign(1, 0);
    for (std::int64_t row = 0; row < layout.height; ++row) {
        for (std::int64_t slice = 0; slice < placing.slices_of_row(); ++slice) {
            std::size_t most = 0;
            for (std::int64_t lane = 0; lane < slice_cells; ++lane) {
                most = std::max(most, placing.links_at(row, slice * slice_cells + lane).count);
            }
            starts_.push_back(starts_.back() + static_cast<std::uint32_t>(most));
        }
    }
    const std::size_t size = std::size_t{starts_.back()} * static_cast<std::size_t>(slice_cells);
    targets_ = AlignedArray<std::int32_t>(size);
    const std::vector<std::int32_t> offsets = placing.offsets();
    const auto make = [&]<typename Number>(Weights<Number> weights) {
        weights.laplacian = AlignedArray<Number>(size);
        const auto put = [&](std::size_t at, std::size_t link) {
            targets_.data()[at] = offsets[list.neighbours[link]];
            weights.laplacian.data()[at] = static_cast<Number>(list.weights[link]);
        };
        const auto put_itself = [&](std::size_t at, std::int64_t row, std::int64_t column) {
            targets_.data()[at] = static_cast<std::int32_t>(layout.row_start(row) +
                                                            std::min(column, layout.width - 1));
        };
        placing.for_each(starts_, put, put_itself);
        weights_ = std::move(weights);
    };
    with_number(precision, [&](auto zero) { make(Weights<decltype(zero)>{}); });
    if (!list.gradients.empty()) *this = with_gradients(list.gradients, list.ends, layout, order);
}

Links Links::with_gradients(std::span<const Vector3d> gradients, std::span<const std::size_t> ends,
                            const PlaneLayout& layout, std::span<const std::uint32_t> order) const {
    Links links = *this;
    const Placing placing(ends, layout, order);
    const std::size_t size = std::size_t{starts_.back()} * static_cast<std::size_t>(slice_cells);
    const auto add = [&]<typename Number>(Weights<Number>& weights) {
        for (auto& component : weights.gradients) component = AlignedArray<Number>(size);
        const auto put = [&](std::size_t at, std::size_t link) {
            weights.gradients[0].data()[at] = static_cast<Number>(gradients[link].x);
            weights.gradients[1].data()[at] = static_cast<Number>(gradients[link].y);
            weights.gradients[2].data()[at] = static_cast<Number>(gradients[link].z);
        };
        placing.for_each(starts_, put, [](auto...) {});
    };
    std::visit(add, links.weights_);
    return links;
}

template <typename Number>
LinkTable<Number> Links::table() const {
    const auto& weights = *std::get_if<Weights<Number>>(&weights_);
    LinkTable<Number> table{starts_.data(), targets_.data(), weights.laplacian.data(), {}};
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
    return starts_.size() * sizeof(std::uint32_t) + targets_.bytes() + weights;
}

}  // namespace cascade
