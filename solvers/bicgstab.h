// BiCGSTAB (H. van der Vorst, "Bi-CGSTAB: a fast and smoothly converging variant of Bi-CG", 1992)
// for planes that threads share. All threads take the same decisions, because all compute the same
// products.
#pragma once

#include "core/plane.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace cascade {

/// The planes for a solution x of L x = b. Each row belongs to the thread that computes it.
struct BicgstabPlanes {
    Field& solution;
    Field& residual;  ///< Holds the residual b − L x when run() begins and when it ends.
    Field &shadow, &direction, &image, &other_image;
    const Field& preconditioned;  ///< The plane to which `System::precondition` writes its result.
};

struct BicgstabOutcome {
    int iterations = 0;
    double rest = 0;  ///< The norm of the residual, as a fraction of its initial norm.
};

/// `System` has these members, which all threads call:
///     double dot(const Field& a, const Field& b)   returns the sum of a · b over all cells
///     void precondition(const Field& from)         approximates L⁻¹ · from in `preconditioned`
///     void apply(Field& result)                    computes L · preconditioned in `result`
///     void each_cell(act)                          calls act(i) for each cell of the thread
///     void leave_if_cancelled()
template <typename Number, typename System>
class Bicgstab {
public:
    Bicgstab(System& system, const BicgstabPlanes& planes)
        : system_(system),
          planes_(planes),
          x_(planes.solution.origin<Number>()),
          r_(planes.residual.origin<Number>()),
          y_(planes.preconditioned.origin<Number>()) {}

    /// Improves the solution until the norm of the residual is at most `tolerance` times its
    /// initial norm, or for `most` iterations. If the residual is not finite, the solution becomes
    /// NaN.
    BicgstabOutcome run(double tolerance, int most);

private:
    /// The least cosine of the angle between the residual and its shadow residual. Below this
    /// limit, the next directions would be rounding errors, so the iteration restarts from the
    /// present residual.
    static constexpr double least_overlap = sizeof(Number) == sizeof(float) ? 1e-7 : 1e-15;

    void begin_again();
    bool choose_direction();
    bool go_along_direction();
    bool damp_rest();
    void measure_rest() { left_ = std::sqrt(system_.dot(planes_.residual, planes_.residual)); }
    /// Adds `times` times the preconditioned plane to the solution. `image` is L of that plane.
    void add(double times, const Field& image) {
        const auto factor = static_cast<Number>(times);
        const Number* const of_image = image.origin<Number>();
        system_.each_cell([&](std::int64_t i) {
            x_[i] += factor * y_[i];
            r_[i] -= factor * of_image[i];
        });
        measure_rest();
    }

    System& system_;
    BicgstabPlanes planes_;
    Number *const x_, *const r_;
    const Number* const y_;
    double rho_ = 1, alpha_ = 1, omega_ = 1;
    double left_ = 0, size_of_shadow_ = 0;  ///< Norms of the residual and of the shadow residual.
};

template <typename Number, typename System>
BicgstabOutcome Bicgstab<Number, System>::run(double tolerance, int most) {
    measure_rest();
    const double whole = left_;
    if (!std::isfinite(whole)) {  // Makes the solution NaN, so that the failure is visible.
        system_.each_cell(
            [&](std::int64_t i) { x_[i] = std::numeric_limits<Number>::quiet_NaN(); });
        return {};
    }
    const double wanted = tolerance * whole;
    begin_again();
    BicgstabOutcome outcome;
    while (left_ > wanted && outcome.iterations < most) {
        system_.leave_if_cancelled();
        ++outcome.iterations;
        if (!choose_direction() || !go_along_direction()) break;
        if (!(left_ > wanted) || !damp_rest()) break;
    }
    outcome.rest = whole > 0 ? left_ / whole : 0;
    return outcome;
}

template <typename Number, typename System>
void Bicgstab<Number, System>::begin_again() {
    Number* const shadow = planes_.shadow.origin<Number>();
    Number* const direction = planes_.direction.origin<Number>();
    Number* const image = planes_.image.origin<Number>();
    system_.each_cell([&](std::int64_t i) {
        shadow[i] = r_[i];
        direction[i] = image[i] = 0;
    });
    size_of_shadow_ = left_;
    rho_ = alpha_ = omega_ = 1;
}

template <typename Number, typename System>
bool Bicgstab<Number, System>::choose_direction() {
    double next_rho = system_.dot(planes_.shadow, planes_.residual);
    if (std::abs(next_rho) < least_overlap * size_of_shadow_ * left_) {
        begin_again();
        next_rho = system_.dot(planes_.shadow, planes_.residual);
    }
    if (omega_ == 0) return false;
    const auto beta = static_cast<Number>(next_rho / rho_ * (alpha_ / omega_));
    const auto back = static_cast<Number>(omega_);
    rho_ = next_rho;
    Number* const direction = planes_.direction.origin<Number>();
    const Number* const image = planes_.image.origin<Number>();
    system_.each_cell(
        [&](std::int64_t i) { direction[i] = r_[i] + beta * (direction[i] - back * image[i]); });
    return true;
}

template <typename Number, typename System>
bool Bicgstab<Number, System>::go_along_direction() {
    system_.precondition(planes_.direction);
    system_.apply(planes_.image);
    const double along = system_.dot(planes_.shadow, planes_.image);
    if (along == 0) return false;
    alpha_ = rho_ / along;
    add(alpha_, planes_.image);
    return true;
}

template <typename Number, typename System>
bool Bicgstab<Number, System>::damp_rest() {
    system_.precondition(planes_.residual);
    system_.apply(planes_.other_image);
    const double size = system_.dot(planes_.other_image, planes_.other_image);
    if (size == 0) return false;
    omega_ = system_.dot(planes_.other_image, planes_.residual) / size;
    add(omega_, planes_.other_image);
    return true;
}

}  // namespace cascade
