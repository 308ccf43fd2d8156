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

/// Room for the offsets of entries after the present ones.
std::int16_t* Links::add_offsets(std::size_t entries) {
    const std::size_t present = bases_.size() * slice_cells, all = present + entries * slice_cells;
    if (all * sizeof(std::int16_t) > offsets_.bytes()) {
        AlignedArray<std::int16_t> larger(all + all / 2);
        std::copy_n(offsets_.data(), present, larger.data());
        offsets_ = std::move(larger);
    }
    return offsets_.data() + present;
}

/// Adds the next entry of a slice that has links left. `target(link)` is the element to which a
/// link leads.
void Links::add_entry(auto& slice, const auto& target) {
    const auto fits = [&](std::int64_t base, std::size_t link) {
        return fits_offset(target(link) - base);
    };
    const bool all_fit =
        std::all_of(slice.links.begin(), slice.links.end(), [&](const auto& links) {
            return links.count == 0 || fits(slice.first, links.first);
        });
    const std::int64_t base = all_fit ? slice.first : target(slice.longest()->first);
    std::int16_t* const offsets = add_offsets(1);
    unsigned filled = 0;
    for (std::size_t lane = 0; lane < slice_cells; ++lane) {
        auto& links = slice.links[lane];
        const bool has_link = links.count > 0 && fits(base, links.first);
        const std::int64_t offset =
            (has_link ? target(links.drop_first()) : slice.own[lane]) - base;
        offsets[lane] = fits_offset(offset) ? static_cast<std::int16_t>(offset) : std::int16_t{0};
        filled |= unsigned{has_link} << lane;
    }
    bases_.push_back(static_cast<std::int32_t>(base));
    filled_.push_back(static_cast<std::uint16_t>(filled));
}

Links::Links(const LinkList& list, const PlaneLayout& layout, Precision precision,
             std::span<const std::uint32_t> order) {
    const Placing placing(list.ends, layout, order);
    const std::vector<std::int32_t> elements = placing.elements();
    const auto target = [&](std::size_t link) {
        return std::int64_t{elements[list.neighbours[link]]};
    };
    starts_.assign(1, 0);
    placing.for_each_slice([&](Placing::Slice& slice) {
        for (const Placing::Range& links : slice.links) {
            for (std::size_t k = 0; k < links.count; ++k) {
                const std::int64_t row = target(links.first + k) / layout.stride;
                reach_ = std::max(reach_, std::abs(row - slice.first / layout.stride));
            }
        }
        while (slice.longest() != nullptr) add_entry(slice, target);
        starts_.push_back(static_cast<std::uint32_t>(bases_.size()));
    });
    with_number(precision, [&](auto zero) {
        Weights<decltype(zero)> weights;
        weights.laplacian = AlignedArray<decltype(zero)>(bases_.size() * slice_cells);
        for_each_link(placing, [&](std::size_t at, std::size_t link) {
            weights.laplacian.data()[at] = static_cast<decltype(zero)>(list.weights[link]);
        });
        weights_ = std::move(weights);
    });
    if (!list.gradients.empty()) *this = with_gradients(list.gradients, list.ends, layout, order);
}

/// Adds a slice all of whose links lead near its first cell. `elements` are the targets of its
/// links, from the first link of its first cell on.
void Links::add_near_slice(const auto& slice, std::span<const std::int32_t> elements) {
    const auto* const longest = slice.longest();
    const std::size_t entries = longest != nullptr ? longest->count : 0;
    std::int16_t* const offsets = add_offsets(entries);
    std::array<std::int16_t, slice_cells> own;
    for (std::size_t lane = 0; lane < slice_cells; ++lane) {
        own[lane] = static_cast<std::int16_t>(slice.own[lane] - slice.first);
    }
    for (std::size_t entry = 0; entry < entries; ++entry) {
        std::copy_n(own.data(), slice_cells, offsets + entry * slice_cells);
        unsigned filled = 0;
        for (std::size_t lane = 0; lane < slice_cells; ++lane) {
            filled |= unsigned{slice.links[lane].count > entry} << lane;
        }
        filled_.push_back(static_cast<std::uint16_t>(filled));
    }
    bases_.insert(bases_.end(), entries, static_cast<std::int32_t>(slice.first));
    for (std::size_t lane = 0; lane < slice_cells; ++lane) {
        const auto& links = slice.links[lane];
        if (links.count == 0) continue;
        const auto* const targets = elements.data() + (links.first - slice.links[0].first);
        for (std::size_t k = 0; k < links.count; ++k) {
            offsets[k * slice_cells + lane] = static_cast<std::int16_t>(targets[k] - slice.first);
        }
    }
}

// Nearly all slices lead near. Their links fill each lane from the first entry on, so they are
// placed lane by lane.
void Links::assign(const PlacedLinks& links, const PlaneLayout& layout, Precision precision) {
    CHECK(!links.ends.empty(), "links lead from at least one cell");
    with_number(precision, [&](auto zero) { weights_ = Weights<decltype(zero)>(); });
    if (offsets_.is_shared()) offsets_ = {};
    bases_.clear();
    filled_.clear();
    starts_.assign(1, 0);
    reach_ = 1;
    const double row_of_cell = 1 / static_cast<double>(layout.width);
    const auto beside_row = static_cast<std::int32_t>(layout.stride - layout.width);
    std::vector<std::int32_t> elements;
    const Placing placing(links.ends, layout, {});
    placing.for_each_slice([&](Placing::Slice& slice) {
        const std::size_t first = slice.links[0].first;
        std::size_t end = first;
        for (const Placing::Range& range : slice.links) {
            end = std::max(end, range.first + range.count);
        }
        elements.resize(end - first);
        auto least = static_cast<std::int32_t>(slice.first), most = least;
        for (std::size_t k = 0; k < elements.size(); ++k) {
            const auto cell = static_cast<std::int32_t>(links.neighbours[first + k]);
            // Exact: half a cell is far more than the product's error.
            const auto row = static_cast<std::int32_t>((cell + 0.5) * row_of_cell);
            elements[k] = cell + row * beside_row;
            least = std::min(least, elements[k]);
            most = std::max(most, elements[k]);
        }
        const std::int64_t row = slice.first / layout.stride;
        reach_ = std::max({reach_, row - least / layout.stride, most / layout.stride - row});
        if (fits_offset(least - slice.first) && fits_offset(most - slice.first)) {
            add_near_slice(slice, elements);
        } else {
            while (slice.longest() != nullptr) {
                add_entry(slice,
                          [&](std::size_t link) { return std::int64_t{elements[link - first]}; });
            }
        }
        starts_.push_back(static_cast<std::uint32_t>(bases_.size()));
    });
}

/// Calls `use(at, link)` for each link, where `at` is its place in the arrays.
void Links::for_each_link(const Placing& placing, const auto& use) const {
    std::size_t entry = 0, slices = 0;
    placing.for_each_slice([&](Placing::Slice& slice) {
        for (const std::size_t end = starts_[++slices]; entry < end; ++entry) {
            for (std::size_t lane = 0; lane < slice_cells; ++lane) {
                if ((filled_[entry] >> lane & 1U) == 0) continue;
                use(entry * slice_cells + lane, slice.links[lane].drop_first());
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
        for_each_link(Placing(ends, layout, order), put);
    };
    std::visit(add, links.weights_);
    return links;
}

template <typename Number>
LinkTable<Number> Links::table() const {
    const auto& weights = *std::get_if<Weights<Number>>(&weights_);
    LinkTable<Number> table{
        starts_.data(), bases_.data(), offsets_.data(), weights.laplacian.data(), {},
        reach_,         filled_.data()};
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
    const std::size_t of_entry =
        sizeof(std::int32_t) + sizeof(std::uint16_t) + slice_cells * sizeof(std::int16_t);
    return starts_.size() * sizeof(std::uint32_t) + bases_.size() * of_entry + weights;
}

}  // namespace cascade
