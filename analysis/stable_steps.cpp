// Goes from 0 along the ray of each rate until the polynomial is larger than 1.
#include "analysis/stable_steps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace cascade::analysis {

namespace {

struct StepPolynomial {
    Solver solver;
    std::array<double, 7> coefficients;
};
constexpr std::array<StepPolynomial, 5> polynomials{
    {{Solver::euler, {1, 1, 0, 0, 0, 0, 0}},
     {Solver::rk2, {1, 1, 1.0 / 2, 0, 0, 0, 0}},
     {Solver::rk4, {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 0, 0}},
     {Solver::rk23, {1, 1, 1.0 / 2, 1.0 / 6, 0, 0, 0}},
     {Solver::rk45, {1, 1, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 600}}}};

bool is_stable(const StepPolynomial& polynomial, Complex z) {
    Complex sum = 0;
    for (std::size_t k = polynomial.coefficients.size(); k-- > 0;) {
        sum = sum * z + polynomial.coefficients[k];
    }
    return std::norm(sum) <= 1 + 1e-12;
}

/// Where the ray at this angle from the negative axis, 0 … π/2, leaves the region of stability.
double reach(const StepPolynomial& polynomial, double angle) {
    const Complex direction = std::polar(1.0, std::numbers::pi - angle);
    constexpr double most = 8;
    double inside = 0, outside = most;
    for (double radius = 0.02; radius < most; radius += 0.02) {
        if (!is_stable(polynomial, radius * direction)) {
            outside = radius;
            break;
        }
        inside = radius;
    }
    // On the imaginary axis euler and rk2 amplify every wave, if little.
    if (inside == 0 && angle > std::numbers::pi / 2 - 1e-9) return 0;
    for (int round = 0; round < 40; ++round) {
        const double middle = (inside + outside) / 2;
        (is_stable(polynomial, middle * direction) ? inside : outside) = middle;
    }
    return inside;
}

}  // namespace

std::vector<StableStep> stable_steps(std::span<const Complex> rates) {
    // Of the rates at about the same angle only the largest matters.
    constexpr std::size_t sectors = 512;
    std::array<Complex, sectors + 1> largest{};
    for (const Complex rate : rates) {
        const double angle = std::atan2(std::abs(rate.imag()), std::max(-rate.real(), 0.0));
        auto& known = largest[static_cast<std::size_t>(
            std::min(angle / (std::numbers::pi / 2), 1.0) * sectors)];
        if (std::abs(rate) > std::abs(known)) known = rate;
    }
    std::vector<StableStep> steps;
    for (const StepPolynomial& polynomial : polynomials) {
        StableStep step{polynomial.solver, std::numeric_limits<double>::infinity()};
        for (const Complex rate : largest) {
            if (rate == Complex()) continue;
            const double angle = std::atan2(std::abs(rate.imag()), std::max(-rate.real(), 0.0));
            step.step = std::min(step.step, reach(polynomial, angle) / std::abs(rate));
        }
        steps.push_back(step);
    }
    return steps;
}

}  // namespace cascade::analysis
