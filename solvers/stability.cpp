// Eigenvalues of the Jacobian of the rates by power iteration.
//
// The Jacobian J is never formed: J v is the central difference of the rates along v. Each species
// is measured in units of its own root mean square, because species may differ in size. This
// changes no eigenvalue. Plain iteration finds the eigenvalue of largest magnitude. If it is
// positive, iterating with J − c, where c > 0 is its magnitude, moves the spectrum to the left and
// finds the most negative eigenvalue. Eigenvalues are computed from the last three iterates w, Jw,
// JJw. A least-squares fit gives p and q in JJw + p Jw + q w = 0. The roots of λ² + pλ + q = 0 are
// the eigenvalues. This covers a single leading eigenvalue and a leading pair, real or complex (J.
// H. Wilkinson, "The Algebraic Eigenvalue Problem", 1965, chapter 9).
#include "solvers/stability.h"

#include "core/check.h"
#include "solvers/pass_runner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <vector>

namespace cascade {
namespace {

/// The relative error for diffusion on a plane is about 1 / (2 · iterations). Large grids get fewer
/// iterations, so that a user whose run has failed need not wait.
constexpr std::size_t least_iterations = 16, most_iterations = 200;
constexpr std::size_t entries_to_visit = 50'000'000;

/// The largest change that a central difference makes to a value, in units of the root mean square
/// of the value's species. This step is near the cube root of the relative rounding error, where
/// the difference's truncation and rounding errors are equal.
double difference_step(Precision precision) {
    return precision == Precision::single ? 0.005 : 6e-6;
}

using Vector = std::vector<double>;  ///< Numbers by species, row and column, without halo.

double dot(const Vector& a, const Vector& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
    return sum;
}

/// Fixed noise in (−1, 1) that contains every mode, made by the SplitMix64 mixer of a counter (G.
/// Steele, D. Lea, C. Flood, "Fast splittable pseudorandom number generators", OOPSLA 2014).
double noise(std::uint64_t number) {
    std::uint64_t word = (number + 1) * 0x9e3779b97f4a7c15ULL;
    word = (word ^ (word >> 30)) * 0xbf58476d1ce4e5b9ULL;
    word = (word ^ (word >> 27)) * 0x94d049bb133111ebULL;
    word ^= word >> 31;
    return static_cast<double>(word >> 11) * 0x1p-52 - 1.0;
}

/// The Jacobian of a kernel of rates at a state, as an operator on vectors.
class Jacobian {
public:
    Jacobian(const StepProblem& rates, std::span<const Field> species, const Mask* frozen,
             const std::atomic<bool>* cancel)
        : rates_(rates),
          layout_(rates.grid),
          state_(species),
          moves_(layout_),
          team_(1),
          runner_(rates),
          cancel_(cancel) {
        runner_.prepare(worker_, 0, 1);
        for_each_cell([&](std::size_t, std::int64_t i, std::int64_t row) {
            moves_.row(row)[i] = frozen && frozen->row(row)[i] ? 0 : 1;
        });
        for (const Field& field : species) {
            CHECK(field.layout() == layout_, "species lie as the grid says");
            moved_.emplace_back(layout_, rates.precision);
            rates_of_.emplace_back(layout_, rates.precision);
            scales_.push_back(
                field.visit([&](const auto& plane) { return root_mean_square(plane); }));
        }
        // A species that is zero everywhere gets the scale of the largest species. A species that
        // has almost died out gets at least a billionth of that scale. With a smaller scale,
        // differences would be lost among denormals.
        const double largest = *std::max_element(scales_.begin(), scales_.end());
        for (double& scale : scales_) {
            if (!(scale > 0)) scale = largest > 0 ? largest : 1;
            scale = std::max(scale, 1e-9 * largest);
        }
    }

    std::size_t size() const { return cells() * state_.size(); }

    /// J v − shift · v.
    Vector multiply(const Vector& v, double shift) {
        double largest = 0;
        for (const double value : v) largest = std::max(largest, std::abs(value));
        const double step = largest > 0 ? difference_step(rates_.precision) / largest : 1;
        Vector product(v.size());
        add_rates(v, step, 0.5 / step, product);
        add_rates(v, -step, -0.5 / step, product);
        for (std::size_t n = 0; n < v.size(); ++n) product[n] -= shift * v[n];
        return product;
    }

    /// A vector of noise that is zero in frozen cells.
    Vector start() const {
        Vector v(size());
        for (std::size_t k = 0; k < state_.size(); ++k) {
            for_each_cell([&](std::size_t n, std::int64_t i, std::int64_t row) {
                const std::size_t entry = k * cells() + n;
                v[entry] = noise(entry) * moves_.row(row)[i];
            });
        }
        return v;
    }

private:
    std::size_t cells() const {
        return static_cast<std::size_t>(layout_.width * layout_.row_count());
    }

    /// Calls `visit(n, i, row)` for each cell: cell n is in column i of row `row`, and rows are
    /// counted through all slices.
    template <typename Visit>
    void for_each_cell(Visit visit) const {
        std::size_t n = 0;
        for (std::int64_t row = 0; row < layout_.row_count(); ++row) {
            for (std::int64_t i = 0; i < layout_.width; ++i) visit(n++, i, row);
        }
    }

    template <typename Number>
    double root_mean_square(const Plane<Number>& field) const {
        double squares = 0;
        for_each_cell([&](std::size_t, std::int64_t i, std::int64_t row) {
            squares += static_cast<double>(field.row(row)[i]) * field.row(row)[i];
        });
        return std::sqrt(squares / static_cast<double>(cells()));
    }

    /// Adds weight · rates(state + step · v) to `sum`, in units of the scales. Frozen cells have
    /// rate 0.
    void add_rates(const Vector& v, double step, double weight, Vector& sum) {
        with_number(rates_.precision,
                    [&](auto zero) { add_rates_of<decltype(zero)>(v, step, weight, sum); });
    }

    template <typename Number>
    void add_rates_of(const Vector& v, double step, double weight, Vector& sum) {
        for (std::size_t k = 0; k < state_.size(); ++k) {
            const double* entries = v.data() + k * cells();
            const double scaled_step = step * scales_[k];
            const Plane<Number>& state = state_[k].template plane<Number>();
            Plane<Number>& moved = moved_[k].template plane<Number>();
            for_each_cell([&](std::size_t n, std::int64_t i, std::int64_t row) {
                moved.row(row)[i] =
                    static_cast<Number>(state.row(row)[i] + scaled_step * entries[n]);
            });
        }
        run_kernel();
        for (std::size_t k = 0; k < state_.size(); ++k) {
            double* entries = sum.data() + k * cells();
            const double scaled_weight = weight / scales_[k];
            const Plane<Number>& rates = rates_of_[k].template plane<Number>();
            for_each_cell([&](std::size_t n, std::int64_t i, std::int64_t row) {
                // Tests the mask instead of multiplying by it, because a frozen cell may have any
                // rate, even an infinite one.
                if (moves_.row(row)[i] != 0) entries[n] += scaled_weight * rates.row(row)[i];
            });
        }
    }

    void run_kernel() {
        rates_.fill_halos(moved_);
        const std::array<std::span<Field>, 2> registers{moved_, rates_of_};
        // White noise needs a step whose length is not 0. The noise cancels in differences.
        team_.run([&](int) { runner_.run(worker_, team_, registers, {0, 0, 1, 1, cancel_}); });
    }

    const StepProblem& rates_;
    PlaneLayout layout_;
    std::span<const Field> state_;
    Mask moves_;  ///< Is 1 where a cell is not frozen.
    std::vector<Field> moved_, rates_of_;
    std::vector<double> scales_;
    Team team_;
    PassRunner runner_;
    PassRunner::Worker worker_;
    const std::atomic<bool>* cancel_;
};

/// Chooses p and q so that |w₂ + p w₁ + q w₀| is smallest, where w₀ has length 1. Returns the root
/// of λ² + pλ + q of larger magnitude, or either root of a complex pair.
std::complex<double> leading_root(const Vector& w0, const Vector& w1, const Vector& w2) {
    const double along = dot(w0, w1);  // The Rayleigh quotient.
    const double across = dot(w1, w1) - along * along;
    // If w₁ is parallel to w₀, there is a single eigenvalue. Differences in single precision
    // determine directions to about 1e-4.
    if (across <= 1e-7 * dot(w1, w1)) return along;
    const double p = -(dot(w1, w2) - along * dot(w0, w2)) / across;
    const double q = -(dot(w0, w2) + p * along);
    const std::complex<double> root = std::sqrt(std::complex<double>(p * p / 4 - q));
    return p > 0 ? -p / 2 - root : -p / 2 + root;
}

/// The eigenvalue of largest magnitude of J − shift; 0 if the rates are not finite.
std::complex<double> leading_eigenvalue(Jacobian& jacobian, double shift) {
    const std::size_t iterations =
        std::clamp(entries_to_visit / jacobian.size(), least_iterations, most_iterations);
    Vector w0 = jacobian.start();
    Vector w1;
    for (std::size_t iteration = 1;; ++iteration) {
        const double length = std::sqrt(dot(w0, w0));
        if (!std::isfinite(length) || length < 1e-30) return 0;
        for (double& value : w0) value /= length;
        w1 = jacobian.multiply(w0, shift);
        if (iteration == iterations) break;
        w0.swap(w1);
    }
    const Vector w2 = jacobian.multiply(w1, shift);
    const std::complex<double> found = leading_root(w0, w1, w2);
    return std::isfinite(found.real()) && std::isfinite(found.imag()) ? found : 0;
}

}  // namespace

StabilityEstimate estimate_stability(const StepProblem& rates, std::span<const Field> species,
                                     const Mask* frozen, const std::atomic<bool>* cancel) {
    CHECK(!rates.passes.empty() && !species.empty(), "a kernel of rates and its species");
    Jacobian jacobian(rates, species, frozen, cancel);
    std::complex<double> fastest = leading_eigenvalue(jacobian, 0);
    StabilityEstimate estimate;
    estimate.eigenvalue = fastest.real();
    if (fastest.real() > 0) {
        const double shift = std::abs(fastest);
        fastest = shift + leading_eigenvalue(jacobian, shift);
    }
    // Ignores a decay that differences cannot distinguish from zero.
    if (fastest.real() < -1e-4 * std::abs(estimate.eigenvalue)) {
        estimate.largest_speed = -2 * fastest.real() / std::norm(fastest);
    }
    return estimate;
}

}  // namespace cascade
