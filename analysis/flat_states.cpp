// Newton's method with shortened steps and deflation. If totals are conserved, the Jacobian is
// singular, so the equations of the totals are added.
#include "analysis/flat_states.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cascade::analysis {

namespace {

/// A pseudorandom number from 0 to 1 that depends only on a and b.
double scattered(std::uint32_t a, std::uint32_t b) {
    std::uint32_t bits = a * 0x9E3779B9U ^ (b + 1) * 0x85EBCA6BU;
    bits ^= bits >> 15;
    bits *= 0x2C1B3C6DU;
    bits ^= bits >> 12;
    bits *= 0x297A2D39U;
    bits ^= bits >> 15;
    return (bits + 0.5) / 4294967296.0;
}

/// The usual magnitude of each species' values. It decides whether a change is small.
Vector sizes_of(const LocalRates& rates) {
    const Vector start = rates.start();
    const double largest = start.cwiseAbs().maxCoeff();
    const double least = std::isfinite(largest) && largest > 0 ? 0.1 * largest : 1.0;
    return start.cwiseAbs().cwiseMax(least);
}

class Newton {
public:
    Newton(const LocalRates& rates, const Matrix& conserved, const Vector& totals_of)
        : rates_(rates),
          conserved_(conserved),
          totals_(conserved * totals_of),
          sizes_(sizes_of(rates)) {
        const Matrix at_start = rates.jacobian(rates.start());
        const double usual = at_start.allFinite() ? (at_start.cwiseAbs() * sizes_).maxCoeff() : 0;
        usual_rate_ = usual > 0 ? usual : sizes_.maxCoeff();
    }

    void repel(const Vector& state) { known_.push_back(state); }

    std::optional<Vector> from(Vector x) const {
        Vector residual = residual_of(x);
        if (!residual.allFinite()) return std::nullopt;
        for (int round = 0; round < most_rounds; ++round) {
            if (residual.cwiseAbs().maxCoeff() == 0) return accepted(x);
            const Vector step = step_of(x, residual);
            if (!step.allFinite()) return std::nullopt;
            double part = 1;
            Vector next;
            bool is_better = false;
            for (int halving = 0; halving < 12 && !is_better; ++halving, part /= 2) {
                next = x + part * step;
                const Vector there = residual_of(next);
                if (!there.allFinite()) continue;
                // With deflation, even a good step may enlarge the deflated residual, at most by a
                // factor of two.
                is_better = deflation(next) * there.norm() <
                            (known_.empty() ? 1.0 : 2.0) * deflation(x) * residual.norm();
                if (is_better) residual = there;
            }
            const double change = (part * 2 * step).cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
            if (is_better) x = next;
            if (change < 1e-13) return accepted(x);
            if (!is_better) return change < 1e-9 ? accepted(x) : std::nullopt;
        }
        return std::nullopt;
    }

private:
    static constexpr int most_rounds = 60;

    Vector residual_of(const Vector& x) const {
        const Vector rates = rates_.rates(x);
        Vector all(rates.size() + conserved_.rows());
        all << rates, conserved_ * x - totals_;
        return all;
    }

    double deflation(const Vector& x) const {
        double product = 1;
        for (const Vector& state : known_) {
            product *= 1 / (x - state).cwiseQuotient(sizes_).squaredNorm() + 1;
        }
        return product;
    }

    /// The step for the residual multiplied by the deflation m. The Jacobian of this product is m J
    /// + residual · (grad m). By Sherman and Morrison's formula, the step is a multiple of the step
    /// without deflation.
    Vector step_of(const Vector& x, const Vector& residual) const {
        Matrix all(residual.size(), x.size());
        all << rates_.jacobian(x), conserved_;
        const Vector step = -least_squares(all, residual);
        double slope = 0;  // The slope of log m along the step.
        for (const Vector& state : known_) {
            const Vector apart = (x - state).cwiseQuotient(sizes_);
            const double square = apart.squaredNorm();
            slope += -2 * apart.dot(step.cwiseQuotient(sizes_)) / (square * (1 + square));
        }
        const double factor = 1 - slope;
        return std::abs(factor) > 1e-12 ? Vector(step / factor) : step;
    }

public:
    /// Whether other flat states are arbitrarily near. For example, a model of an epidemic has a
    /// flat state for any number of healthy people.
    bool is_in_family(const Vector& x) const {
        Matrix all(x.size() + conserved_.rows(), x.size());
        all << rates_.jacobian(x), conserved_;
        const Vector values = singular_values(all);
        return values[values.size() - 1] < 1e-9 * values[0];
    }

private:
    /// Replaces values that are small compared to the species' size by 0, if 0 solves the equations
    /// equally well.
    Vector without_rounding_of_0(const Vector& x) const {
        Vector result = x;
        for (Eigen::Index k = 0; k < x.size(); ++k) {
            if (x[k] == 0 || std::abs(x[k]) >= 1e-12 * sizes_[k]) continue;
            const double value = std::exchange(result[k], 0.0);
            const Vector before = residual_of(x), there = residual_of(result);
            const Matrix jacobian = rates_.jacobian(x);
            const double rounding = 1e-15 * (jacobian.cwiseAbs() * x.cwiseAbs()).maxCoeff();
            const bool is_as_good =
                there.cwiseAbs().maxCoeff() <= std::max(before.cwiseAbs().maxCoeff(), rounding);
            if (!is_as_good) result[k] = value;
        }
        return result;
    }

    std::optional<Vector> accepted(const Vector& found) const {
        const Vector x = without_rounding_of_0(found);
        const Vector rates = rates_.rates(x);
        const Matrix jacobian = rates_.jacobian(x);
        if (!rates.allFinite() || !jacobian.allFinite()) return std::nullopt;
        // The smallest residual that rounded values allow.
        const Vector rounding = jacobian.cwiseAbs() * x.cwiseAbs().cwiseMax(sizes_);
        const double most = std::max(rounding.maxCoeff(), 1e-300);
        if (rates.cwiseAbs().maxCoeff() > 1e-9 * most &&
            rates.cwiseAbs().maxCoeff() > 1e-12 * usual_rate_) {
            return std::nullopt;
        }
        return x;
    }

    const LocalRates& rates_;
    Matrix conserved_;
    Vector totals_, sizes_;
    double usual_rate_ = 0;
    std::vector<Vector> known_;
};

/// Whether the rules of the system allow this state. A rule such as `b >= 0` may exclude it.
bool is_admitted(const LinearModel& model, const Vector& state) {
    for (const Invariant& rule : model.system().invariants) {
        const auto found = std::find(model.species.begin(), model.species.end(), rule.species);
        const auto* bound = rule.bound.nodes.back().as<double>();
        if (found == model.species.end() || bound == nullptr) continue;
        const double value = state[found - model.species.begin()];
        const double slack = 1e-9 * (1 + std::abs(*bound));
        if (rule.at_least ? value < *bound - slack : value > *bound + slack) return false;
    }
    return true;
}

}  // namespace

Matrix conserved_totals(const LocalRates& rates) {
    const Eigen::Index count = rates.species_count();
    const Vector sizes = sizes_of(rates);
    constexpr std::uint32_t samples = 4;
    Matrix changes(count, 0);
    for (std::uint32_t sample = 0; sample < samples; ++sample) {
        Vector x(count);
        for (Eigen::Index k = 0; k < count; ++k) {
            x[k] = sizes[k] * (0.2 + scattered(sample, static_cast<std::uint32_t>(k)));
        }
        const Matrix jacobian = rates.jacobian(x);
        const Vector rate = rates.rates(x);
        if (!jacobian.allFinite() || !rate.allFinite()) continue;
        const Eigen::Index before = changes.cols();
        changes.conservativeResize(Eigen::NoChange, before + count + 1);
        changes.middleCols(before, count) = jacobian;
        changes.col(before + count) = rate;
    }
    if (changes.cols() == 0) return Matrix(0, count);
    if (changes.cwiseAbs().maxCoeff() == 0) return Matrix::Identity(count, count);
    return rows_across_columns(changes, 1e-11);
}

std::optional<Vector> flat_state_near(const LocalRates& rates, const Vector& species,
                                      const Matrix& conserved) {
    return Newton(rates, conserved, species).from(species);
}

FlatStates flat_states(const LocalRates& rates) {
    FlatStates states;
    states.conserved = conserved_totals(rates);
    const Vector start = rates.start();
    if (!start.allFinite()) return states;
    Newton newton(rates, states.conserved, start);
    const Vector sizes = sizes_of(rates);
    const auto keep = [&](const Vector& state, bool is_from_start) {
        const auto is_same = [&](const FlatState& known) {
            return (state - known.species).cwiseQuotient(sizes).norm() < 1e-6;
        };
        if (std::any_of(states.found.begin(), states.found.end(), is_same)) return;
        newton.repel(state);
        if (!is_from_start && newton.is_in_family(state)) return;
        if (is_admitted(rates.model(), state)) states.found.push_back({state, is_from_start});
    };
    if (const auto state = newton.from(start)) keep(*state, true);
    // All states are flat states.
    if (states.conserved.rows() == rates.species_count()) return states;
    constexpr std::uint32_t tries = 40;
    constexpr std::size_t most_states = 12;
    for (std::uint32_t k = 0; k < tries && states.found.size() < most_states; ++k) {
        Vector guess(start.size());
        for (Eigen::Index s = 0; s < guess.size(); ++s) {
            const double at = scattered(k + 100, static_cast<std::uint32_t>(s));
            // Three kinds of guesses alternate: near the starting values, between 0 and a multiple
            // of the sizes, and with values of either sign.
            guess[s] = k % 3 == 0   ? start[s] + sizes[s] * (at - 0.5)
                       : k % 3 == 1 ? sizes[s] * std::exp(8 * (at - 0.7))
                                    : sizes[s] * 6 * (at - 0.5);
        }
        if (const auto state = newton.from(guess)) keep(*state, false);
    }
    return states;
}

}  // namespace cascade::analysis
