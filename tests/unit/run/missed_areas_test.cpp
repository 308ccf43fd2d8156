// Shapes in space that contain no cell of a model have no effect, and a warning says so.
#include "run_fixture.h"

#include <gmock/gmock.h>

namespace cascade {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class MissedAreas : public RunTest {
protected:
    void SetUp() override {
        RunTest::SetUp();
        ASSERT_TRUE(
            write_file(path("octahedron.obj"),
                       "v 1 0 0\nv 0 1 0\nv 0 0 1\nv -1 0 0\nv 0 -1 0\nv 0 0 -1\n"
                       "f 1 2 3\nf 2 4 3\nf 4 5 3\nf 5 1 3\nf 2 1 6\nf 4 2 6\nf 5 4 6\nf 1 5 6\n"));
    }

    std::vector<std::string> warnings(const std::string& domain, const std::string& statements) {
        Script script =
            load("domain { " + domain + " }\nstage one: turing_spots { " + statements + " }\n");
        EXPECT_TRUE(script.program) << script.messages(false);
        RunControl control;
        std::vector<std::string> said;
        control.warn = [&](const std::string& warning) { said.push_back(warning); };
        SimulationOptions options{"interp", 0, 1};
        options.control = &control;
        EXPECT_TRUE(Simulation::create(script, options)) << script.messages(false);
        return said;
    }
};

constexpr const char* octahedron = "mesh: \"octahedron.obj\"; cells: 400";

TEST_F(MissedAreas, AreSaidWithTheirText) {
    EXPECT_THAT(warnings(octahedron, "a: 4 + disc(0.5, 0.5, 0.5, 0.2)"),
                ElementsAre("no cell of the model lies in disc(0.5, 0.5, 0.5, 0.2)"));
    EXPECT_THAT(warnings(octahedron,
                         "frozen: box(0, 0, 0, 0.1, 0.1, 0.1) or disc(0.5, 1, 0.5, 0.2)"),
                ElementsAre("no cell of the model lies in box(0, 0, 0, 0.1, 0.1, 0.1)"));
    EXPECT_THAT(warnings(octahedron,
                         "a: 4 + ring(0.5, 0.5, 0.5, 0.2, 0.1)\n b: 4 + disc(2, 0.5, 0.1)"),
                ElementsAre("no cell of the model lies in ring(0.5, 0.5, 0.5, 0.2, 0.1)",
                            "no cell of the model lies in disc(2, 0.5, 0.1)"));
}

TEST_F(MissedAreas, OthersAreNot) {
    EXPECT_THAT(warnings(octahedron, "a: 4 + disc(0.5, 1, 0.5, 0.2) + disc(0.5, 0.5, 0.1)"),
                IsEmpty());
    EXPECT_THAT(warnings(octahedron, "a: 4 + ring(0.5, 0.5, 0.5, 0.5, 0.1)"), IsEmpty());
    // A shape whose size is computed may be empty at the start, so there is no warning.
    EXPECT_THAT(warnings(octahedron, "a: 4 + disc(0.5, 0.5, 0.5, 0.2 * ny)"), IsEmpty());
    EXPECT_THAT(warnings("grid: 9, 9", "a: 4 + disc(2, 2, 0.001)"), IsEmpty());
}

}  // namespace
}  // namespace cascade
