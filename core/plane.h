// A plane of values, one per cell of a grid, with a halo.
#pragma once

#include "core/check.h"
#include "core/patch.h"
#include "core/precision.h"
#include "core/side.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <new>
#include <utility>
#include <variant>

namespace cascade {

/// Zeroed memory, aligned to 64 bytes. Large planes use huge pages if the system has them, because
/// a step reads at least eight planes at once. Pages are cleared when a thread first touches them,
/// so threads share that work, and unused planes take no memory. Throws std::bad_alloc.
void* allocate_plane(std::size_t bytes);
void free_plane(void* plane);

/// Fills the halo of a plane, edges and corners included, by the rules of its sides: columns −1 and
/// width, then rows −1 and height with their halo columns. If there are several slices, then slices
/// −1 and depth follow with their halo rows and columns.
template <typename Number>
void fill_halo(Number* origin, const PlaneLayout& layout, const SideRules& sides);

/// Fills all halo cells that kernels read and whose values come from the cells of `patch`. If a
/// slice has a single row, leaves out the rows above and below it, because no stencil reads them.
/// Threads with disjoint patches fill the whole halo without reading each other's cells.
template <typename Number>
void fill_halo_from(Number* origin, const PlaneLayout& layout, const SideRules& sides,
                    const Patch& patch);

/// Owns one value per cell in the layout of PlaneLayout, aligned to 64 bytes and initially zero.
/// Movable. Copied only explicitly: by clone(), or together with its owner.
template <typename T>
class Plane {
public:
    Plane() = default;
    explicit Plane(const PlaneLayout& layout)
        : layout_(layout), data_(static_cast<T*>(allocate_plane(bytes(layout)))) {}
    explicit Plane(const Plane& other) {
        if (other.empty()) return;
        *this = Plane(other.layout_);
        std::memcpy(data_.get(), other.data_.get(), bytes(layout_));
    }
    Plane(Plane&&) = default;
    Plane& operator=(Plane&&) = default;

    bool empty() const { return !data_; }
    const PlaneLayout& layout() const { return layout_; }

    /// Address of cell (0, 0, 0). Cell (i, j) of slice k is at `origin() + k *
    /// layout().slice_stride + j * layout().stride + i`.
    T* origin() { return data_.get() + layout_.offset(0, 0); }
    const T* origin() const { return data_.get() + layout_.offset(0, 0); }
    /// A row by its number through all slices, 0 … layout().row_count() − 1.
    T* row(std::int64_t number) { return origin() + layout_.row_start(number); }
    const T* row(std::int64_t number) const { return origin() + layout_.row_start(number); }
    /// A cell, which may be in the halo.
    T& at(std::int64_t i, std::int64_t j, std::int64_t k = 0) {
        return data_[static_cast<std::size_t>(layout_.offset(i, j, k))];
    }
    T at(std::int64_t i, std::int64_t j, std::int64_t k = 0) const {
        return data_[static_cast<std::size_t>(layout_.offset(i, j, k))];
    }

    Plane clone() const { return Plane(*this); }

    /// The halo caches values that follow from the rules of the sides. It is not part of a plane's
    /// value. Code that reads neighbours fills it first, even in a const plane. Only one thread at
    /// a time may do so.
    void fill_halo(const SideRules& sides) const {
        cascade::fill_halo(data_.get() + layout_.offset(0, 0), layout_, sides);
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

using Mask = Plane<std::uint8_t>;  ///< 1 if a cell is frozen, else 0.

/// The values of a species or of a varying parameter, in the run's precision and in this process's
/// memory. Loops over cells (core/counted_cells.h) are written for a `Plane<Number>`, which visit()
/// selects once. If the precision is known, rows are accessed as in a plane:
/// `field.row<double>(j)`, or `field.row(j)` for binary32. A pointer into a field is valid until
/// the field is assigned, moved from or destroyed.
class Field {
public:
    Field() = default;
    explicit Field(const PlaneLayout& layout, Precision precision = Precision::single) {
        if (precision == Precision::single) {
            cells_ = Plane<float>(layout);
        } else {
            cells_ = Plane<double>(layout);
        }
    }
    template <typename Number>
    explicit Field(Plane<Number> plane) : cells_(std::move(plane)) {}
    explicit Field(const Field&) = default;
    Field(Field&&) = default;
    Field& operator=(Field&&) = default;

    Precision precision() const {
        return cells_.index() == 0 ? Precision::single : Precision::binary64;
    }
    /// Calls `look` with the field's plane, which is a `Plane<float>` or a `Plane<double>`.
    template <typename Look>
    decltype(auto) visit(Look&& look) {
        return std::visit(std::forward<Look>(look), cells_);
    }
    template <typename Look>
    decltype(auto) visit(Look&& look) const {
        return std::visit(std::forward<Look>(look), cells_);
    }

    bool empty() const {
        return visit([](const auto& plane) { return plane.empty(); });
    }
    const PlaneLayout& layout() const {
        return visit([](const auto& plane) -> const PlaneLayout& { return plane.layout(); });
    }
    Field clone() const { return Field(*this); }
    void fill_halo(const SideRules& sides) const;  ///< See Plane::fill_halo().
    /// A copy in another precision, including the halo. Rounds if the other precision is lower.
    Field converted(Precision precision) const;

    template <typename Number = float>
    Plane<Number>& plane() {
        CHECK(precision() == precision_of<Number>, "a field is read in its own precision");
        return *std::get_if<Plane<Number>>(&cells_);
    }
    template <typename Number = float>
    const Plane<Number>& plane() const {
        CHECK(precision() == precision_of<Number>, "a field is read in its own precision");
        return *std::get_if<Plane<Number>>(&cells_);
    }
    template <typename Number = float>
    Number* origin() {
        return plane<Number>().origin();
    }
    template <typename Number = float>
    const Number* origin() const {
        return plane<Number>().origin();
    }
    template <typename Number = float>
    Number* row(std::int64_t number) {
        return plane<Number>().row(number);
    }
    template <typename Number = float>
    const Number* row(std::int64_t number) const {
        return plane<Number>().row(number);
    }
    template <typename Number = float>
    Number& at(std::int64_t i, std::int64_t j, std::int64_t k = 0) {
        return plane<Number>().at(i, j, k);
    }
    template <typename Number = float>
    Number at(std::int64_t i, std::int64_t j, std::int64_t k = 0) const {
        return plane<Number>().at(i, j, k);
    }
    /// The value of a cell, converted to double if the field is in binary32.
    double number_at(std::int64_t i, std::int64_t j, std::int64_t k = 0) const {
        return visit([&](const auto& plane) { return static_cast<double>(plane.at(i, j, k)); });
    }

    static std::size_t bytes(const PlaneLayout& layout, Precision precision = Precision::single) {
        return static_cast<std::size_t>(layout.size()) * bytes_of(precision);
    }

private:
    std::variant<Plane<float>, Plane<double>> cells_;
};

}  // namespace cascade
