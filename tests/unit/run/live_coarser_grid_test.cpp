// Sessions with stages on coarser grids.
#include "live_run_fixture.h"

#include "support/kernel_comparison.h"

namespace cascade::test {
namespace {

class LiveCoarserGrid : public LiveRunFixture {
protected:
    std::string difference_of_values(const StageState& one, const StageState& other,
                                     bool) const override {
        return same_bits(one.species(), other.species());
    }
};

constexpr const char* two_grids =
    "domain { grid: 32, 16; boundary: noflux }\nsystem heat { u: x; c: 0.1; u' = c * lap(u) }\n"
    "stage large: heat { grid: coarse(2); iterations: 20 }\n"
    "stage small: heat { u: u; iterations: 20 }\n";

TEST_F(LiveCoarserGrid, StrokesAreTakenBack) {
    const auto run = begun(two_grids), other = begun(two_grids);
    advance(*run, 10);
    apply(*run, Paint{"u", "if(disc(0.3, 0.3, 0.2) > 0, 9, u)"});
    EXPECT_NE(difference(*run, *other), "");
    advance(*run, 5);
    expect_same_from_log(*run);
    ASSERT_TRUE(run->undo(control_));
    advance(*other, run->place().steps);
    EXPECT_EQ(difference(*run, *other), "");
    advance(*run, 1000);
    advance(*other, 1000);
    EXPECT_EQ(difference(*run, *other), "");
}

TEST_F(LiveCoarserGrid, OtherCellsBeginAnew) {
    const auto run = begun(two_grids);
    advance(*run, 25);
    apply(*run, SetNumber{"c", "0.2"});
    EXPECT_EQ(run->place(), (RunPlace{1, 5}));
    apply(*run, SetText{with(two_grids, "coarse(2)", "coarse(4)")});
    EXPECT_EQ(run->place(), (RunPlace{0, 0}));
    advance(*run, 1000);
    EXPECT_TRUE(run->is_over());
}

}  // namespace
}  // namespace cascade::test
