// A plane of values, one per cell of a grid, with a halo.
#pragma once

#include "core/side.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>

namespace cascade {

/// Zeroed memory, aligned to 64 bytes; large planes lie in huge pages where the system has them,
/// because a step walks through eight and more of them at once. Throws std::bad_alloc.
void* allocate_plane(std::size_t bytes);
void free_plane(void* plane);

/// Owns one value per cell in the layout of PlaneLayout, aligned to 64 bytes and zero at first.
/// Movable; a copy is made only when asked for by clone().
template <typename T>
class Plane {
public:
    Plane() = default;
    explicit Plane(const PlaneLayout& layout)
        : layout_(layout),
          data_(static_cast<T*>(allocate_plane(bytes(layout)))) {}

    bool empty() const { return !data_; }
    const PlaneLayout& layout() const { return layout_; }

    /// Address of cell (0, 0, 0); cell (i, j) of slice k is at
    /// `origin() + k * layout().slice_stride + j * layout().stride + i`.
    T* origin() { return data_.get() + layout_.offset(0, 0); }
    const T* origin() const { return data_.get() + layout_.offset(0, 0); }
    /// A row by its number through all slices, 0 … layout().row_count() − 1.
    T* row(std::int64_t number) { return origin() + layout_.row_start(number); }
    const T* row(std::int64_t number) const { return origin() + layout_.row_start(number); }
    /// A cell, which may be one of the halo.
    T& at(std::int64_t i, std::int64_t j, std::int64_t k = 0) {
        return data_[static_cast<std::size_t>(layout_.offset(i, j, k))];
    }
    T at(std::int64_t i, std::int64_t j, std::int64_t k = 0) const {
        return data_[static_cast<std::size_t>(layout_.offset(i, j, k))];
    }

    Plane clone() const {
        Plane copy(layout_);
        if (data_) std::memcpy(copy.data_.get(), data_.get(), bytes(layout_));
        return copy;
    }

    static std::size_t bytes(const PlaneLayout& layout) {
        return static_cast<std::size_t>(layout.size()) * sizeof(T);
    }

private:
    struct Free {
        void operator()(T* data) const { free_plane(data); }
    };
    PlaneLayout layout_;
    std::unique_ptr<T[], Free> data_;
};

using Field = Plane<float>;         ///< A species, or a parameter that varies over the surface.
using Mask = Plane<std::uint8_t>;   ///< 1 where a cell is frozen, else 0.

/// Fills the halo of a field, edges and corners included: columns −1 and width, rows −1 and height
/// and, where there is more than one slice, slices −1 and depth, by the rules of its sides.
/// Columns come first, then rows with the halo columns, then slices with both.
void fill_halo(float* origin, const PlaneLayout& layout, const SideRules& sides);

/// All of the halo whose values come from rows [begin, end), numbered through all slices. Threads
/// that call it on parts of the rows have filled the whole halo together, without reading each
/// other's rows.
void fill_halo_from_rows(float* origin, const PlaneLayout& layout, const SideRules& sides,
                         std::int64_t begin, std::int64_t end);

}  // namespace cascade
