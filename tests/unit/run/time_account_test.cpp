// The times of a run's parts add up to the whole, however the parts are nested.
#include "run/stage/time_account.h"
#include "tests/unit/run/run_fixture.h"

#include <thread>

namespace cascade {
namespace {

using namespace std::chrono_literals;

TEST(TimeAccount, AScopeTakesTheTimeOver) {
    TimeAccount account;
    {
        const TimeAccount::Scope steps(&account, Spent::stepping, 1);
        {
            const TimeAccount::Scope code(&account, Spent::compiling);
            std::this_thread::sleep_for(20ms);
        }
        const TimeAccount::Scope nobody(nullptr, Spent::drawing);
    }
    ASSERT_EQ(account.stages().size(), 2u);
    const auto at = [&](Spent what) {
        return account.stages()[1].seconds[static_cast<std::size_t>(what)];
    };
    EXPECT_GE(at(Spent::compiling), 0.02);
    EXPECT_EQ(account.seconds(Spent::compiling), at(Spent::compiling));
    EXPECT_EQ(account.seconds(Spent::drawing), 0);
    double sum = 0;
    for (std::size_t k = 0; k < spent_count; ++k) sum += account.seconds(static_cast<Spent>(k));
    EXPECT_LE(sum, account.seconds());
    EXPECT_GT(sum, 0.02);
}

class TimedRun : public RunTest {};

TEST_F(TimedRun, EveryStageHasItsParts) {
    Script script = load(two_stages);
    TimeAccount account;
    RunRequest timed = request();
    timed.simulation.account = &account;
    run_well(script, timed);
    ASSERT_EQ(account.stages().size(), 2u);
    EXPECT_EQ(account.stages()[0].name, "large");
    EXPECT_EQ(account.stages()[0].steps, 300);
    EXPECT_EQ(account.stages()[1].steps, 200);
    for (const auto& stage : account.stages()) {
        EXPECT_EQ(stage.cells, 24 * 18);
        for (const Spent what : {Spent::starting, Spent::compiling, Spent::stepping}) {
            EXPECT_GT(stage.seconds[static_cast<std::size_t>(what)], 0);
        }
    }
    EXPECT_GT(account.seconds(Spent::drawing), 0);
    EXPECT_EQ(account.seconds(Spent::cells), 0);
}

}  // namespace
}  // namespace cascade
