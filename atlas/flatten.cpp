// The linear system is the same in each round and is factorised once. No other file of atlas/
// includes Eigen.
#include "atlas/flatten.h"

#include <Eigen/SparseCholesky>

#include <cmath>
#include <limits>

namespace cascade {

namespace {

/// A triangle's own shape, and for each edge its weight, the cotangent of the opposite angle.
struct Rigid {
    FlatTriangle shape;
    std::array<double, 3> weights;
};

Rigid rigid_of(const SurfaceMesh& mesh, std::uint32_t triangle) {
    Rigid rigid{shape_of(mesh, triangle), {}};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d opposite = rigid.shape[corner_before(k)];
        const Vector2d a = rigid.shape[k] - opposite, b = rigid.shape[corner_after(k)] - opposite;
        rigid.weights[k] = dot(a, b) / cross(a, b);
    }
    return rigid;
}

/// The rotation that turns a triangle's edges closest to the edges of its image.
Vector2d best_turn(const Rigid& rigid, const FlatTriangle& image) {
    Vector2d sum{};
    for (std::size_t k = 0; k < 3; ++k) {
        const Vector2d own = rigid.shape[corner_after(k)] - rigid.shape[k];
        const Vector2d seen = image[corner_after(k)] - image[k];
        sum = sum + Vector2d{dot(own, seen), cross(own, seen)} * rigid.weights[k];
    }
    const double size = length(sum);
    return size > 0 ? sum * (1 / size) : Vector2d{1, 0};
}

class Flattening {
public:
    Flattening(const SurfaceMesh& mesh, Chart& chart)
        : chart_(chart), unknowns_(static_cast<Eigen::Index>(chart.places.size()) - 1) {
        for (const std::uint32_t triangle : chart.triangles) {
            rigid_.push_back(rigid_of(mesh, triangle));
        }
        factorise();
    }

    void find_places() {
        if (solver_.info() != Eigen::Success) {
            chart_.places.assign(chart_.places.size(),
                                 Vector2d{} * std::numeric_limits<double>::quiet_NaN());
            return;
        }
        Eigen::Matrix<double, Eigen::Dynamic, 2> sums =
            Eigen::Matrix<double, Eigen::Dynamic, 2>::Zero(unknowns_, 2);
        const auto add = [&](std::uint32_t place, Vector2d pull) {
            if (place == 0) return;
            sums(row(place), 0) += pull.x;
            sums(row(place), 1) += pull.y;
        };
        for (std::size_t n = 0; n < rigid_.size(); ++n) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Vector2d own = rigid_[n].shape[corner_after(k)] - rigid_[n].shape[k];
                const Vector2d pull = product(chart_.turns[n], own) * rigid_[n].weights[k];
                add(chart_.corners[n][corner_after(k)], pull);
                add(chart_.corners[n][k], pull * -1);
            }
        }
        const Eigen::Matrix<double, Eigen::Dynamic, 2> found = solver_.solve(sums);
        chart_.places[0] = {0, 0};
        for (std::uint32_t p = 1; p < chart_.places.size(); ++p) {
            chart_.places[p] = {found(row(p), 0), found(row(p), 1)};
        }
    }

    /// Sets the rotation of each triangle. Returns the mean square of the changes of rotations.
    double find_turns() {
        double sum = 0;
        for (std::size_t n = 0; n < rigid_.size(); ++n) {
            const Vector2d turn = best_turn(rigid_[n], chart_.flat(n));
            const Vector2d change = turn - chart_.turns[n];
            sum += dot(change, change);
            chart_.turns[n] = turn;
        }
        return sum / static_cast<double>(rigid_.size());
    }

private:
    /// The row of a position in the linear system. Position 0 is the origin, and the others are
    /// unknown.
    static Eigen::Index row(std::uint32_t place) { return static_cast<Eigen::Index>(place) - 1; }

    void factorise() {
        std::vector<Eigen::Triplet<double>> entries;
        entries.reserve(9 * rigid_.size());
        const auto add = [&](std::uint32_t a, std::uint32_t b, double weight) {
            // The matrix is symmetric, so its lower half is enough.
            if (a == 0 || b == 0 || a < b) return;
            entries.emplace_back(row(a), row(b), weight);
        };
        for (std::size_t n = 0; n < rigid_.size(); ++n) {
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t a = chart_.corners[n][k];
                const std::uint32_t b = chart_.corners[n][corner_after(k)];
                const double weight = rigid_[n].weights[k];
                add(a, a, weight);
                add(b, b, weight);
                add(std::max(a, b), std::min(a, b), -weight);
            }
        }
        Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
        matrix.setFromTriplets(entries.begin(), entries.end());
        solver_.compute(matrix);
    }

    Chart& chart_;
    Eigen::Index unknowns_;
    std::vector<Rigid> rigid_;
    Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower> solver_;
};

}  // namespace

void turn_towards(const SurfaceMesh& mesh, Vector3d axis, Chart& chart) {
    const Vector3d aside = std::abs(axis.x) < 0.6 ? Vector3d{1, 0, 0} : Vector3d{0, 1, 0};
    const Vector3d x = unit(cross(aside, axis)), y = cross(axis, x);
    for (std::size_t n = 0; n < chart.triangles.size(); ++n) {
        FlatTriangle seen;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d p = mesh.corner(chart.triangles[n], k);
            seen[k] = {dot(p, x), dot(p, y)};
        }
        chart.turns[n] = best_turn(rigid_of(mesh, chart.triangles[n]), seen);
    }
}

void flatten(const SurfaceMesh& mesh, Chart& chart, int rounds) {
    Flattening flattening(mesh, chart);
    constexpr double settled = 1e-6;  // The square of a thousandth of a radian.
    for (int k = 0; k < rounds; ++k) {
        flattening.find_places();
        if (flattening.find_turns() < settled) break;
    }
}

}  // namespace cascade
