// The output of `cascade bench` and `--timing` for known numbers.
#include "app/bench_table.h"
#include "app/time_table.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

namespace cascade {
namespace {

using testing::HasSubstr;
using testing::Not;

StageBench stage_at(double share_of_memory) {
    StageBench bench;
    bench.stage = "s";
    bench.solver = "euler";
    bench.grid = {1000, 1000};
    bench.step = 1e-3;
    bench.steps = 1234;
    bench.batches = 11;
    bench.work.cost.operations = 10;
    bench.work.cost.loads = 5;
    bench.work.cost.load_bytes = 10;
    bench.work.bytes = 8;
    bench.work.working_set = 8e6;
    MachineLimits limits;
    limits.operations = 1e11;
    limits.memories = {{"first-level cache", 32768, 2e11},
                       {"memory", std::numeric_limits<double>::infinity(), 8e9 / share_of_memory}};
    bench.limits = limits;
    return bench;
}

TEST(BenchTable, SaysWhatBounds) {
    EXPECT_EQ(bound_sentence(stage_at(0.8)), "planes, memory: 8.00 GB/s of 10.0 GB/s, 80 %");
    EXPECT_THAT(bound_sentence(stage_at(0.2)),
                HasSubstr("no limit is near; the nearest is planes, memory"));
    EXPECT_THAT(bound_sentence(stage_at(2)),
                HasSubstr("planes, memory: 200 %, since part of it stays nearer"));
    EXPECT_THAT(bound_sentence(stage_at(2)), HasSubstr("nearest is arithmetic"));
    StageBench few = stage_at(0.8);
    few.most_threads = 2;
    EXPECT_THAT(bound_sentence(few), HasSubstr("1 of 2 threads took the steps"));
    few.is_native = false;
    EXPECT_THAT(bound_sentence(few), HasSubstr("steps are interpreted"));
    EXPECT_EQ(bound_sentence(StageBench()), "");
    StageBench tiled = stage_at(0.8);
    tiled.stepping.sweeps_at_once = 16;
    tiled.stepping.bytes_in_use = 2e4;
    EXPECT_THAT(bound_sentence(tiled), HasSubstr("no limit is near; the nearest is arithmetic"));
}

TEST(BenchTable, HasAllNumbers) {
    const std::string table = bench_table("a.cascade", stage_at(0.8));
    for (const char* const part :
         {"a.cascade, stage 's': euler, 1000 × 1000 cells, single, native code",
          "1.00 G cell-steps/s, 1.00 ms a step", "1,234 steps, the median of 11 batches, 1 thread",
          "10 operations, 5 loads, 0 stores, in 0 passes", "8 bytes a cell-step; 8.00 MB in all",
          "1.25 G cell-steps/s by memory, of which 80 % are reached"}) {
        EXPECT_THAT(table, HasSubstr(part));
    }
    StageBench one = stage_at(0.8);
    one.work.cost.stores = 1;
    EXPECT_THAT(bench_table("a.cascade", one), HasSubstr("5 loads, 1 store,"));
    StageBench tiled = stage_at(0.8);
    tiled.stepping = {"16 steps a pass", "", 16, 1, 20480};
    EXPECT_THAT(bench_table("a.cascade", tiled), HasSubstr("1 thread; 16 steps a pass"));
    EXPECT_THAT(bench_table("a.cascade", tiled),
                HasSubstr("16 sweeps at once, 0.5 of those bytes through memory; 20.5 kB in use"));
    StageBench nothing;
    nothing.nothing = "it takes no step";
    EXPECT_THAT(bench_table("a.cascade", nothing), HasSubstr("it takes no step"));
}

TEST(BenchTable, RowsHaveTheColumnsOfTheirHeader) {
    const auto columns = [](const std::string& row) {
        return std::count(row.begin(), row.end(), ',');
    };
    EXPECT_EQ(columns(bench_csv_row("a,b.cascade", stage_at(1))), columns(bench_csv_header()));
    StageBench nothing;
    nothing.nothing = "it takes no step";
    EXPECT_EQ(columns(bench_csv_row("a", nothing)), columns(bench_csv_header()));
}

TEST(TimeTable, HasBarsInATerminalOnly) {
    TimeAccount account;
    account.stage(0).name = "large";
    account.stage(0).stepping.words = "16 steps a pass";
    account.stage(0).steps = 1000;
    account.stage(0).cells = 2000000;
    account.stage(0).seconds[static_cast<std::size_t>(Spent::stepping)] = 2;
    const std::string plain = time_table(account, false), bars = time_table(account, true);
    EXPECT_THAT(plain, HasSubstr("1,000 steps, 1.00 G cell-steps/s; 16 steps a pass"));
    EXPECT_THAT(plain, Not(HasSubstr("▆")));
    EXPECT_THAT(bars, HasSubstr("▆▆▆"));
    EXPECT_THAT(plain, Not(HasSubstr("  large")));
    account.stage(1).name = "small";
    EXPECT_THAT(time_table(account, false), HasSubstr("\n  large  "));
    account.stage(0).seconds[static_cast<std::size_t>(Spent::stepping)] = 20;
    EXPECT_THAT(time_table(account, false), HasSubstr("20.000 s"));
}

}  // namespace
}  // namespace cascade
