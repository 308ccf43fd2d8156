// The neighbours of cells that lie on no grid, stored as sliced ELLPACK (Monakov et al. 2010).
//
// Cells are numbered in rows as on a grid (PlaneLayout). Sixteen adjacent cells of a row form a
// slice. An entry of a slice holds one link of each of the sixteen cells, so a slice has as many
// entries as the largest number of links of one cell. A vector of cells thus loads the positions
// and weights of its neighbours as vectors and gathers their values. Padding links have weight 0
// and lead to the cell itself.
//
// Neighbours are near each other in memory, so an entry holds 16-bit offsets from a base element:
// the first cell of the slice or, if some link leads too far, the target of some link. Links whose
// targets are still too far away are put into a later entry. If a padding link is too far from its
// own cell, its offset is 0.
#pragma once

#include "core/grid.h"
#include "core/plane.h"
#include "core/precision.h"
#include "core/vector3.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

namespace cascade {

/// Links as kernels read them. The links of entry e have the indices 16·e … 16·e + 15 in the arrays
/// of links, and slice s has the entries starts[s] … starts[s + 1] − 1. In a plane of W columns,
/// slice s is at column 16·(s mod n) of row ⌊s/n⌋, with n = ⌈W/16⌉.
template <typename Number>
struct LinkTable {
    static constexpr std::int64_t slice_cells = PlaneLayout::row_pad;

    const std::uint32_t* starts = nullptr;
    /// The number of elements from cell (0, 0) to the base of each entry.
    const std::int32_t* bases = nullptr;
    const std::int16_t* offsets = nullptr;  ///< Numbers of elements from the base to the neighbour.
    /// Factor of (neighbour − cell) in a Laplacian; null if the links have no weights.
    const Number* weights = nullptr;
    /// The factors for the components of a gradient in space; null unless requested.
    std::array<const Number*, 3> gradients{};
    std::int64_t reach = 1;  ///< The largest number of rows that a link spans; at least 1.
    const std::uint16_t* filled =
        nullptr;  ///< Bit k of an entry's number is set if lane k has a link in this entry.

    /// The element to which a link leads, counted from cell (0, 0).
    std::int64_t target(std::int64_t link) const {
        return std::int64_t{bases[link / slice_cells]} + offsets[link];
    }
};

/// The links of all cells, cell after cell. The links of cell i end before ends[i].
struct LinkList {
    std::vector<std::size_t> ends;
    std::vector<std::uint32_t> neighbours;  ///< Cell indices, in the order of summation.
    std::vector<double> weights;
    std::vector<Vector3d> gradients;  ///< Empty, or one per link.
};

/// Links without weights between cells in memory order, for links that change while cells move. The
/// links of cell k end before ends[k].
struct PlacedLinks {
    std::span<const std::size_t> ends;
    std::span<const std::uint32_t> neighbours;  ///< Cells, in the order of summation.
};

/// An array aligned to 64 bytes, initially zero. Copies share it.
template <typename T>
class AlignedArray {
public:
    AlignedArray() = default;
    explicit AlignedArray(std::size_t count)
        : count_(count), data_(static_cast<T*>(allocate_plane(count * sizeof(T))), free_plane) {}

    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t bytes() const { return count_ * sizeof(T); }
    bool is_shared() const { return data_.use_count() > 1; }

private:
    std::size_t count_ = 0;
    std::shared_ptr<T[]> data_;
};

/// Owns a table of links in one precision. Copies share its arrays, which only assign() changes.
class Links {
public:
    Links() = default;
    /// Cell order[k] of the list, or cell k if `order` is empty, is at column k mod width of row k
    /// / width. Padding cells that complete the last row get the links of the last cell, and thus
    /// its values. Links stay in the list's order, which is the order of summation. Throws
    /// std::bad_alloc.
    Links(const LinkList& list, const PlaneLayout& layout, Precision precision,
          std::span<const std::uint32_t> order = {});

    /// Replaces the table by `links`, which have no weights. Reuses the present memory if it is
    /// large enough and not shared with a copy. Invalidates earlier tables. `links` have at least
    /// one cell and at most as many cells as `layout`. Cell k is at column k mod width of row k /
    /// width. Padding cells get the links of the last cell. Throws std::bad_alloc.
    ///
    /// `changed` is empty, or says for each cell whether its links differ from the present table,
    /// which then must have the same layout and precision. Slices without changes are copied.
    void assign(const PlacedLinks& links, const PlaneLayout& layout, Precision precision,
                const std::vector<bool>& changed = {});

    /// A copy with gradient weights, one for each link of the list given to the constructor.
    /// `ends`, `layout` and `order` must be the same as in the constructor. Throws std::bad_alloc.
    Links with_gradients(std::span<const Vector3d> gradients, std::span<const std::size_t> ends,
                         const PlaneLayout& layout,
                         std::span<const std::uint32_t> order = {}) const;

    /// A plane in one row with a number for each link of this table: element k, counted from cell
    /// (0, 0), belongs to the link at k in the arrays of a LinkTable, and is 0 for padding links.
    /// `numbers` contains a number for each link of the list given to the constructor. `ends`,
    /// `layout` and `order` must be the same as in the constructor. Throws std::bad_alloc.
    Field numbers_of(std::span<const double> numbers, std::span<const std::size_t> ends,
                     const PlaneLayout& layout, std::span<const std::uint32_t> order = {}) const;

    Precision precision() const {
        return weights_.index() == 0 ? Precision::single : Precision::binary64;
    }
    template <typename Number>
    LinkTable<Number> table() const;
    std::size_t bytes() const;

private:
    class Placing;
    template <typename Number>
    struct Weights {
        AlignedArray<Number> laplacian;
        std::array<AlignedArray<Number>, 3> gradients;
    };

    /// The arrays of a table, built slice by slice.
    struct Slices {
        std::vector<std::uint32_t> starts;
        std::vector<std::int32_t> bases;
        std::vector<std::uint16_t> filled;
        AlignedArray<std::int16_t> offsets;
        std::size_t cells = 0;  ///< Number of cells without padding cells.
    };

    void add_slice(auto slice, const PlacedLinks& links, const PlaneLayout& layout,
                   std::vector<std::int32_t>& elements);
    void copy_slices(const Slices& from, std::size_t first, std::size_t end);
    void add_entry(auto& slice, const auto& target);
    void add_near_slice(const auto& slice, std::span<const std::int32_t> elements);
    std::int16_t* add_offsets(std::size_t entries);
    void for_each_link(const Placing& placing, const auto& use) const;

    std::int64_t reach_ = 1;
    Slices slices_, before_;  ///< The present table, and the memory of the previous one.
    std::variant<Weights<float>, Weights<double>> weights_;
};

}  // namespace cascade
