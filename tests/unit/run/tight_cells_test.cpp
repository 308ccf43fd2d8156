// A few very small cells of a mesh do not limit the steps of all cells.
#include "run_fixture.h"
#include "torus_triangles.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

namespace cascade {
namespace {

using test::Triangles;

class TightCellsTest : public RunTest {
protected:
    struct Found {
        std::uint32_t parts = 0;  ///< The number of parts of each step.
        double rate = 0;          ///< The rate at which the starting values of u decay.
    };

    Found heat_on(const std::string& domain) {
        constexpr int steps = 100;
        constexpr double speed = 0.5;
        Script script =
            load(fmt::format("domain {{ {} }}\nsystem s {{ u: x - 0.5\n u' = lap(u) }}\n"
                             "stage only: s {{ iterations: {}; speed: {} }}\n",
                             domain, steps, speed));
        EXPECT_TRUE(script.program) << script.messages(false);
        if (!script.program) return {};
        auto made = Simulation::create(script, {"interp", 0, 2});
        EXPECT_TRUE(made) << (made ? "" : made.error().message);
        if (!made) return {};
        Simulation& simulation = **made;
        EXPECT_TRUE(simulation.start_stage(0));
        const auto u = [&] {
            return cell_values(simulation.state(0).species()[0], *simulation.domain().model->cells);
        };
        const std::vector<double> before = u();
        RunControl control;
        EXPECT_TRUE(simulation.advance_stage(0, steps, control, {}));
        const std::vector<double> after = u(),
                                  &areas = simulation.domain().model->cells->spread().cells.areas;
        double both = 0, square = 0;
        for (std::size_t k = 0; k < before.size(); ++k) {
            both += areas[k] * before[k] * after[k];
            square += areas[k] * before[k] * before[k];
        }
        return {simulation.state(0).time.stages, -std::log(both / square) / (steps * speed)};
    }
};

TEST_F(TightCellsTest, AFewSliversOfAMeshShortenNoSteps) {
    const Triangles even = Triangles::torus().finer().finer();
    ASSERT_TRUE(write_file(path("even.obj"), even.obj()));
    ASSERT_TRUE(write_file(path("slivers.obj"), even.with_few_slivers().obj()));
    for (const char* cells : {"faces", "vertices"}) {
        const auto found = [&](const char* name) {
            return heat_on(fmt::format("mesh: \"{}.obj\"; unit: 0.06; cells: {}", name, cells));
        };
        const Found without = found("even"), with = found("slivers");
        EXPECT_GT(without.parts, 1u) << cells;
        EXPECT_LE(with.parts, without.parts + 1) << cells;
        EXPECT_NEAR(with.rate / without.rate, 1, 0.002) << cells;
        const Found spread = heat_on("mesh: \"even.obj\"; unit: 0.06; cells: 8000");
        EXPECT_NEAR(with.rate / spread.rate, 1, 0.03) << cells;
    }
}

}  // namespace
}  // namespace cascade
