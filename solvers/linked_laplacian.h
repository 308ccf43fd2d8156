// Preconditions by the inverse of Δ − s, the Laplacian of linked cells minus a number.
#pragma once

#include "core/links.h"
#include "core/plane.h"

#include <cstdint>
#include <memory>

namespace cascade {

/// Solves a (Δ − s) u = f by a sparse Cholesky factorisation in double precision (Eigen).
/// Multiplying cells by the square roots of their areas makes the matrix symmetric.
class LinkedLaplacian {
public:
    /// With this number of cells or more, the factors would take gigabytes.
    static constexpr std::int64_t most_cells = std::int64_t{1} << 20U;

    /// Cells with area 0 are left out. Without `areas`, all cells have the same area. Throws
    /// std::bad_alloc.
    LinkedLaplacian(const Links& links, const PlaneLayout& layout, const Field* areas);
    ~LinkedLaplacian();
    LinkedLaplacian(const LinkedLaplacian&) = delete;
    LinkedLaplacian& operator=(const LinkedLaplacian&) = delete;

    /// Writes Δ u in some rows.
    template <typename Number>
    void apply(const Number* u, Number* result, RowRange rows) const;

    /// Factorises Δ − s for s ≥ 0, unless the last call had the same s. In place of s = 0, uses a
    /// number that is small compared to every eigenvalue of −Δ except the smallest, which is 0.
    /// Returns false on failure, which is possible if links have weights below 0. Throws
    /// std::bad_alloc.
    bool factorise(double s);
    /// Solves for f with the s of the last factorise(). Writes u, and 0 in cells that are left out.
    /// If s is 0, subtracts the area-weighted means of f and u.
    template <typename Number>
    void solve(const Number* f, Number* u, double a);

private:
    struct Factors;

    const Links& links_;
    PlaneLayout layout_;
    std::unique_ptr<Factors> factors_;
};

}  // namespace cascade
