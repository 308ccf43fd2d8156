// The inverse of a Laplacian of linked cells minus a number, as a preconditioner.
#pragma once

#include "core/links.h"
#include "core/plane.h"

#include <cstdint>
#include <memory>

namespace cascade {

/// Solves a (Δ − s) u = f by a sparse Cholesky factorisation in double precision (Eigen). Cells
/// times the roots of their areas make the matrix symmetric.
class LinkedLaplacian {
public:
    /// From this number of cells on, the factors would take gigabytes.
    static constexpr std::int64_t most_cells = std::int64_t{1} << 20U;

    /// Cells with area 0 are left out. Without `areas`, all are alike. Throws std::bad_alloc.
    LinkedLaplacian(const Links& links, const PlaneLayout& layout, const Field* areas);
    ~LinkedLaplacian();
    LinkedLaplacian(const LinkedLaplacian&) = delete;
    LinkedLaplacian& operator=(const LinkedLaplacian&) = delete;

    /// Writes Δ u in some rows.
    template <typename Number>
    void apply(const Number* u, Number* result, RowRange rows) const;

    /// Factorises for s ≥ 0, unless that was done last. For 0, uses a number that is small compared
    /// to all eigenvalues but the first. Returns false on failure, which is possible if links have
    /// weights below 0. Throws std::bad_alloc.
    bool factorise(double s);
    /// Writes u for the s of factorise(), and 0 in the cells left out. If s is 0, subtracts the
    /// means of f and u, weighted by areas.
    template <typename Number>
    void solve(const Number* f, Number* u, double a);

private:
    struct Factors;

    const Links& links_;
    PlaneLayout layout_;
    std::unique_ptr<Factors> factors_;
};

}  // namespace cascade
