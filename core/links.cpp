#include "core/links.h"

#include <algorithm>

namespace cascade {

namespace {

constexpr std::int64_t slice_cells = LinkTable<float>::slice_cells;

/// Which cell of the list stands at a place of the plane, or −1 in the padding of a row.
std::int64_t cell_at(std::int64_t row, std::int64_t column, const PlaneLayout& layout,
                     std::int64_t cells) {
    if (column >= layout.width) return -1;
    return std::min(row * layout.width + column, cells - 1);
}

template <typename Number>
void fill(AlignedArray<Number>& array, std::size_t entries, const auto& of_link,
          const std::vector<std::int64_t>& links) {
    array = AlignedArray<Number>(entries);
    for (std::size_t k = 0; k < entries; ++k) {
        if (links[k] >= 0) {
            array.data()[k] = static_cast<Number>(of_link(static_cast<std::size_t>(links[k])));
        }
    }
}

}  // namespace

Links::Links(const LinkList& list, const PlaneLayout& layout, Precision precision) {
    const auto cells = static_cast<std::int64_t>(list.ends.size());
    const std::int64_t slices = (layout.width + slice_cells - 1) / slice_cells;
    const auto first_of = [&](std::int64_t cell) {
        return cell == 0 ? std::size_t{0} : list.ends[static_cast<std::size_t>(cell - 1)];
    };
    const auto count_of = [&](std::int64_t cell) {
        return cell < 0 ? 0 : list.ends[static_cast<std::size_t>(cell)] - first_of(cell);
    };
    starts_.assign(1, 0);
    for (std::int64_t row = 0; row < layout.height; ++row) {
        for (std::int64_t slice = 0; slice < slices; ++slice) {
            std::size_t most = 0;
            for (std::int64_t lane = 0; lane < slice_cells; ++lane) {
                most = std::max(most, count_of(cell_at(row, slice * slice_cells + lane, layout, cells)));
            }
            starts_.push_back(starts_.back() + static_cast<std::uint32_t>(most));
        }
    }
    const std::size_t size = std::size_t{starts_.back()} * static_cast<std::size_t>(slice_cells);
    targets_ = AlignedArray<std::int32_t>(size);
    std::vector<std::int64_t> link_at(size, -1);  // The number of the link in the list.
    const auto place_of = [&](std::int64_t cell) {
        return static_cast<std::int32_t>(layout.row_start(cell / layout.width) +
                                         cell % layout.width);
    };
    for (std::int64_t row = 0; row < layout.height; ++row) {
        for (std::int64_t slice = 0; slice < slices; ++slice) {
            const auto number = static_cast<std::size_t>(row * slices + slice);
            for (std::int64_t lane = 0; lane < slice_cells; ++lane) {
                const std::int64_t column = slice * slice_cells + lane;
                const std::int64_t cell = cell_at(row, column, layout, cells);
                const std::size_t count = count_of(cell);
                for (std::uint32_t entry = starts_[number]; entry < starts_[number + 1]; ++entry) {
                    const std::size_t k = entry - starts_[number];
                    const std::size_t at =
                        std::size_t{entry} * slice_cells + static_cast<std::size_t>(lane);
                    if (k < count) {
                        const std::size_t link = first_of(cell) + k;
                        link_at[at] = static_cast<std::int64_t>(link);
                        targets_.data()[at] = place_of(list.neighbours[link]);
                    } else {
                        targets_.data()[at] = static_cast<std::int32_t>(
                            layout.row_start(row) + std::min(column, layout.width - 1));
                    }
                }
            }
        }
    }
    const auto make = [&]<typename Number>(Weights<Number> weights) {
        fill(weights.laplacian, size, [&](std::size_t link) { return list.weights[link]; }, link_at);
        if (!list.gradients.empty()) {
            fill(weights.gradients[0], size, [&](auto link) { return list.gradients[link].x; }, link_at);
            fill(weights.gradients[1], size, [&](auto link) { return list.gradients[link].y; }, link_at);
            fill(weights.gradients[2], size, [&](auto link) { return list.gradients[link].z; }, link_at);
        }
        weights_ = std::move(weights);
    };
    with_number(precision, [&](auto zero) { make(Weights<decltype(zero)>{}); });
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
