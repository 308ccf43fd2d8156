// The time loop with real cell kernels, run by the interpreter and compared with theory: diffusion,
// linear growth at Turing's fixed point, and estimates of stability.
#include "solvers/advance.h"
#include "solvers/chequerboard.h"
#include "solvers/stability.h"

#include "ir/builder.h"
#include "ir/interpreter.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace cascade::test {
namespace {

using std::numbers::pi;

KernelPointer interpreted(KernelBuilder builder, const Grid& grid) {
    const CellKernel kernel = std::move(builder).finish();
    EXPECT_EQ(verify(kernel), "");
    const auto compiled = make_interpreter()->compile(kernel, grid.stencil());
    EXPECT_TRUE(compiled);
    return *compiled;
}

/// A step c + diffusion · lap c in cells that are not frozen.
StepProblem heat(const Grid& grid, const Mask* frozen) {
    KernelBuilder builder;
    const FieldSlot slot = builder.field_slot("c");
    const ValueId c = builder.field(slot);
    const ValueId flow =
        builder.multiply(builder.uniform(builder.uniform_slot("d")), builder.laplacian(slot));
    ValueId next = builder.add(c, flow);
    if (frozen) {
        next = builder.select(builder.mask(builder.mask_slot("frozen")), c, next);
    }
    builder.result("c", next);
    StepProblem problem = make_problem(grid, 1, interpreted(std::move(builder), grid));
    if (frozen) problem.passes[0].masks = {frozen};
    problem.passes[0].uniforms = {0.125f};
    return problem;
}

TEST(KernelPhysics, HeatDecaysAtTheDiscreteRate) {
    for (const auto& [width, height] :
         {std::pair{64, 64}, std::pair{61, 1}, std::pair{1, 37}, std::pair{300, 7}}) {
        const Grid grid{width, height, Boundary::periodic};
        const auto wave = [&](auto i, auto j) {
            return (width > 1 ? std::cos(2 * pi * 2 * static_cast<double>(i) / width) : 1) *
                   (height > 1 ? std::cos(2 * pi * static_cast<double>(j) / height) : 1);
        };
        const auto decay = [](int mode, int cells) {
            const double sine = std::sin(pi * mode / cells);
            return cells > 1 ? 4 * sine * sine : 0;
        };
        std::vector<Field> species;
        species.push_back(make_field(grid, wave));
        advance_quietly(heat(grid, nullptr), {.last_step = 100}, species);
        double projection = 0, norm = 0;
        for (std::int64_t j = 0; j < height; ++j) {
            for (std::int64_t i = 0; i < width; ++i) {
                projection += wave(i, j) * species[0].at(i, j);
                norm += wave(i, j) * wave(i, j);
            }
        }
        const double rate = 1 - 0.125 * (decay(2, width) + decay(1, height));
        EXPECT_NEAR(projection / norm / std::pow(rate, 100), 1, 1e-5) << width << " x " << height;
    }
}

TEST(KernelPhysics, FrozenEndsMakeAStraightLine) {
    // Neighbours read frozen cells, so between two of them heat settles into a straight line.
    const Grid grid{33, 1, Boundary::no_flux};
    Mask frozen{PlaneLayout(grid)};
    frozen.at(0, 0) = frozen.at(32, 0) = 1;
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto i, auto) { return i == 32 ? 16.0 : 0.0; }));
    advance_quietly(heat(grid, &frozen), {.last_step = 20000}, species);
    // In single precision the change stops where an eighth of the curvature is below 2^-21, half a
    // unit in the last place of 16. The line then sags by at most 8 · 2^-21 · 32² / 8.
    for (std::int64_t i = 0; i < 33; ++i) {
        EXPECT_NEAR(species[0].at(i, 0), 0.5 * static_cast<double>(i), 5e-4);
    }
    EXPECT_EQ(species[0].at(0, 0), 0.0f);
    EXPECT_EQ(species[0].at(32, 0), 16.0f);
}

/// Turing's system with ka = 1/80 and beta = 12. Computes a step of length 1 if `step`, otherwise
/// the rates. The uniforms are diff_a and diff_b.
StepProblem turing(const Grid& grid, float diff_a, float diff_b, bool step) {
    KernelBuilder k;
    const FieldSlot a_slot = k.field_slot("a"), b_slot = k.field_slot("b");
    const ValueId a = k.field(a_slot), b = k.field(b_slot), ka = k.number(1.0f / 80);
    const ValueId ab = k.multiply(a, b);
    const auto diffusion = [&](const char* name, FieldSlot slot) {
        return k.multiply(k.uniform(k.uniform_slot(name)), k.laplacian(slot));
    };
    const ValueId made_a = k.multiply(ka, k.subtract(k.number(16), ab));
    const ValueId made_b = k.multiply(ka, k.subtract(k.subtract(ab, b), k.number(12)));
    const ValueId rate_a = k.add(made_a, diffusion("diff_a", a_slot));
    const ValueId rate_b = k.add(made_b, diffusion("diff_b", b_slot));
    k.result("a", step ? k.add(a, rate_a) : rate_a);
    k.result("b", step ? k.maximum(k.add(b, rate_b), k.number(0)) : rate_b);
    StepProblem problem = make_problem(grid, 2, interpreted(std::move(k), grid));
    problem.passes[0].uniforms = {diff_a, diff_b};
    return problem;
}

/// Jacobian of a mode with −lap = q at the fixed point a = b = 4.
struct Linear {
    double aa, ab, ba, bb;
    Linear(double q, double diff_a, double diff_b)
        : aa(-4.0 / 80 - diff_a * q), ab(-4.0 / 80), ba(4.0 / 80), bb(3.0 / 80 - diff_b * q) {}
    double root(int sign) const {
        return (aa + bb) / 2 + sign * std::sqrt((aa - bb) * (aa - bb) / 4 + ab * ba);
    }
};

TEST(KernelPhysics, TuringsFixedPointStaysPut) {
    const Grid grid{20, 20, Boundary::periodic};
    std::vector<Field> species;
    for (int k = 0; k < 2; ++k) species.push_back(make_field(grid, [](auto, auto) { return 4.0; }));
    advance_quietly(turing(grid, 0.125f, 1.0f / 64, true), {.last_step = 5000}, species);
    for (const Field& field : species) {
        for (const float value : cells_of(field)) ASSERT_EQ(value, 4.0f);
    }
}

TEST(KernelPhysics, TuringGrowsAsTheDispersionRelationSays) {
    // If a run starts along the eigenvector of a mode, the mode's amplitude is multiplied by 1 + λ
    // in each step.
    constexpr double diff_a = 0.125, diff_b = 1.0 / 64;
    constexpr int steps = 100;
    const Grid grid{64, 48, Boundary::periodic};
    int growing = 0;
    for (const auto& [kx, ky] :
         {std::pair{8, 0}, std::pair{9, 4}, std::pair{13, 2}, std::pair{0, 8}, std::pair{16, 0}}) {
        const double sine_x = std::sin(pi * kx / 64), sine_y = std::sin(pi * ky / 48);
        const Linear linear(4 * sine_x * sine_x + 4 * sine_y * sine_y, diff_a, diff_b);
        const double eigenvalue = linear.root(1);
        growing += eigenvalue > 0;
        const auto wave = [kx = kx, ky = ky](auto i, auto j) {
            return std::cos(2 * pi *
                            (kx * static_cast<double>(i) / 64 + ky * static_cast<double>(j) / 48));
        };
        const double part_a = linear.ab / (eigenvalue - linear.aa);  // The part of b is 1.
        std::vector<Field> species;
        species.push_back(
            make_field(grid, [&](auto i, auto j) { return 4 + 0.01 * part_a * wave(i, j); }));
        species.push_back(make_field(grid, [&](auto i, auto j) { return 4 + 0.01 * wave(i, j); }));
        const auto amplitude = [&] {
            double sum = 0;
            for (std::int64_t j = 0; j < grid.height; ++j) {
                for (std::int64_t i = 0; i < grid.width; ++i) {
                    sum += wave(i, j) * (species[1].at(i, j) - 4.0);
                }
            }
            return sum;
        };
        const double before = amplitude();
        advance_quietly(turing(grid, diff_a, diff_b, true), {.last_step = steps}, species);
        const double measured = std::log(amplitude() / before) / steps;
        const double expected = std::log1p(eigenvalue);
        EXPECT_NEAR(measured, expected, 0.01 * std::abs(expected)) << "mode " << kx << " " << ky;
    }
    EXPECT_GE(growing, 2);  // At least two modes must grow, or only decay would be tested.
}

TEST(KernelPhysics, StabilityOfTuringsSystem) {
    const Grid grid{64, 64, Boundary::periodic};
    std::vector<Field> species;
    species.push_back(make_field(grid, [](auto i, auto j) { return 4 + 1e-3 * scatter(i, j); }));
    species.push_back(make_field(grid, [](auto i, auto j) { return 4 + 1e-3 * scatter(j, i); }));
    const double eigenvalue = Linear(8, 0.25, 0.0625).root(-1);
    const StabilityEstimate estimate =
        estimate_stability(turing(grid, 0.25f, 0.0625f, false), species);
    EXPECT_NEAR(estimate.eigenvalue, eigenvalue, -0.01 * eigenvalue);
    EXPECT_NEAR(estimate.largest_speed.value_or(0), -2 / eigenvalue, 0.02);
    EXPECT_LT(estimate.largest_speed.value_or(2), 1);
}

TEST(KernelPhysics, AnUnstableStepIsNoticedAsAChequerboard) {
    // Diffusion with speed · D = 0.27 > 1/4: the chequerboard grows by 1.16 a step.
    const Grid grid{32, 32, Boundary::periodic};
    StepProblem problem = heat(grid, nullptr);
    std::vector<Field> species;
    species.push_back(make_field(grid, scatter));
    EXPECT_LT(alternating_part(species[0]), 0.5);
    problem.passes[0].uniforms = {0.24f};
    advance_quietly(problem, {.last_step = 300}, species);
    EXPECT_LT(alternating_part(species[0]), chequerboard_threshold);
    problem.passes[0].uniforms = {0.27f};
    advance_quietly(problem, {.last_step = 150}, species);
    EXPECT_GT(alternating_part(species[0]), chequerboard_threshold);
    const StageOutcome outcome = advance_quietly(problem, {.last_step = 2000}, species);
    EXPECT_TRUE(outcome.not_finite);
}

}  // namespace
}  // namespace cascade::test
