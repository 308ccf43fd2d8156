// Ranks share the runs of a sweep: each run is taken once, and the files have the same bytes.
#include "core/file.h"
#include "run/commands/sweep.h"
#include "run/commands/sweep_queue.h"
#include "tests/support/thread_messenger.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

namespace cascade::test {
namespace {

constexpr const char* swept_growth = R"(
system growth { u: 1 + random(0, 0.1); rate: 0.1; u' = rate * u^3 + lap(u) }
domain { grid: 8, 6 }
stage s: growth { iterations: 40; speed: 0.1 }
)";

class SharedSweeps : public ::testing::Test {
protected:
    SharedSweeps()
        : folder_(std::filesystem::path(::testing::TempDir()) /
                  ::testing::UnitTest::GetInstance()->current_test_info()->name()) {
        std::filesystem::remove_all(folder_);
    }
    ~SharedSweeps() override { std::filesystem::remove_all(folder_); }

    /// Sweeps over 3 rates, with one of which runs blow up, and over 4 seeds.
    SweepReport sweep_on(Messenger* messenger, const std::string& name,
                         SweepControl& control) const {
        SweepRequest request;
        request.varied = {*parse_variation("rate=0.01,0.02,2"), *parse_variation("seed=1,2,3,4")};
        request.folder = folder_ / name;
        request.simulation.backend = "interp";
        request.simulation.threads = 2;
        request.messenger = messenger;
        const Script script = load_script("ranks", swept_growth, ".", {});
        const auto report = sweep(script, request, control);
        EXPECT_TRUE(report) << (report ? "" : report.error().failure.message);
        return report ? *report : SweepReport();
    }

    std::string file(const std::string& name) const {
        const auto bytes = read_file(folder_ / name, 1 << 24);
        EXPECT_TRUE(bytes) << name;
        return bytes ? *bytes : "";
    }

    std::filesystem::path folder_;
};

TEST_F(SharedSweeps, HaveTheBytesOfOneProcess) {
    SweepControl control;
    const SweepReport alone = sweep_on(nullptr, "alone", control);
    EXPECT_EQ(alone.runs, 12u);
    EXPECT_EQ(alone.failed, 4u);
    for (int count = 1; count <= 4; ++count) {
        const std::string name = std::to_string(count);
        on_ranks(count, [&](Messenger& messenger) {
            SweepControl own;
            const SweepReport report = sweep_on(&messenger, name, own);
            if (messenger.rank() > 0) return;
            EXPECT_EQ(report.runs, 12u);
            EXPECT_EQ(report.failed, 4u);
            EXPECT_EQ(report.missing, 0u);
            EXPECT_EQ(report.steps, alone.steps);
            EXPECT_EQ(report.written.size(), alone.written.size());
        });
        for (const char* each : {"features.csv", "ensembles.csv", "sheet.png"}) {
            EXPECT_EQ(file("alone/" + std::string(each)), file(name + "/" + each)) << count;
        }
    }
}

TEST_F(SharedSweeps, GoOnAfterACancel) {
    on_ranks(3, [&](Messenger& messenger) {
        SweepControl control;
        if (messenger.rank() == 0) control.report = [&](const auto&) { control.cancel = true; };
        const SweepReport report = sweep_on(&messenger, "shared", control);
        if (messenger.rank() > 0) return;
        EXPECT_GT(report.missing, 0u);
    });
    std::size_t kept = 0;
    for (const auto& each : std::filesystem::directory_iterator(folder_ / "shared/runs")) {
        kept += each.path().extension() == ".json" ? 1 : 0;
    }
    on_ranks(2, [&](Messenger& messenger) {
        SweepControl control;
        const SweepReport report = sweep_on(&messenger, "shared", control);
        if (messenger.rank() > 0) return;
        EXPECT_EQ(report.missing, 0u);
        EXPECT_EQ(report.done_before, kept);
    });
    SweepControl control;
    sweep_on(nullptr, "alone", control);
    EXPECT_EQ(file("alone/features.csv"), file("shared/features.csv"));
    EXPECT_EQ(file("alone/sheet.png"), file("shared/sheet.png"));
}

/// Takes runs as a rank with a single thread does, and returns how many it has taken.
std::size_t take_all(SweepQueue& queue, std::vector<int>& taken) {
    std::size_t count = 0;
    const auto keep = [&] {
        for (const auto& each : queue.serve()) ++taken[each.run];
    };
    while (const auto run = queue.next(true)) {
        ++count;
        SweepResult result;
        result.remark = "run " + std::to_string(*run);
        if (queue.is_root()) {
            ++taken[*run];
        } else {
            queue.give(*run, result);
        }
        keep();
    }
    while (!queue.has_finished()) {
        keep();
        std::this_thread::yield();
    }
    return count;
}

TEST(SweepQueue, GivesEachRunToOneRank) {
    for (const std::size_t runs : {0u, 1u, 2u, 50u}) {
        std::vector<int> taken(runs);
        std::atomic<std::size_t> sum = 0;
        on_ranks(4, [&](Messenger& messenger) {
            std::vector<std::size_t> waiting;
            for (std::size_t k = 0; k < runs; ++k) waiting.push_back(k);
            SweepQueue queue(waiting, &messenger);
            sum += take_all(queue, taken);
        });
        EXPECT_EQ(sum, runs);
        EXPECT_EQ(taken, std::vector<int>(runs, 1));
    }
}

TEST(SweepResult, IsPackedAndUnpacked) {
    SweepResult result;
    result.steps = 17;
    result.remark = "stage 's': u is not finite any more";
    const auto again = unpack_result(pack_result(result));
    ASSERT_TRUE(again);
    EXPECT_EQ(again->steps, 17);
    EXPECT_EQ(again->remark, result.remark);
    EXPECT_TRUE(again->failed());
    EXPECT_FALSE(unpack_result(""));
    EXPECT_FALSE(unpack_result("{}"));
    const std::string packed = pack_result(result);
    EXPECT_FALSE(unpack_result(packed.substr(0, packed.size() - 1)));
}

}  // namespace
}  // namespace cascade::test
