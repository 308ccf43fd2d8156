// Stages that start on coarser grids: their pattern is as good as that of a run on the fine grid
// alone, and a run may be stopped on any grid. What each grid starts with is tested in
// tests/scripts/steps.
#include "ran_text.h"
#include "resumed_run.h"

#include "measure/spectrum.h"
#include "run/simulation/simulation.h"
#include "solvers/field_norms.h"

#include <fmt/format.h>

namespace cascade {
namespace {

double wavelength(const Field& field) {
    const PlaneLayout& layout = field.layout();
    measure::Samples samples;
    samples.cells = {static_cast<std::size_t>(layout.width),
                     static_cast<std::size_t>(layout.height), 1};
    for (std::int64_t j = 0; j < layout.height; ++j) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            samples.values.push_back(static_cast<double>(field.at(i, j)));
        }
    }
    return measure::peak_wavelength(measure::radial_spectrum(samples));
}

TEST(CoarseStart, GrowsAsGoodAPattern) {
    SimulationOptions options;
    options.threads = 1;
    const auto spots = [&](const std::string& settings) {
        return run_text("stage s: turing_spots { ka: 0.05/16; " + settings +
                            " }\ndomain { grid: 96, 96 }",
                        options);
    };
    const Ran fine = spots("iterations: 28000");
    const Ran coarse = spots("iterations: 1750; start: coarse(4)");
    const Field& expected = fine.simulation->state(0).species()[1];
    const Field& found = coarse.simulation->state(0).species()[1];
    EXPECT_NEAR(wavelength(found) / wavelength(expected), 1, 0.08);
    EXPECT_NEAR(moments(found).mean / moments(expected).mean, 1, 0.03);
    EXPECT_NEAR(moments(found).deviation / moments(expected).deviation, 1, 0.08);
    EXPECT_EQ(coarse.ended,
              (std::vector<std::string>{"s, cells 4 times as wide: 28000",
                                        "s, cells 2 times as wide: 7000", "s: 1750"}));
}

class CoarseStartRun : public ResumedRunTest {};

TEST_F(CoarseStartRun, ResumesWithTheSameBits) {
    const std::string text =
        "stage one: turing_spots { start: coarse(2); iterations: 30; ka: 1/80 }\n"
        "domain { grid: 32, 24 }";
    run_whole(text);
    for (const std::int64_t stop : {0, 7}) {
        run_in_two_parts(text, "one", stop);
        EXPECT_EQ(bytes("whole/one.b.npy"), bytes("rest/one.b.npy")) << stop;
    }
}

}  // namespace
}  // namespace cascade
