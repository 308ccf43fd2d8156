// Heat on a ring of cells whose neighbours are given by a list, in another order than that of the
// ring.
#include "core/links.h"
#include "ir/builder.h"
#include "ir/interpreter.h"
#include "solvers/advance.h"
#include "solvers/stability.h"
#include "tests/unit/solvers/cell_function_kernel.h"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <string>

namespace cascade::test {
namespace {

/// Place p of the ring is cell 27 p modulo the number of cells. Cells lie in rows of 16, of which
/// the last one is filled up.
class Ring {
public:
    static constexpr std::size_t cells = 70;

    explicit Ring(Precision precision) : grid_(make_grid()) {
        LinkList list;
        std::vector<std::size_t> places(cells);
        for (std::size_t place = 0; place < cells; ++place) places[cell_of(place)] = place;
        for (std::size_t cell = 0; cell < cells; ++cell) {
            for (const std::size_t step : {std::size_t{1}, cells - 1}) {
                const std::size_t neighbour = cell_of((places[cell] + step) % cells);
                list.neighbours.push_back(static_cast<std::uint32_t>(neighbour));
                list.weights.push_back(1);
            }
            list.ends.push_back(list.neighbours.size());
        }
        links_ = Links(list, PlaneLayout(grid_), precision);
    }

    /// A step that adds `part` times the sum of the differences to both neighbours.
    StepProblem heat(double part) const {
        KernelBuilder builder(links_.precision());
        const FieldSlot slot = builder.field_slot("f");
        const ValueId flow = builder.multiply(builder.uniform(builder.uniform_slot("part")),
                                              builder.laplacian(slot));
        builder.result("f", builder.add(builder.field(slot), flow));
        StepProblem problem = make_problem(
            grid_, 1, *make_interpreter()->compile(std::move(builder).finish(), Stencil::linked));
        problem.passes[0].uniforms = {part};
        problem.links = &links_;
        problem.precision = links_.precision();
        return problem;
    }

    /// A field with the values of a function of the place in the ring.
    Field field(auto function) const {
        Field field(PlaneLayout(grid_), links_.precision());
        field.visit([&](auto& plane) {
            using Number = std::remove_reference_t<decltype(*plane.origin())>;
            for (std::size_t place = 0; place < cells; ++place) {
                *(plane.origin() + offset_of(place)) = static_cast<Number>(function(place));
            }
        });
        return field;
    }

    double at(const Field& field, std::size_t place) const {
        double value = 0;
        field.visit([&](const auto& plane) { value = *(plane.origin() + offset_of(place)); });
        return value;
    }

private:
    static Grid make_grid() {
        Grid grid;
        grid.width = 16;
        grid.height = 5;
        grid.linked = true;
        return grid;
    }
    static std::size_t cell_of(std::size_t place) { return 27 * place % cells; }
    std::int64_t offset_of(std::size_t place) const {
        const auto cell = static_cast<std::int64_t>(cell_of(place));
        return PlaneLayout(grid_).row_start(cell / grid_.width) + cell % grid_.width;
    }

    Grid grid_;
    Links links_;
};

class LinkedHeat : public ::testing::TestWithParam<Precision> {
protected:
    double rounding() const { return GetParam() == Precision::single ? 1e-5 : 1e-12; }
};

/// Wave m of a ring of n cells is multiplied by 1 − 4 d sin²(π m / n) in a step.
TEST_P(LinkedHeat, WavesDecayAtTheDiscreteRate) {
    const Ring ring(GetParam());
    constexpr int mode = 3, steps = 150;
    constexpr double part = 0.125;
    const auto angle = [](std::size_t place) {
        return 2 * std::numbers::pi * mode * static_cast<double>(place) / Ring::cells;
    };
    std::vector<Field> species;
    species.push_back(ring.field([&](std::size_t place) { return std::cos(angle(place)); }));
    const StageOutcome outcome =
        advance_quietly(ring.heat(part), {.last_step = steps, .threads = 2}, species);
    EXPECT_EQ(outcome.steps, steps);
    EXPECT_FALSE(outcome.not_finite);
    const double sine = std::sin(std::numbers::pi * mode / Ring::cells);
    const double amplitude = std::pow(1 - 4 * part * sine * sine, steps);
    EXPECT_LT(amplitude, 0.5);
    for (std::size_t place = 0; place < Ring::cells; ++place) {
        ASSERT_NEAR(ring.at(species[0], place), amplitude * std::cos(angle(place)), rounding());
    }
}

TEST_P(LinkedHeat, KeepsTheSum) {
    const Ring ring(GetParam());
    std::vector<Field> species;
    species.push_back(
        ring.field([](std::size_t place) { return scatter(static_cast<std::int64_t>(place), 1); }));
    const auto sum = [&] {
        double total = 0;
        for (std::size_t place = 0; place < Ring::cells; ++place)
            total += ring.at(species[0], place);
        return total;
    };
    const double before = sum();
    advance_quietly(ring.heat(0.25), {.last_step = 4000}, species);
    EXPECT_NEAR(sum(), before, Ring::cells * rounding());
    for (std::size_t place = 0; place < Ring::cells; ++place) {
        EXPECT_NEAR(ring.at(species[0], place), before / Ring::cells, 0.01);
    }
}

INSTANTIATE_TEST_SUITE_P(Precisions, LinkedHeat,
                         ::testing::Values(Precision::single, Precision::binary64),
                         [](const auto& tested) {
                             return tested.param == Precision::single ? "single" : "double";
                         });

/// The fastest wave of rates f_(p-1) − 2 f_p + f_(p+1) decays at the rate 4, so Euler's steps up to
/// 1/2 are stable.
TEST(StabilityOfLinkedCells, IsThatOfTheFastestWave) {
    const Ring ring(Precision::binary64);
    KernelBuilder builder(Precision::binary64);
    builder.result("f", builder.laplacian(builder.field_slot("f")));
    StepProblem rates = ring.heat(0);
    rates.passes[0].kernel =
        *make_interpreter()->compile(std::move(builder).finish(), Stencil::linked);
    rates.passes[0].uniforms.clear();
    std::vector<Field> species;
    species.push_back(ring.field([](std::size_t) { return 1.0; }));
    const StabilityEstimate estimate = estimate_stability(rates, species, nullptr);
    ASSERT_TRUE(estimate.largest_speed);
    EXPECT_NEAR(*estimate.largest_speed, 0.5, 0.02);
}

}  // namespace
}  // namespace cascade::test
