// Moves the values of cells in all planes at once.
#include "tissue/tissue.h"

#include "core/check.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <type_traits>
#include <utility>

namespace cascade {
namespace {

/// Calls `use(address, first cell, number of cells)` for each row that holds some of the cells
/// [first, end).
template <typename Number>
void for_each_row(Plane<Number>& plane, std::size_t first, std::size_t end, const auto& use) {
    const auto width = static_cast<std::size_t>(plane.layout().width);
    while (first < end) {
        const std::size_t column = first % width, count = std::min(width - column, end - first);
        use(plane.row(static_cast<std::int64_t>(first / width)) + column, first, count);
        first += count;
    }
}

std::size_t capacity_of(const PlaneLayout& layout) {
    return static_cast<std::size_t>(layout.width * layout.height);
}

/// Copies the values of the last of `count` cells to all elements after it.
template <typename Number>
void fill_after(Plane<Number>& plane, std::size_t count) {
    const auto width = static_cast<std::size_t>(plane.layout().width);
    const std::size_t last = std::max<std::size_t>(count, 1) - 1;
    const Number value =
        count == 0 ? Number{} : plane.row(static_cast<std::int64_t>(last / width))[last % width];
    for_each_row(plane, count, capacity_of(plane.layout()),
                 [&](Number* row, auto, auto places) { std::fill_n(row, places, value); });
}

/// Writes the values of the cells from `first` on, and copies the last cell's value to all elements
/// after it.
template <typename Number>
void write(Plane<Number>& plane, std::span<const Number> values, std::size_t first = 0) {
    for_each_row(plane, first, first + values.size(), [&](Number* row, auto begin, auto count) {
        std::copy_n(values.data() + (begin - first), count, row);
    });
    fill_after(plane, first + values.size());
}

template <typename Number>
std::vector<Number> read(const Plane<Number>& plane, std::span<const std::uint32_t> cells) {
    const auto width = static_cast<std::uint32_t>(plane.layout().width);
    std::vector<Number> values;
    values.reserve(cells.size());
    for (const std::uint32_t cell : cells) values.push_back(plane.row(cell / width)[cell % width]);
    return values;
}

Field field_of(const std::vector<double>& values, const PlaneLayout& layout, Precision precision) {
    Field field(layout, precision);
    with_number(precision, [&](auto zero) {
        using Number = decltype(zero);
        const std::vector<Number> rounded(values.begin(), values.end());
        write<Number>(field.plane<Number>(), rounded);
    });
    return field;
}

std::vector<std::vector<double>> numbers_in(const std::vector<Field>& fields,
                                            std::span<const std::uint32_t> cells) {
    std::vector<std::vector<double>> result;
    for (const Field& field : fields) {
        if (field.empty()) {
            result.emplace_back();
            continue;
        }
        field.visit([&](const auto& plane) {
            const auto values = read(plane, cells);
            result.emplace_back(values.begin(), values.end());
        });
    }
    return result;
}

/// Copies cell sources[k] to index places[k] for all k. There are `count` cells in the new layout.
/// If the layout stays the same, all other cells stay. If the layout changes, `places` must include
/// all cells.
void rearrange_field(Field& field, const PlaneLayout& layout, std::size_t count,
                     std::span<const std::uint32_t> places,
                     std::span<const std::uint32_t> sources) {
    field.visit([&]<typename Number>(Plane<Number>& plane) {
        const std::vector<Number> values = read(plane, sources);
        if (plane.layout() != layout) plane = Plane<Number>(layout);
        const auto width = static_cast<std::uint32_t>(layout.width);
        for (std::size_t k = 0; k < places.size(); ++k) {
            plane.row(places[k] / width)[places[k] % width] = values[k];
        }
        fill_after(plane, count);
    });
}

/// Does the same as rearrange_field() for a vector with a value for each cell.
template <typename Value>
void rearrange_values(std::vector<Value>& values, std::size_t count,
                      std::span<const std::uint32_t> places,
                      std::span<const std::uint32_t> sources) {
    std::vector<Value> moved;
    moved.reserve(sources.size());
    for (const std::uint32_t source : sources) moved.push_back(values[source]);
    values.resize(count);
    for (std::size_t k = 0; k < places.size(); ++k) values[places[k]] = moved[k];
}

void set_in(Field& field, std::int64_t element, double value) {
    field.visit([&]<typename Number>(Plane<Number>& plane) {
        plane.origin()[element] = static_cast<Number>(value);
    });
}

}  // namespace

Tissue::Tissue(const TissueRecord& record, Precision precision)
    : triangles(record.triangles),
      next_number(record.next_number),
      births(record.births),
      deaths(record.deaths),
      time(record.time),
      precision_(precision),
      numbers_(record.numbers) {
    choose_layout(numbers_.size());
    triangles.resize(numbers_.size(), no_triangle);
    restlessness.resize(numbers_.size());
    for (const std::vector<double>& values : record.species) {
        CHECK(values.size() == count(), "a value for each cell");
        species.push_back(field_of(values, layout_, precision_));
    }
    for (const std::vector<double>& values : record.stiffest) {
        CHECK(values.size() == count(), "a value for each cell");
        stiffest.push_back(field_of(values, layout_, precision_));
    }
    for (const std::vector<double>& values : record.kept) {
        CHECK(values.empty() || values.size() == count(), "a value for each cell");
        kept.push_back(values.empty() ? Field() : field_of(values, layout_, precision_));
    }
    frozen_by_ = record.frozen;
    by_number_.resize(count());
    std::iota(by_number_.begin(), by_number_.end(), std::uint32_t{0});
    std::sort(by_number_.begin(), by_number_.end(),
              [&](std::uint32_t a, std::uint32_t b) { return numbers_[a] < numbers_[b]; });
    number_cells(0);
    find_frozen();
}

TissueRecord Tissue::record() const {
    TissueRecord result;
    for (const std::uint32_t cell : by_number_) {
        result.numbers.push_back(numbers_[cell]);
        result.triangles.push_back(triangles[cell]);
    }
    result.species = numbers_in(species, by_number_);
    result.stiffest = numbers_in(stiffest, by_number_);
    result.kept = numbers_in(kept, by_number_);
    result.frozen = frozen_by_;
    result.next_number = next_number;
    result.births = births;
    result.deaths = deaths;
    result.time = time;
    return result;
}

/// Chooses the layout of planes. If there are few cells, rows are short, so that few elements
/// repeat the last cell.
void Tissue::choose_layout(std::size_t cells) {
    const std::size_t wanted = cells + cells / 8 + 1;
    const std::size_t width = wanted <= 256 ? 16 : 64;
    grid_ = Grid{};
    grid_.width = static_cast<std::int64_t>(width);
    grid_.height = static_cast<std::int64_t>((wanted + width - 1) / width);
    grid_.linked = true;
    layout_ = PlaneLayout(grid_);
}

/// Fills all arrays that depend on the cells' numbers. The arrays already have the cells before
/// `first`.
void Tissue::number_cells(std::size_t first) {
    ranks_.resize(count());
    elements_by_number_.clear();
    for (std::uint32_t rank = 0; rank < count(); ++rank) {
        ranks_[by_number_[rank]] = rank;
        elements_by_number_.push_back(static_cast<std::uint32_t>(element(by_number_[rank])));
    }
    if (number_plane_.empty() || number_plane_.layout() != layout_) {
        number_plane_ = Field(layout_, precision_);
        inside_ = Mask(layout_);
        ones_ = Field(layout_, precision_);
        first = 0;
    }
    number_plane_.visit([&]<typename Number>(Plane<Number>& plane) {
        using Word = std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>;
        std::vector<Number> words;
        for (std::size_t cell = first; cell < count(); ++cell) {
            words.push_back(std::bit_cast<Number>(static_cast<Word>(numbers_[cell])));
        }
        write<Number>(plane, words, first);
    });
    const auto fill_ones = [&](auto* row, auto begin, auto places) {
        for (std::size_t i = 0; i < places; ++i) row[i] = begin + i < count() ? 1 : 0;
    };
    for_each_row(inside_, first, capacity_of(layout_), fill_ones);
    ones_.visit([&](auto& plane) { for_each_row(plane, first, capacity_of(layout_), fill_ones); });
}

bool Tissue::rearrange(std::span<const std::uint32_t> sources,
                       std::span<const std::uint32_t> born) {
    const PlaneLayout before = layout_;
    const std::size_t room = capacity_of(layout_), cells = sources.size();
    if (cells > room || cells < room / 4) choose_layout(cells);
    // The indices whose cells change, and the old indices of their new cells.
    std::vector<std::uint32_t> places, from;
    for (std::uint32_t k = 0; k < cells; ++k) {
        if (layout_ == before && k < count() && sources[k] == k) continue;
        places.push_back(k);
        from.push_back(sources[k]);
    }
    for (std::vector<Field>* const fields : {&species, &stiffest, &kept}) {
        for (Field& field : *fields) {
            if (!field.empty()) rearrange_field(field, layout_, cells, places, from);
        }
    }
    keep_order(sources, born);
    rearrange_values(triangles, cells, places, from);
    rearrange_values(restlessness, cells, places, from);
    rearrange_values(numbers_, cells, places, from);
    for (const std::uint32_t place : born) numbers_[place] = next_number++;
    number_cells(places.empty() ? cells : places[0]);
    find_frozen();
    return layout_ != before;
}

/// Updates the order of cells by number. New cells come at the end.
void Tissue::keep_order(std::span<const std::uint32_t> sources,
                        std::span<const std::uint32_t> born) {
    constexpr std::uint32_t nowhere = 0xffffffff;
    std::vector<std::uint32_t> places(count(), nowhere);
    std::vector<bool> is_born(sources.size(), false);
    for (const std::uint32_t place : born) is_born[place] = true;
    for (std::uint32_t k = 0; k < sources.size(); ++k) {
        if (!is_born[k]) places[sources[k]] = k;
    }
    std::vector<std::uint32_t> order;
    order.reserve(sources.size());
    for (const std::uint32_t cell : by_number_) {
        if (places[cell] != nowhere) order.push_back(places[cell]);
    }
    order.insert(order.end(), born.begin(), born.end());
    by_number_ = std::move(order);
}

void Tissue::freeze_by(std::size_t kept_plane) {
    frozen_by_ = kept_plane;
    find_frozen();
}

bool Tissue::is_frozen() const {
    return std::ranges::all_of(by_number_, [&](std::uint32_t cell) { return is_frozen(cell); });
}

void Tissue::find_frozen() {
    if (!frozen_by_) return;
    if (frozen_.empty() || frozen_.layout() != layout_) frozen_ = Mask(layout_);
    kept[*frozen_by_].visit([&](const auto& plane) {
        for_each_row(frozen_, 0, capacity_of(layout_),
                     [&](std::uint8_t* row, auto first, auto places) {
                         for (std::size_t i = 0; i < places; ++i) {
                             row[i] = plane.origin()[element(first + i)] != 0 ? 1 : 0;
                         }
                     });
    });
}

void Tissue::pad() {
    if (count() == 0) return;
    for (Field& field : species) {
        field.visit([&](auto& plane) { fill_after(plane, count()); });
    }
}

void Tissue::set(std::size_t species_index, std::size_t cell, double value) {
    set_in(species[species_index], element(cell), value);
}

void Tissue::set_kept(std::size_t kept_index, std::size_t cell, double value) {
    set_in(kept[kept_index], element(cell), value);
}

}  // namespace cascade
