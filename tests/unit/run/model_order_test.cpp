// The cells of a model lie in memory in the order in which steps are fastest. No result depends on
// this order: files, random numbers and sums follow the cells' own order.
#include "mesh/flat.h"
#include "run/domain/model_cells.h"
#include "started_script.h"
#include "unit/surface/cell_gradients.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <string>

namespace cascade {
namespace {

using test::load;
using test::result_of;
using test::start;

constexpr std::size_t some_cells = 1300;  // Three rows of 512, the last of them not full.

std::string on_sphere(const std::string& system) {
    return "domain { surface: sphere; cells: " + std::to_string(some_cells) + "; seed: 3 }\n" +
           "system s {\n" + system + "}\nstage only: s { iterations: 20; speed: 0.05 }\n";
}

TEST(ModelOrder, PlanesAreThoseOfTheCellsInTheirOwnOrder) {
    Script script = load(on_sphere("  u: 0\n  u' = lap(u)\n"));
    const auto simulation = start(script);
    ASSERT_TRUE(simulation);
    const ModelCells& model = *simulation->domain().model->cells;
    ASSERT_EQ(model.count(), some_cells);
    std::vector<std::uint32_t> sorted = model.spread().order;
    EXPECT_FALSE(std::is_sorted(sorted.begin(), sorted.end())) << "cells lie by their links";
    std::sort(sorted.begin(), sorted.end());
    std::vector<std::uint32_t> all(some_cells);
    std::iota(all.begin(), all.end(), 0U);
    EXPECT_EQ(sorted, all);

    const auto plane = [&](ModelPlane which) -> const Field& {
        return model.spread().planes[static_cast<std::size_t>(which)];
    };
    const Field numbers = in_one_row(plane(ModelPlane::number), model);
    const auto x = cell_values(plane(ModelPlane::nx), model);
    const auto y = cell_values(plane(ModelPlane::ny), model);
    for (std::size_t k = 0; k < some_cells; ++k) {
        std::uint32_t number = 0;
        const float as_float = numbers.plane<float>().row(0)[k];
        std::memcpy(&number, &as_float, sizeof number);
        EXPECT_EQ(number, k);
        // On the unit sphere around the origin the normal at a place equals the place.
        const Vector3d place = unit(position_of(model.mesh, model.spread().cells.places[k]));
        EXPECT_NEAR(x[k], place.x, 0.02);
        EXPECT_NEAR(y[k], place.y, 0.02);
    }
}

TEST(ModelOrder, RowsOfFilesComeBackAsTheyWere) {
    Script script = load(on_sphere("  u: random(0, 1)\n  u' = lap(u)\n"));
    const auto simulation = start(script);
    ASSERT_TRUE(simulation);
    const ModelCells& model = *simulation->domain().model->cells;
    const Field& field = simulation->state(0).species()[0];
    const Field back = in_rows(in_one_row(field, model), model);
    for (std::int64_t row = 0; row < model.grid().height; ++row) {
        for (std::int64_t i = 0; i < model.grid().width; ++i) {
            EXPECT_EQ(back.number_at(i, row), field.number_at(i, row)) << i << ", " << row;
        }
    }
}

/// Compares with a loop in single precision over the cells in their own order, and over the edges
/// in their own order.
TEST(ModelOrder, StepsAreThoseOfALoopOverTheCellsInTheirOwnOrder) {
    Script script = load(on_sphere("  u: random(0, 1)\n  u' = lap(u)\n"));
    const auto simulation = start(script);
    ASSERT_TRUE(simulation);
    const ModelCells& model = *simulation->domain().model->cells;
    const SurfaceCells& cells = model.spread().cells;
    const auto values = [&] {
        const std::vector<double> found = cell_values(simulation->state(0).species()[0], model);
        return std::vector<float>(found.begin(), found.end());
    };
    std::vector<float> expected = values();
    EXPECT_GT(*std::max_element(expected.begin(), expected.end()), 0.9F);
    RunControl control;
    std::string warned;
    control.warn = [&](const std::string& text) { warned += text; };
    ASSERT_TRUE(simulation->advance_stage(0, 20, control, {}));
    EXPECT_EQ(warned, "") << "steps are whole ones";

    for (int step = 0; step < 20; ++step) {
        const std::vector<float> old = expected;
        for (std::size_t cell = 0; cell < some_cells; ++cell) {
            const double area = cells.areas[cell] / (model.spread().unit * model.spread().unit);
            float sum = 0;
            for (const VoronoiEdge& edge : cells.edges_of(cell)) {
                const auto weight = static_cast<float>(edge.length / edge.distance / area);
                sum += weight * (old[edge.neighbour] - old[cell]);
            }
            expected[cell] = old[cell] + 0.05F * sum;
        }
    }
    EXPECT_EQ(values(), expected);
}

TEST(ModelOrder, GradientsAreThoseOfTheCellsInTheirOwnOrder) {
    Script script = load(on_sphere("  u: 0\n  u' = 0 * u\n  f: sy * sy\n  r: dz(f) - 2 * dy(f)\n"));
    const auto simulation = start(script);
    ASSERT_TRUE(simulation);
    const ModelCells& model = *simulation->domain().model->cells;
    const std::vector<double> f = cell_values(result_of(*simulation, "f"), model);
    const std::vector<double> r = cell_values(result_of(*simulation, "r"), model);
    Team team(1);
    const std::atomic<bool> cancel = false;
    const auto gradients =
        cell_gradients(model.spread().cells,
                       cell_gradient_weights(model.mesh, model.spread().cells, team, cancel), f);
    double largest = 0;
    for (std::size_t k = 0; k < some_cells; ++k) {
        const double expected = (gradients[k].z - 2 * gradients[k].y) * model.spread().unit;
        EXPECT_NEAR(r[k], expected, 2e-6) << k;
        largest = std::max(largest, std::abs(expected));
    }
    EXPECT_GT(largest, 0.05) << "there is something to compare";
}

TEST(ModelOrder, AValueThatIsNotFiniteIsThatOfACell) {
    Script script = load(on_sphere("  u: if(y > 0.999, 1, 0)\n  u' = 1e38 * u * u\n"));
    const auto simulation = start(script);
    ASSERT_TRUE(simulation);
    const ModelCells& model = *simulation->domain().model->cells;
    RunControl control;
    const auto end = simulation->advance_stage(0, 20, control, {});
    ASSERT_FALSE(end);
    const std::string& message = end.error().message;
    const std::size_t at = message.find("at cell ");
    ASSERT_NE(at, std::string::npos) << message;
    const std::size_t cell = std::stoul(message.substr(at + 8));
    ASSERT_LT(cell, some_cells);
    EXPECT_GT(position_of(model.mesh, model.spread().cells.places[cell]).y, 0.9) << message;
}

}  // namespace
}  // namespace cascade
