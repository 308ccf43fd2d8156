// Which cells are neighbours where cells lie on no grid, and how they lie in memory: sliced
// ELLPACK.
//
// Cells are numbered in rows as on a grid (PlaneLayout). Sixteen cells beside each other in a row
// are a slice; a slice has as many entries as the cell with the most neighbours in it, and an entry
// is sixteen links, one of each cell. So a vector of cells reads its neighbours' places and weights
// as vectors, and gathers their values. What fills up is a link to the cell itself of weight 0.
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

/// Links as kernels read them. Entry e of a slice is at [16·e, 16·e + 16); those of slice s are
/// starts[s] … starts[s + 1] − 1. Slice s of a plane of W columns is the one at column
/// 16·(s mod n) of row s / n, n = ⌈W/16⌉.
template <typename Number>
struct LinkTable {
    static constexpr std::int64_t slice_cells = PlaneLayout::row_pad;

    const std::uint32_t* starts = nullptr;
    const std::int32_t* targets = nullptr;  ///< Elements from cell (0, 0) to the neighbour.
    const Number* weights = nullptr;        ///< Of the neighbour's difference in a Laplacian.
    /// The same for the components of a gradient in space; null where nothing asks for them.
    std::array<const Number*, 3> gradients{};
};

/// The links of cells in the order of the cells: cell i's end before ends[i].
struct LinkList {
    std::vector<std::size_t> ends;
    std::vector<std::uint32_t> neighbours;  ///< Cells. The order is the order of sums.
    std::vector<double> weights;
    std::vector<Vector3d> gradients;  ///< Empty, or one for each link.
};

/// Elements that begin at a multiple of 64 bytes, zero at first.
template <typename T>
class AlignedArray {
public:
    AlignedArray() = default;
    explicit AlignedArray(std::size_t count)
        : count_(count), data_(static_cast<T*>(allocate_plane(count * sizeof(T)))) {}

    T* data() { return data_.get(); }
    const T* data() const { return data_.get(); }
    std::size_t bytes() const { return count_ * sizeof(T); }

private:
    struct Free {
        void operator()(T* data) const { free_plane(data); }
    };
    std::size_t count_ = 0;
    std::unique_ptr<T[], Free> data_;
};

/// Owns a table in one precision.
class Links {
public:
    Links() = default;
    /// Cell order[k] of the list, or k where no order is given, lies at column k mod width of row
    /// k / width. The cells after the last one, which fill the last row, are given links like it,
    /// so that they have its values. The order of sums is that of the list. Throws std::bad_alloc.
    Links(const LinkList& list, const PlaneLayout& layout, Precision precision,
          std::span<const std::uint32_t> order = {});

    /// Adds the weights of gradients, one for each link of the list that these links were made of,
    /// whose cells end at `ends`; layout and order are the same. Throws std::bad_alloc.
    void add_gradients(std::span<const Vector3d> gradients, std::span<const std::size_t> ends,
                       const PlaneLayout& layout, std::span<const std::uint32_t> order = {});

    Precision precision() const {
        return weights_.index() == 0 ? Precision::single : Precision::binary64;
    }
    template <typename Number>
    LinkTable<Number> table() const;
    std::size_t bytes() const;

private:
    template <typename Number>
    struct Weights {
        AlignedArray<Number> laplacian;
        std::array<AlignedArray<Number>, 3> gradients;
    };

    std::vector<std::uint32_t> starts_;
    AlignedArray<std::int32_t> targets_;
    std::variant<Weights<float>, Weights<double>> weights_;
};

}  // namespace cascade
