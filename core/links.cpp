// Builds slices of links. Each cell keeps its links in their order. Links of weight 0 pad the cells
// that have fewer links than others.
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

/// Maps the cells of a list to their columns and rows in a plane. The links of cell i end before
/// ends[i].
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
    /// The links of the cell at this position; empty in the padding of a row.
    Range links_at(std::int64_t row, std::int64_t column) const {
        if (column >= layout_.width) return {};
        const auto last = static_cast<std::int64_t>(ends_.size()) - 1;
        const auto k = static_cast<std::size_t>(std::min(row * layout_.width + column, last));
        const std::size_t cell = order_.empty() ? k : order_[k];
        const std::size_t first = cell == 0 ? 0 : ends_[cell - 1];
        return {first, ends_[cell] - first};
    }

    /// The element of each cell of the list, counted from cell (0, 0).
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
        std::int64_t first = 0;  ///< The element of the slice's first cell.
        std::array<Range, slice_cells> links;
        std::array<std::int64_t, slice_cells> own{};

        /// The remaining links of the cell with the most remaining links; null if no links remain.
        const Range* longest() const {
            const auto most =
                std::max_element(links.begin(), links.end(),
                                 [](const Range& a, const Range& b) { return a.count < b.count; });
            return most->count > 0 ? &*most : nullptr;
        }
    };
    std::size_t slices_of_row() const {
        return (static_cast<std::size_t>(layout_.width) + slice_cells - 1) / slice_cells;
    }
    std::size_t slice_count() const {
        return slices_of_row() * static_cast<std::size_t>(layout_.height);
    }
    /// The cells of a slice. Slices are numbered row after row.
    Range cells_of(std::size_t number) const {
        const auto width = static_cast<std::size_t>(layout_.width);
        const std::size_t column = number % slices_of_row() * slice_cells;
        return {number / slices_of_row() * width + column, std::min(slice_cells, width - column)};
    }
    Slice slice(std::size_t number) const {
        constexpr auto lanes = static_cast<std::int64_t>(slice_cells);
        const auto row = static_cast<std::int64_t>(number / slices_of_row());
        const auto column = static_cast<std::int64_t>(number % slices_of_row()) * lanes;
        Slice slice;
        slice.first = layout_.row_start(row) + column;
        for (std::int64_t lane = 0; lane < lanes; ++lane) {
            const auto k = static_cast<std::size_t>(lane);
            slice.links[k] = links_at(row, column + lane);
            slice.own[k] = layout_.row_start(row) + std::min(column + lane, layout_.width - 1);
        }
        return slice;
    }
    /// Calls `use(slice)` for each slice.
    void for_each_slice(auto use) const {
        for (std::size_t number = 0; number < slice_count(); ++number) {
            Slice each = slice(number);
            use(each);
        }
    }

private:
    std::span<const std::size_t> ends_;
    const PlaneLayout& layout_;
    std::span<const std::uint32_t> order_;
};

/// Makes room for the offsets of more entries and returns the place of the first of these offsets.
std::int16_t* Links::add_offsets(std::size_t entries) {
    const std::size_t present = slices_.bases.size() * slice_cells,
                      all = present + entries * slice_cells;
    if (all * sizeof(std::int16_t) > slices_.offsets.bytes()) {
        AlignedArray<std::int16_t> larger(all + all / 2);
        std::copy_n(slices_.offsets.data(), present, larger.data());
        slices_.offsets = std::move(larger);
    }
    return slices_.offsets.data() + present;
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
    slices_.bases.push_back(static_cast<std::int32_t>(base));
    slices_.filled.push_back(static_cast<std::uint16_t>(filled));
}

Links::Links(const LinkList& list, const PlaneLayout& layout, Precision precision,
             std::span<const std::uint32_t> order) {
    const Placing placing(list.ends, layout, order);
    const std::vector<std::int32_t> elements = placing.elements();
    const auto target = [&](std::size_t link) {
        return std::int64_t{elements[list.neighbours[link]]};
    };
    slices_.starts.assign(1, 0);
    placing.for_each_slice([&](Placing::Slice& slice) {
        for (const Placing::Range& links : slice.links) {
            for (std::size_t k = 0; k < links.count; ++k) {
                const std::int64_t row = target(links.first + k) / layout.stride;
                reach_ = std::max(reach_, std::abs(row - slice.first / layout.stride));
            }
        }
        while (slice.longest() != nullptr) add_entry(slice, target);
        slices_.starts.push_back(static_cast<std::uint32_t>(slices_.bases.size()));
    });
    with_number(precision, [&](auto zero) {
        Weights<decltype(zero)> weights;
        weights.laplacian = AlignedArray<decltype(zero)>(slices_.bases.size() * slice_cells);
        for_each_link(placing, [&](std::size_t at, std::size_t link) {
            weights.laplacian.data()[at] = static_cast<decltype(zero)>(list.weights[link]);
        });
        weights_ = std::move(weights);
    });
    if (!list.gradients.empty()) *this = with_gradients(list.gradients, list.ends, layout, order);
}

/// Adds a slice whose links all lead near its first cell. `elements` are their targets, starting
/// with the first link of the first cell.
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
        slices_.filled.push_back(static_cast<std::uint16_t>(filled));
    }
    slices_.bases.insert(slices_.bases.end(), entries, static_cast<std::int32_t>(slice.first));
    for (std::size_t lane = 0; lane < slice_cells; ++lane) {
        const auto& links = slice.links[lane];
        if (links.count == 0) continue;
        const auto* const targets = elements.data() + (links.first - slice.links[0].first);
        for (std::size_t k = 0; k < links.count; ++k) {
            offsets[k * slice_cells + lane] = static_cast<std::int16_t>(targets[k] - slice.first);
        }
    }
}

// Nearly all slices have only near links. Near links fill each lane from the first entry on, so
// they are stored lane by lane.
void Links::add_slice(auto slice, const PlacedLinks& links, const PlaneLayout& layout,
                      std::vector<std::int32_t>& elements) {
    const double row_of_cell = 1 / static_cast<double>(layout.width);
    const auto beside_row = static_cast<std::int32_t>(layout.stride - layout.width);
    const std::size_t first = slice.links[0].first;
    std::size_t end = first;
    for (const Placing::Range& range : slice.links) end = std::max(end, range.first + range.count);
    elements.resize(end - first);
    auto least = static_cast<std::int32_t>(slice.first), most = least;
    for (std::size_t k = 0; k < elements.size(); ++k) {
        const auto cell = static_cast<std::int32_t>(links.neighbours[first + k]);
        // Truncation gives the correct row, because half a cell is far more than the product's
        // rounding error.
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
    slices_.starts.push_back(static_cast<std::uint32_t>(slices_.bases.size()));
}

/// Appends slices [first, end) of `from` unchanged.
void Links::copy_slices(const Slices& from, std::size_t first, std::size_t end) {
    const std::uint32_t begin = from.starts[first], count = from.starts[end] - begin;
    std::copy_n(from.offsets.data() + begin * slice_cells, count * slice_cells, add_offsets(count));
    const std::uint32_t shift = static_cast<std::uint32_t>(slices_.bases.size()) - begin;
    slices_.bases.insert(slices_.bases.end(), from.bases.begin() + begin,
                         from.bases.begin() + begin + count);
    slices_.filled.insert(slices_.filled.end(), from.filled.begin() + begin,
                          from.filled.begin() + begin + count);
    for (std::size_t slice = first + 1; slice <= end; ++slice) {
        slices_.starts.push_back(from.starts[slice] + shift);
    }
}

void Links::assign(const PlacedLinks& links, const PlaneLayout& layout, Precision precision,
                   const std::vector<bool>& changed) {
    CHECK(!links.ends.empty(), "links lead from at least one cell");
    CHECK(changed.empty() || slices_.cells > 0, "there is a table of which most is the same");
    with_number(precision, [&](auto zero) { weights_ = Weights<decltype(zero)>(); });
    if (!changed.empty()) std::swap(slices_, before_);
    if (slices_.offsets.is_shared()) slices_.offsets = {};
    slices_.bases.clear();
    slices_.filled.clear();
    slices_.starts.assign(1, 0);
    slices_.cells = links.ends.size();
    if (changed.empty()) reach_ = 1;
    const Placing placing(links.ends, layout, {});
    // Cells before this one are real cells, not padding, in both the new and the previous table.
    const std::size_t whole = std::min(before_.cells, slices_.cells) - 1;
    const auto is_kept = [&](std::size_t number) {
        const auto [first, count] = placing.cells_of(number);
        if (changed.empty() || first + count > whole) return false;
        const auto begin = changed.begin() + static_cast<std::ptrdiff_t>(first);
        return std::find(begin, begin + static_cast<std::ptrdiff_t>(count), true) ==
               begin + static_cast<std::ptrdiff_t>(count);
    };
    std::vector<std::int32_t> elements;
    for (std::size_t number = 0, end = 0; number < placing.slice_count(); number = end) {
        while (end < placing.slice_count() && is_kept(end)) ++end;
        if (end > number) {
            copy_slices(before_, number, end);
        } else {
            add_slice(placing.slice(end++), links, layout, elements);
        }
    }
}

/// Calls `use(at, link)` for each link, where `at` is its index in the arrays.
void Links::for_each_link(const Placing& placing, const auto& use) const {
    std::size_t entry = 0, slices = 0;
    placing.for_each_slice([&](Placing::Slice& slice) {
        for (const std::size_t end = slices_.starts[++slices]; entry < end; ++entry) {
            for (std::size_t lane = 0; lane < slice_cells; ++lane) {
                if ((slices_.filled[entry] >> lane & 1U) == 0) continue;
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
            component = AlignedArray<Number>(slices_.bases.size() * slice_cells);
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

Field Links::numbers_of(std::span<const double> numbers, std::span<const std::size_t> ends,
                        const PlaneLayout& layout, std::span<const std::uint32_t> order) const {
    Grid row;
    row.width = static_cast<std::int64_t>(slices_.bases.size() * slice_cells);
    row.height = 1;
    row.linked = true;
    Field plane(PlaneLayout(row), precision());
    plane.visit([&]<typename Number>(Plane<Number>& of_links) {
        Number* const to = of_links.origin();
        for_each_link(Placing(ends, layout, order), [&](std::size_t at, std::size_t link) {
            to[at] = static_cast<Number>(numbers[link]);
        });
    });
    return plane;
}

template <typename Number>
LinkTable<Number> Links::table() const {
    const auto& weights = *std::get_if<Weights<Number>>(&weights_);
    LinkTable<Number> table{slices_.starts.data(),
                            slices_.bases.data(),
                            slices_.offsets.data(),
                            weights.laplacian.data(),
                            {},
                            reach_,
                            slices_.filled.data()};
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
    return slices_.starts.size() * sizeof(std::uint32_t) + slices_.bases.size() * of_entry +
           weights;
}

}  // namespace cascade
