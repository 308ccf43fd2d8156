// A vector is a set of planes, one for each species, in units of the species' sizes.
#include "tissue/stiffness.h"

#include "core/hash.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace cascade {
namespace {

constexpr int most_iterations = 30;
/// The estimate is accepted when an iteration changes it by less than this fraction.
constexpr double enough = 0.03;
constexpr double margin = 1.1;

/// The largest change that a difference makes to a value, as a multiple of the species' size. It is
/// near the square root of the rounding error.
double difference_step(Precision precision) { return precision == Precision::single ? 1e-3 : 1e-6; }

/// A vector is stored by species, then by rank.
using Vector = std::vector<std::vector<double>>;

double length(const Vector& v) {
    double squares = 0;
    for (const std::vector<double>& of_species : v) {
        for (const double value : of_species) squares += value * value;
    }
    return std::sqrt(squares);
}

double largest(const Vector& v) {
    double most = 0;
    for (const std::vector<double>& of_species : v) {
        for (const double value : of_species) most = std::max(most, std::abs(value));
    }
    return most;
}

class Iteration {
public:
    Iteration(Tissue& tissue, const CellValues& rates, std::span<const double> scales,
              const StepMoment& moment, ValueRunner& runner)
        : tissue_(tissue), rates_(rates), scales_(scales), moment_(moment), runner_(runner) {
        for (const Field& field : tissue.species) moved_.push_back(field.clone());
        at_state_ = rates_at(tissue.species);
    }

    /// The direction that the last estimate found, plus noise. Without an earlier estimate, the
    /// direction is noise alone.
    Vector start() const {
        Vector v = read(tissue_.stiffest);
        v.resize(tissue_.species.size());
        const double most = std::max(1e-30, largest(v));
        for (std::vector<double>& of_species : v) of_species.resize(tissue_.count(), 0);
        each_species(v.size(), [&](std::size_t k) {
            for (std::size_t rank = 0; rank < v[k].size(); ++rank) {
                const std::uint32_t number = tissue_.numbers()[tissue_.by_number()[rank]];
                const auto word = pcg4d({number, static_cast<std::uint32_t>(k), 0x5717, 1})[0];
                v[k][rank] = v[k][rank] / most + 1e-2 * (word * 0x1p-31 - 1);
            }
        });
        return v;
    }

    /// The Jacobian times v.
    Vector multiply(const Vector& v) {
        const double step = difference_step(tissue_.precision()) / largest(v);
        write(v, step);
        Vector product = rates_at(moved_);
        each_species(product.size(), [&](std::size_t k) {
            for (std::size_t rank = 0; rank < product[k].size(); ++rank) {
                product[k][rank] = (product[k][rank] - at_state_[k][rank]) / step;
            }
        });
        return product;
    }

    void keep(const Vector& v) {
        if (tissue_.stiffest.empty()) {
            for (const Field& field : tissue_.species) {
                tissue_.stiffest.emplace_back(field.layout(), field.precision());
            }
        }
        const double size = largest(v);
        each(tissue_.stiffest, [&](std::size_t k, std::size_t rank, auto& value, auto) {
            value = static_cast<std::remove_reference_t<decltype(value)>>(v[k][rank] / size);
        });
    }

private:
    /// Calls `use(k)` for each species k, divided among all threads.
    void each_species(std::size_t count, const auto& use) const {
        Team& team = runner_.team();
        team.run([&](int thread) {
            const auto threads = static_cast<std::size_t>(team.size());
            for (auto k = static_cast<std::size_t>(thread); k < count; k += threads) use(k);
        });
    }

    /// Calls `use(species, rank, value, element)` for all values.
    void each(std::vector<Field>& fields, const auto& use) const {
        const std::span<const std::uint32_t> elements = tissue_.elements_by_number();
        each_species(fields.size(), [&](std::size_t k) {
            fields[k].visit([&](auto& plane) {
                for (std::size_t rank = 0; rank < elements.size(); ++rank) {
                    use(k, rank, plane.origin()[elements[rank]], elements[rank]);
                }
            });
        });
    }

    Vector read(const std::vector<Field>& fields) const {
        Vector v(fields.size(), std::vector<double>(tissue_.count()));
        each_species(fields.size(), [&](std::size_t k) {
            fields[k].visit([&](const auto& plane) {
                const std::span<const std::uint32_t> elements = tissue_.elements_by_number();
                for (std::size_t rank = 0; rank < elements.size(); ++rank) {
                    v[k][rank] = plane.origin()[elements[rank]];
                }
            });
        });
        return v;
    }

    Vector rates_at(std::vector<Field>& state) {
        Vector v = read(runner_.run(rates_, state, tissue_, moment_));
        each_species(v.size(), [&](std::size_t k) {
            for (double& value : v[k]) value /= scales_[k];
        });
        return v;
    }

    void write(const Vector& v, double step) {
        each(moved_, [&]<typename Number>(std::size_t k, std::size_t rank, Number& value,
                                          std::uint32_t at) {
            const double there = tissue_.species[k].template origin<Number>()[at];
            value = static_cast<Number>(there + step * scales_[k] * v[k][rank]);
        });
    }

    Tissue& tissue_;
    const CellValues& rates_;
    std::span<const double> scales_;
    StepMoment moment_;
    ValueRunner& runner_;
    std::vector<Field> moved_;
    Vector at_state_;
};

}  // namespace

double estimate_stiffness(Tissue& tissue, const CellValues& rates, std::span<const double> scales,
                          const StepMoment& moment, ValueRunner& runner) {
    Iteration iteration(tissue, rates, scales, moment, runner);
    Vector v = iteration.start();
    double found = 0;
    for (int k = 0; k < most_iterations; ++k) {
        Vector next = iteration.multiply(v);
        const double before = found, size = length(next);
        found = size / length(v);
        if (!std::isfinite(found)) return 0;
        // The rates depend on no species.
        if (size < 1e-30 || largest(next) == 0) return 0;
        v = std::move(next);
        if (std::abs(found - before) < enough * found) break;
    }
    iteration.keep(v);
    return margin * found;
}

}  // namespace cascade
