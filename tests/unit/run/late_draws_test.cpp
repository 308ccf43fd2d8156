// Random numbers of late steps, whose step numbers need more binary digits than binary32 has.
#include "run/simulation/stage_record.h"
#include "started_script.h"

#include <set>
#include <vector>

namespace cascade {
namespace {

/// The random numbers of the cells of a row in three steps that begin with the step `first`.
std::vector<std::vector<double>> draws_from(std::int64_t first, const std::string& precision,
                                            std::string_view backend) {
    std::vector<std::vector<double>> draws;
    Script script = load_script("late.cascade",
                                "system s { c: 0; c' = random(0, 1) - c }\n"
                                "domain { grid: 8, 1; precision: " +
                                    precision +
                                    " }\n"
                                    "stage only: s { iterations: 1000000000 }\n",
                                ".");
    EXPECT_TRUE(script.program) << script.messages(false);
    for (std::int64_t step = first; step < first + 3; ++step) {
        auto simulation = Simulation::create(script, {backend, 0, 1});
        EXPECT_TRUE(simulation);
        EXPECT_TRUE((*simulation)->start_stage(0));
        StageRecord record =
            record_of((*simulation)->state(0), *(*simulation)->domain().program, 0);
        record.steps = step;
        record.t = static_cast<double>(step);
        restore(**simulation, 0, std::move(record));
        RunControl control;
        EXPECT_TRUE((*simulation)->advance_stage(0, step + 1, control, {}));
        std::vector<double>& row = draws.emplace_back();
        for (int i = 0; i < 8; ++i)
            row.push_back((*simulation)->state(0).species()[0].number_at(i, 0));
    }
    return draws;
}

TEST(LateDraws, AreNewInEveryStep) {
    for (const std::string precision : {"single", "double"}) {
        for (const std::int64_t first : {std::int64_t{1} << 24, std::int64_t{999'999'990}}) {
            const auto expected = draws_from(first, precision, "interp");
            EXPECT_EQ(std::set(expected.begin(), expected.end()).size(), 3u)
                << precision << ", " << first;
            for (const std::string& backend : available_backends()) {
                EXPECT_EQ(draws_from(first, precision, backend), expected)
                    << precision << ", " << first;
            }
        }
    }
}

}  // namespace
}  // namespace cascade
