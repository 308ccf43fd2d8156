// Stages on coarser grids take the same steps as in a domain with that grid. A run may be stopped
// in them, and they may be painted and drawn with --detail. Their values are tested in
// tests/scripts/steps.
#include "detailed_simulations.h"
#include "ran_text.h"
#include "resumed_run.h"

#include "run/simulation/other_cells.h"
#include "solvers/field_norms.h"
#include "support/kernel_comparison.h"

#include <fmt/format.h>

namespace cascade::test {
namespace {

constexpr const char* all_lengths =
    "system s { u: random(1, 0.3) + noise(3) + disc(0.3, 0.3, 0.2); h: domain.spacing\n"
    "  total = integral(u over domain)\n"
    "  u' = 0.1 * h * lap(u) + 0.01 * dx(u) - 1e-4 * total + 1e-3 * convolve(exp(-distance^2), u, 3)\n"
    "  u.left: slope(0.1 * y) }\n";

TEST(CoarserGrid, TakesTheStepsOfAGridOfItsCells) {
    const std::string plain =
        "domain { grid: 24, 16; boundary: noflux }\nstage a: s { iterations: 30 }\n";
    const std::string wide =
        "domain { grid: 96, 64; spacing: 1/4; boundary: noflux }\n"
        "stage a: s { grid: coarse(4); iterations: 30 }\n";
    for (const SimulationOptions& options : {interpreted(), compiled()}) {
        const Ran expected = run_text(all_lengths + plain, options);
        const Ran found = run_text(all_lengths + wide, options);
        EXPECT_EQ(same_bits(found.state().species(), expected.state().species()), "");
        EXPECT_EQ(found.simulation->domain().grid.width, 96);
        EXPECT_EQ(found.simulation->domain(0).grid.width, 24);
    }
}

TEST(CoarserGrid, KeepsWhatAStrokeDoesNotReach) {
    const Ran ran = run_text(std::string(all_lengths) +
                             "domain { grid: 48, 32; spacing: 1/2; boundary: noflux }\n"
                             "stage a: s { grid: coarse(2); iterations: 5; frozen: x > 0.7 }\n");
    const Simulation& simulation = *ran.simulation;
    const System& system = simulation.domain().program->system_of(0);
    for (const ItemId item : {ItemId(0), system.frozen_item()}) {
        std::vector<Field> found, own;
        found.push_back(in_cells_of(simulation, 0, item, Field(simulation.field(0, item))));
        own.emplace_back(ran.state().field(item));
        EXPECT_EQ(same_bits(found, own), "");
    }
    Field more(simulation.field(0, ItemId(0)));
    for (std::int64_t j = 0; j < 8; ++j) more.row(j)[9] += 2;
    const Field painted = in_cells_of(simulation, 0, ItemId(0), std::move(more));
    const Field& own = ran.state().species()[0];
    EXPECT_NEAR(painted.row(2)[4], own.row(2)[4] + 1, 1e-5) << "half of the cells of a wider one";
    EXPECT_EQ(painted.row(4)[4], own.row(4)[4]);
    EXPECT_EQ(painted.row(2)[5], own.row(2)[5]);
}

TEST(CoarserGrid, GoesOnInDividedCells) {
    const std::string heat =
        "domain { grid: 32, 32; boundary: noflux }\nsystem heat { u: x; u' = lap(u) }\n"
        "stage large: heat { grid: coarse(2); iterations: 20; speed: 0.2 }\n";
    for (const std::string last : {"", "grid: coarse(4); "}) {
        const DetailedSimulations run(heat + "stage small: heat { " + last +
                                      "u: u; iterations: 20; speed: 0.2 }\n");
        ASSERT_TRUE(run.finer);
        EXPECT_EQ(run.finer->domain(0).grid.width, 32);
        EXPECT_EQ(run.finer->domain(1).grid.width, 2 * run.coarse->domain(1).grid.width);
        EXPECT_EQ(shown_stage(*run.finer), 1u);
        for (const std::uint32_t stage : {0u, 1u}) {
            const FieldMoments before = moments(run.coarse->field(stage, ItemId(0)));
            const FieldMoments after = moments(run.finer->field(stage, ItemId(0)));
            EXPECT_NEAR(after.mean, before.mean, 1e-3);
            EXPECT_NEAR(after.deviation, before.deviation, 0.02 * before.deviation);
        }
    }
}

class CoarserGridRun : public ResumedRunTest {};

TEST_F(CoarserGridRun, ResumesWithTheSameBits) {
    const std::string text =
        "domain { grid: 48, 32; spacing: 1/2; boundary: noflux }\n"
        "stage large: turing_spots { grid: coarse(2); iterations: 40; ka: 1/80 }\n"
        "stage small: turing_spots { iterations: 20; speed: 0.2; frozen: b < 4; a: a; b: b; beta: "
        "beta; ka: 1/30 }\n"
        "stage last: turing_spots { grid: coarse(4); iterations: 20; a: a; b: b; beta: beta }\n";
    run_whole(text);
    EXPECT_EQ(array("whole/large.b.npy").size(), 24u * 16u);
    EXPECT_EQ(array("whole/last.beta.npy").size(), 12u * 8u);
    for (const auto& [stage, stop] :
         {std::pair("large", 7), std::pair("small", 0), std::pair("last", 9)}) {
        run_in_two_parts(text, stage, stop);
        for (const char* const file : {"large.b.npy", "small.a.npy", "last.a.npy"}) {
            EXPECT_EQ(bytes(std::string("whole/") + file), bytes(std::string("rest/") + file))
                << stage << " " << file;
        }
    }
}

}  // namespace
}  // namespace cascade::test
