// Contains all uses of Eigen in solvers/: no other file there includes it.
#include "solvers/linked_laplacian.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <optional>

namespace cascade {
namespace {

/// The smallest s is this factor times the mean of the diagonal of −Δ, divided by the number of
/// cells. On a sphere this is a hundredth of the second eigenvalue of −Δ. If the surface has
/// several parts, each has an eigenvalue 0, and the effect of a smaller s would be lost in
/// rounding.
constexpr double least_shift = 0.03;

/// Calls `use(row, column, target, weight)` for each link of some rows. Elements are counted from
/// cell (0, 0).
template <typename Number>
void each_link(const LinkTable<Number>& table, const PlaneLayout& layout, RowRange rows,
               const auto& use) {
    constexpr std::int64_t lanes = LinkTable<Number>::slice_cells;
    const std::int64_t slices = (layout.width + lanes - 1) / lanes;
    for (std::int64_t row = rows.begin; row < rows.end; ++row) {
        for (std::int64_t column = 0; column < layout.width; ++column) {
            const std::int64_t slice = row * slices + column / lanes;
            for (std::int64_t entry = table.starts[slice]; entry < table.starts[slice + 1];
                 ++entry) {
                const std::int64_t link = lanes * entry + column % lanes;
                const Number weight = table.weights[link];
                if (weight == 0) continue;
                use(layout.row_start(row) + column, table.target(link), weight);
            }
        }
    }
}

}  // namespace

struct LinkedLaplacian::Factors {
    /// The elements of cells that are not left out, counted from cell (0, 0).
    std::vector<std::int64_t> elements;
    Eigen::VectorXd roots;  ///< The square roots of the cells' areas.
    /// The lower half of −Δ, made symmetric by the square roots.
    Eigen::SparseMatrix<double> matrix;
    double least_s = 0;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver;
    std::optional<double> shift;  ///< The s of the present factorisation.

    bool is_singular() const { return shift == least_s; }

    /// Subtracts the area-weighted mean, which is undetermined if s is 0. `values` are already
    /// multiplied by the square roots of areas. The order of summation must not depend on the width
    /// of vectors.
    void subtract_mean(Eigen::VectorXd& values) const {
        double sum = 0, area = 0;
        for (Eigen::Index k = 0; k < values.size(); ++k) {
            sum += values[k] * roots[k];
            area += roots[k] * roots[k];
        }
        values -= sum / area * roots;
    }
};

LinkedLaplacian::LinkedLaplacian(const Links& links, const PlaneLayout& layout, const Field* areas)
    : links_(links), layout_(layout), factors_(std::make_unique<Factors>()) {
    // The index of each element in `elements`; −1 for cells left out.
    std::vector<Eigen::Index> unknowns;
    std::vector<double> roots;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t column = 0; column < layout.width; ++column) {
            const double area = areas == nullptr ? 1 : areas->number_at(column, row);
            if (area == 0) continue;
            const std::int64_t at = layout.row_start(row) + column;
            unknowns.resize(static_cast<std::size_t>(at), -1);
            unknowns.push_back(static_cast<Eigen::Index>(roots.size()));
            factors_->elements.push_back(at);
            roots.push_back(std::sqrt(area));
        }
    }
    const auto unknown_at = [&](std::int64_t element) {
        const auto k = static_cast<std::size_t>(element);
        return k < unknowns.size() ? unknowns[k] : Eigen::Index{-1};
    };
    const auto count = static_cast<Eigen::Index>(roots.size());
    factors_->roots = Eigen::Map<Eigen::VectorXd>(roots.data(), count);
    std::vector<Eigen::Triplet<double>> entries;
    double diagonal = 0;
    with_number(links.precision(), [&](auto zero) {
        using Number = decltype(zero);
        each_link(links.table<Number>(), layout, {0, layout.row_count()},
                  [&](std::int64_t from, std::int64_t to, double weight) {
                      const Eigen::Index a = unknown_at(from), b = unknown_at(to);
                      if (a < 0 || b < 0) return;
                      entries.emplace_back(a, a, weight);
                      diagonal += weight;
                      if (b > a) return;
                      const double ratio = factors_->roots[a] / factors_->roots[b];
                      entries.emplace_back(a, b, -weight * ratio);
                  });
    });
    factors_->matrix.resize(count, count);
    factors_->matrix.setFromTriplets(entries.begin(), entries.end());
    factors_->least_s = least_shift * diagonal / static_cast<double>(count * count);
    factors_->solver.analyzePattern(factors_->matrix);
}

LinkedLaplacian::~LinkedLaplacian() = default;

template <typename Number>
void LinkedLaplacian::apply(const Number* u, Number* result, RowRange rows) const {
    for (std::int64_t row = rows.begin; row < rows.end; ++row) {
        const std::int64_t start = layout_.row_start(row);
        std::fill(result + start, result + start + layout_.width, Number{0});
    }
    each_link(links_.table<Number>(), layout_, rows,
              [&](std::int64_t from, std::int64_t to, Number weight) {
                  result[from] += weight * (u[to] - u[from]);
              });
}

bool LinkedLaplacian::factorise(double s) {
    const double shift = std::max(s, factors_->least_s);
    if (factors_->shift != shift) {
        factors_->shift = shift;
        factors_->solver.setShift(shift);
        factors_->solver.factorize(factors_->matrix);
    }
    return factors_->solver.info() == Eigen::Success;
}

template <typename Number>
void LinkedLaplacian::solve(const Number* f, Number* u, double a) {
    const std::vector<std::int64_t>& elements = factors_->elements;
    Eigen::VectorXd values(factors_->roots.size());
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        values[k] = factors_->roots[k] / -a * double{f[elements[static_cast<std::size_t>(k)]]};
    }
    if (factors_->is_singular()) factors_->subtract_mean(values);
    values = factors_->solver.solve(values).eval();
    if (factors_->is_singular()) factors_->subtract_mean(values);
    for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
        const std::int64_t start = layout_.row_start(row);
        std::fill(u + start, u + start + layout_.width, Number{0});
    }
    for (Eigen::Index k = 0; k < values.size(); ++k) {
        u[elements[static_cast<std::size_t>(k)]] =
            static_cast<Number>(values[k] / factors_->roots[k]);
    }
}

template void LinkedLaplacian::apply(const float*, float*, RowRange) const;
template void LinkedLaplacian::apply(const double*, double*, RowRange) const;
template void LinkedLaplacian::solve(const float*, float*, double);
template void LinkedLaplacian::solve(const double*, double*, double);

}  // namespace cascade
