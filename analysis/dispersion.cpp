// Samples rates along directions, and refines the fastest wave and the ends of bands.
#include "analysis/dispersion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cascade::analysis {

namespace {

constexpr std::size_t samples = 400;

Phases along(const Direction& direction, double phase) {
    return {direction[0] * phase, direction[1] * phase, direction[2] * phase};
}

/// The phase of the shortest wave along a direction. It is π along the direction's dominant axis.
double shortest(const Direction& direction) {
    const double most =
        std::max({std::abs(direction[0]), std::abs(direction[1]), std::abs(direction[2])});
    return std::numbers::pi / most;
}

std::vector<std::size_t> axes_of(const Lattice& lattice) {
    std::vector<std::size_t> axes;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (lattice.has_axis[axis]) axes.push_back(axis);
    }
    return axes;
}

/// Whether rates depend only on the symbol of the Laplacian. If so, waves along the diagonal
/// suffice, because the symbol takes all its values there. The isotropic Laplacian in space is an
/// exception: its symbol is largest where one of the three phases is 0.
bool has_laplacian_alone(const LinearModel& model) {
    const DomainSettings& domain = model.program->domain;
    if (domain.stencil == StencilKind::isotropic && domain.grid.stencil().axes() == 3) return false;
    return std::all_of(model.terms.begin(), model.terms.end(), [](const JacobianTerm& term) {
        return std::ranges::all_of(term.operators, [](WaveOperator each) {
            return each == WaveOperator{} || each.kind == WaveOperator::Kind::mean;
        });
    });
}

/// Directions along the axes that exist. Of two opposite directions, only one is included, because
/// waves of opposite directions have conjugate rates.
std::vector<Direction> directions_of(const LinearModel& model, const Lattice& lattice, int count) {
    const std::vector<std::size_t> axes = axes_of(lattice);
    std::vector<Direction> directions;
    const auto add = [&](double a, double b, double c) {
        const double length = std::sqrt(a * a + b * b + c * c);
        const std::array<double, 3> parts{a / length, b / length, c / length};
        Direction direction{0, 0, 0};
        for (std::size_t k = 0; k < axes.size(); ++k) direction[axes[k]] = parts[k];
        directions.push_back(direction);
    };
    if (axes.size() == 1) {
        add(1, 0, 0);
    } else if (has_laplacian_alone(model)) {
        add(1, 0, 0);
        add(1, 1, axes.size() == 3 ? 1 : 0);
    } else if (axes.size() == 2) {
        for (int k = 0; k < count; ++k) {
            const double angle = std::numbers::pi * k / count;
            // Makes the component along the other axis exactly 0.
            if (2 * k == count) {
                add(0, 1, 0);
            } else {
                add(std::cos(angle), std::sin(angle), 0);
            }
        }
    } else {
        for (int a = -1; a <= 1; ++a) {
            for (int b = -1; b <= 1; ++b) {
                for (int c = -1; c <= 1; ++c) {
                    const int first = a != 0 ? a : b != 0 ? b : c;
                    if (first > 0) add(a, b, c);
                }
            }
        }
        std::swap(directions.front(),
                  *std::find(directions.begin(), directions.end(), Direction{1, 0, 0}));
    }
    return directions;
}

/// The k-th of `count` phases along a direction. Phases of long waves are closer together.
double phase_of(const Direction& direction, std::size_t k, std::size_t count) {
    const double part = static_cast<double>(k) / static_cast<double>(count);
    return shortest(direction) * part * (0.1 + 0.9 * part);
}

class Relation {
public:
    Relation(const LinearModel& model, const Matrices& matrices)
        : model_(model), matrices_(matrices), lattice_(lattice_of(*model.program)) {
        double largest = 0;
        for (const Matrix& matrix : matrices.terms) {
            if (matrix.size() > 0) largest = std::max(largest, matrix.cwiseAbs().maxCoeff());
        }
        resolution = 1e-10 * largest;
    }

    Complex largest(const Phases& phases) const {
        if (matrices_.terms[0].rows() == 2 && model_.unknowns.empty()) {
            return largest_of_two(phases);
        }
        return eigenvalues(model_, matrices_, lattice_, phases).front();
    }
    double growth(const Direction& direction, double phase) const {
        return largest(along(direction, phase)).real();
    }

    Branch branch(const Direction& direction, std::size_t count) const {
        Branch branch;
        for (std::size_t k = 1; k <= count; ++k) {
            const double phase = phase_of(direction, k, count);
            const auto all = eigenvalues(model_, matrices_, lattice_, along(direction, phase));
            branch.phases.push_back(phase);
            branch.largest.push_back(all.front());
            const auto other = std::find_if(all.begin() + 1, all.end(), [&](Complex each) {
                return std::abs(each - std::conj(all.front())) > 1e-9 * std::abs(each);
            });
            const double nan = std::numeric_limits<double>::quiet_NaN();
            branch.second.push_back(other != all.end() ? *other : Complex(nan, nan));
        }
        return branch;
    }

    /// The waves along a direction with their largest rates only.
    Branch growth_along(const Direction& direction, std::size_t count) const {
        Branch branch;
        for (std::size_t k = 1; k <= count; ++k) {
            branch.phases.push_back(phase_of(direction, k, count));
            branch.largest.push_back(largest(along(direction, branch.phases.back())));
        }
        return branch;
    }

    /// Finds the fastest wave by golden section, beginning at the fastest sample.
    GrowingWave fastest(const Direction& direction, const Branch& branch) const {
        std::size_t best = 0;
        for (std::size_t k = 1; k < branch.phases.size(); ++k) {
            if (branch.largest[k].real() > branch.largest[best].real() + resolution) best = k;
        }
        double low = best > 0 ? branch.phases[best - 1] : 0;
        double high = branch.phases[std::min(best + 1, branch.phases.size() - 1)];
        constexpr double ratio = 0.6180339887498949;
        double inner = high - ratio * (high - low), outer = low + ratio * (high - low);
        double at_inner = growth(direction, inner), at_outer = growth(direction, outer);
        for (int round = 0; round < 20; ++round) {
            if (at_inner >= at_outer) {
                high = outer;
                outer = inner;
                at_outer = at_inner;
                inner = high - ratio * (high - low);
                at_inner = growth(direction, inner);
            } else {
                low = inner;
                inner = outer;
                at_inner = at_outer;
                outer = low + ratio * (high - low);
                at_outer = growth(direction, outer);
            }
        }
        GrowingWave wave{direction, at_inner >= at_outer ? inner : outer, {}};
        wave.rate = largest(along(direction, wave.phase));
        if (branch.largest[best].real() > wave.rate.real()) {
            wave.phase = branch.phases[best];
            wave.rate = branch.largest[best];
        }
        return wave;
    }

    std::vector<GrowingBand> bands(const Direction& direction, const Branch& branch,
                                   const GrowingWave& fastest) const {
        std::vector<double> phases{0};
        phases.insert(phases.end(), branch.phases.begin(), branch.phases.end());
        phases.insert(std::upper_bound(phases.begin(), phases.end(), fastest.phase), fastest.phase);
        const auto grows = [&](double phase) { return growth(direction, phase) > resolution; };
        const auto edge = [&](double resting, double growing) {
            for (int round = 0; round < 50; ++round) {
                const double middle = (resting + growing) / 2;
                (grows(middle) ? growing : resting) = middle;
            }
            return growing;
        };
        std::vector<GrowingBand> found;
        bool was_growing = false;
        for (std::size_t k = 1; k < phases.size(); ++k) {
            const bool is_growing = grows(phases[k]);
            if (is_growing && !was_growing) {
                const bool from_rest = k == 1 && grows(0.1 * phases[1]);
                found.push_back({from_rest ? 0 : edge(phases[k - 1], phases[k]), phases[k]});
            }
            if (!is_growing && was_growing) found.back().most = edge(phases[k], phases[k - 1]);
            if (is_growing) found.back().most = std::max(found.back().most, phases[k]);
            was_growing = is_growing;
        }
        return found;
    }

    const Lattice& lattice() const { return lattice_; }
    double resolution = 0;

private:
    /// Allocates no memory, because maps of parameters call this function a million times.
    Complex largest_of_two(const Phases& phases) const {
        const std::vector<Matrix>& terms = matrices_.terms;
        Complex a = terms[0](0, 0), b = terms[0](0, 1);
        Complex c = terms[0](1, 0), d = terms[0](1, 1);
        for (std::size_t k = 1; k < terms.size(); ++k) {
            const Complex factor =
                symbol(model_.terms[k].operators, lattice_, matrices_.kernels, phases);
            a += factor * terms[k](0, 0);
            b += factor * terms[k](0, 1);
            c += factor * terms[k](1, 0);
            d += factor * terms[k](1, 1);
        }
        return (a + d) / 2.0 + std::sqrt((a - d) * (a - d) / 4.0 + b * c);
    }

    const LinearModel& model_;
    const Matrices& matrices_;
    Lattice lattice_;
};

Stability stability_of(const Dispersion& found) {
    if (found.grows_at_rest()) {
        if (!oscillates(found.at_rest, found.resolution)) return Stability::uniform;
        const bool waves_lead = found.fastest.rate.real() > found.at_rest.real() + found.resolution;
        return waves_lead && !oscillates(found.fastest.rate, found.resolution) ? Stability::both
                                                                               : Stability::hopf;
    }
    if (!found.has_growing_waves()) return Stability::stable;
    return oscillates(found.fastest.rate, found.resolution) ? Stability::wave : Stability::turing;
}

}  // namespace

bool oscillates(Complex rate, double resolution) {
    return std::abs(rate.imag()) > std::max(resolution, 1e-6 * std::abs(rate.real()));
}

double GrowingWave::cells() const {
    return phase > 0 ? 2 * std::numbers::pi / phase : std::numeric_limits<double>::infinity();
}

std::vector<Complex> eigenvalues(const LinearModel& model, const Matrices& matrices,
                                 const Lattice& lattice, const Phases& phases) {
    const ComplexMatrix sum = jacobian_of(model, matrices, lattice, phases);
    const bool is_real = sum.imag().cwiseAbs().maxCoeff() == 0;
    std::vector<Complex> values;
    if (sum.rows() == 1) {
        values = {sum(0, 0)};
    } else if (sum.rows() == 2) {
        const Complex half = (sum(0, 0) + sum(1, 1)) / 2.0;
        const Complex apart = (sum(0, 0) - sum(1, 1)) / 2.0;
        const Complex root = std::sqrt(apart * apart + sum(0, 1) * sum(1, 0));
        values = {half + root, half - root};
    } else if (is_real) {
        const ComplexVector found = eigenvalues_of(Matrix(sum.real()));
        values.assign(found.begin(), found.end());
    } else {
        const ComplexVector found = eigenvalues_of(sum);
        values.assign(found.begin(), found.end());
    }
    std::sort(values.begin(), values.end(), [](Complex a, Complex b) {
        return a.real() != b.real() ? a.real() > b.real() : a.imag() > b.imag();
    });
    return values;
}

namespace {

/// Computes the dispersion relation, without its curve, from `samples_along` waves in each
/// direction. `directions_in` is the number of directions in a plane.
Dispersion without_curve(const LinearModel& model, const Matrices& matrices, int directions_in,
                         std::size_t samples_along) {
    const Relation relation(model, matrices);
    Dispersion found;
    found.resolution = relation.resolution;
    found.at_rest = relation.largest({});
    const std::vector<Direction> directions =
        directions_of(model, relation.lattice(), directions_in);
    double slowest = std::numeric_limits<double>::infinity();
    bool is_first = true;
    for (const Direction& direction : directions) {
        const Branch branch = relation.growth_along(direction, samples_along);
        const GrowingWave wave = relation.fastest(direction, branch);
        slowest = std::min(slowest, wave.rate.real());
        const double margin =
            std::max(relation.resolution, 1e-3 * std::abs(found.fastest.rate.real()));
        if (is_first || wave.rate.real() > found.fastest.rate.real() + margin) {
            found.fastest = wave;
        }
        is_first = false;
    }
    const double fastest = found.fastest.rate.real();
    found.depends_on_direction =
        fastest - slowest > std::max(relation.resolution, 0.1 * std::abs(fastest));
    found.stability = stability_of(found);
    return found;
}

}  // namespace

Dispersion quick_dispersion(const LinearModel& model, const Matrices& matrices) {
    // With more than two species, eigenvalues take longer, so fewer waves are sampled.
    return without_curve(model, matrices, 8, model.species_count() <= 2 ? 48 : 24);
}

Dispersion dispersion(const LinearModel& model, const Matrices& matrices) {
    const Relation relation(model, matrices);
    Dispersion found = without_curve(model, matrices, 24, 64);
    found.curve = relation.branch(found.fastest.direction, samples);
    const GrowingWave refined = relation.fastest(found.fastest.direction, found.curve);
    if (refined.rate.real() > found.fastest.rate.real()) found.fastest = refined;
    found.bands = relation.bands(found.fastest.direction, found.curve, found.fastest);
    found.stability = stability_of(found);
    return found;
}

std::optional<GrowingWave> fastest_fitting_wave(const LinearModel& model,
                                                const Matrices& matrices) {
    const Relation relation(model, matrices);
    const Lattice& lattice = relation.lattice();
    const std::vector<std::size_t> axes = axes_of(lattice);
    std::array<std::int64_t, 3> most{0, 0, 0};
    std::array<double, 3> unit{0, 0, 0};
    double waves = 1;
    for (const std::size_t axis : axes) {
        const double cells = lattice.cells[axis];
        if (cells == 0 || model.program->domain.mask) return std::nullopt;
        unit[axis] = (lattice.is_periodic[axis] ? 2 : 1) * std::numbers::pi / cells;
        most[axis] = static_cast<std::int64_t>(std::numbers::pi / unit[axis] + 1e-9);
        waves *= static_cast<double>(most[axis] + 1);
    }
    // If there are so many waves that they leave hardly any gaps, waves along axes and diagonals
    // suffice.
    const bool has_all = waves <= 20'000;
    std::optional<GrowingWave> fastest;
    const auto look = [&](std::int64_t i, std::int64_t j, std::int64_t k) {
        const Phases phases{unit[0] * static_cast<double>(i), unit[1] * static_cast<double>(j),
                            unit[2] * static_cast<double>(k)};
        const double size = std::hypot(phases[0], phases[1], phases[2]);
        if (size == 0) return;
        const Complex rate = relation.largest(phases);
        if (fastest && rate.real() <= fastest->rate.real()) return;
        fastest = {{phases[0] / size, phases[1] / size, phases[2] / size}, size, rate};
    };
    for (std::int64_t k = 0; k <= most[2]; ++k) {
        for (std::int64_t j = 0; j <= most[1]; ++j) {
            for (std::int64_t i = 0; i <= most[0]; ++i) {
                const bool is_alone = (i == 0) + (j == 0) + (k == 0) >= 2;
                if (has_all || is_alone || (i == j && (k == 0 || k == i))) look(i, j, k);
            }
        }
    }
    return fastest;
}

std::vector<Complex> decaying_rates(const LinearModel& model, const Matrices& matrices) {
    const Relation relation(model, matrices);
    const Lattice& lattice = relation.lattice();
    std::vector<Complex> rates;
    const auto take = [&](const Phases& phases) {
        for (const Complex rate : eigenvalues(model, matrices, lattice, phases)) {
            if (rate.real() <= relation.resolution && std::abs(rate) > 10 * relation.resolution) {
                rates.push_back(rate);
            }
        }
    };
    if (has_laplacian_alone(model)) {
        constexpr int parts = 256;
        const std::vector<std::size_t> axes = axes_of(lattice);
        for (int k = 0; k <= parts; ++k) {
            Phases phases{};
            for (const std::size_t axis : axes) phases[axis] = std::numbers::pi * k / parts;
            take(phases);
        }
        return rates;
    }
    const int count = lattice.has_axis[2] ? 8 : 24;
    const auto steps_along = [&](std::size_t axis) { return lattice.has_axis[axis] ? count : 0; };
    // Waves in opposite directions have conjugate rates, which are equally stable.
    const auto phase = [&](int k) { return std::numbers::pi * k / count; };
    for (int i = 0; i <= steps_along(0); ++i) {
        for (int j = -steps_along(1); j <= steps_along(1); ++j) {
            for (int k = -steps_along(2); k <= steps_along(2); ++k) {
                take({phase(i), phase(j), phase(k)});
            }
        }
    }
    return rates;
}

}  // namespace cascade::analysis
