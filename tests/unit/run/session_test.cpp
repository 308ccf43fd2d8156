// The thread of a session: which commands it obeys, what its readers get, and that threads change
// no bit.
#include "run/session/session.h"

#include "support/kernel_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace cascade::test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr const char* spots_of_session =
    "domain { grid: 24, 20 }\n"
    "stage one: turing_spots { iterations: 400 }\n"
    "stage two: turing_spots { a: a; b: b; beta: beta; ka: 1/20; iterations: 300 }\n";

std::unique_ptr<Session> begun(const std::string& text) {
    RunControl control;
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    auto session = Session::begin(load_script("test", text, "."), options, control);
    EXPECT_TRUE(session) << session.error().messages(false);
    return session ? std::move(*session) : nullptr;
}

/// Waits for the end of a command. Returns its messages.
std::string done(Session& session, SessionCommand command) {
    std::promise<std::string> messages;
    session.post(std::move(command), [&](const Accepted<void>& result) {
        messages.set_value(result ? "" : result.error().messages(false));
    });
    return messages.get_future().get();
}

SessionLog log_of(Session& session) {
    std::promise<SessionLog> log;
    session.ask([&](LiveRun& run) { log.set_value(run.log()); });
    return log.get_future().get();
}

std::vector<Field> species_of(Session& session) {
    std::promise<std::vector<Field>> values;
    session.ask([&](LiveRun& run) {
        std::vector<Field> copies;
        const auto& state = run.simulation().state(run.place().stage);
        for (const Field& field : state.species()) copies.push_back(field.clone());
        values.set_value(std::move(copies));
    });
    return values.get_future().get();
}

std::shared_ptr<const Snapshot> snapshot_when(Session& session,
                                              const std::function<bool(const Snapshot&)>& holds) {
    const auto end = std::chrono::steady_clock::now() + 30s;
    auto snapshot = session.newest();
    while (!holds(*snapshot) && std::chrono::steady_clock::now() < end) {
        if (auto newer = session.newer_than(snapshot->number, 100ms)) snapshot = newer;
    }
    EXPECT_TRUE(holds(*snapshot)) << "it is at step " << snapshot->place.steps << " of stage "
                                  << snapshot->place.stage + 1 << " " << snapshot->failure;
    return snapshot;
}

TEST(SessionTest, RunsToTheEndAndShowsIt) {
    const auto session = begun(spots_of_session);
    const auto first = session->newest();
    EXPECT_FALSE(first->is_going_on);
    ASSERT_EQ(first->fields.size(), 1u);
    EXPECT_EQ(first->fields[0].layout().width, 24);
    EXPECT_EQ(done(*session, GoOn{}), "");
    const auto last = snapshot_when(*session, [](const Snapshot& s) {
        return !s.is_going_on && s.place == RunPlace{1, 300};
    });
    ASSERT_EQ(last->stages.size(), 2u);
    EXPECT_EQ(last->stages[0].name, "one");
    EXPECT_EQ(last->stages[0].steps, 400);
    EXPECT_TRUE(last->stages[1].has_ended);
    const auto values = species_of(*session);
    EXPECT_EQ(last->fields[0].number_at(3, 7), values[1].number_at(3, 7)) << "'b' is shown";
}

TEST(SessionTest, TakesAsManyStepsAsAskedFor) {
    const auto session = begun(spots_of_session);
    done(*session, TakeSteps{37});
    snapshot_when(*session, [](const Snapshot& s) { return s.place == RunPlace{0, 37}; });
    done(*session, TakeSteps{400});
    snapshot_when(*session, [](const Snapshot& s) { return s.place == RunPlace{1, 37}; });
}

/// A script whose first stage ends in a chequerboard, because its steps are too long.
constexpr const char* too_long_steps =
    "domain { grid: 32, 32 }\n"
    "stage warm: turing_spots { iterations: 3000; diff_a: .25; diff_b: .0625; ka: 0.02 }\n"
    "stage two: turing_spots { a: a; b: b; iterations: 10 }\n";

bool has_doubt(const Snapshot& snapshot) {
    const auto is_doubt = [](const std::string& words) {
        return words.find("chequerboard") != std::string::npos;
    };
    return std::any_of(snapshot.remarks.begin(), snapshot.remarks.end(), is_doubt);
}

TEST(SessionTest, TellsTheDoubtsOfAStageThatEnds) {
    const auto session = begun(too_long_steps);
    done(*session, TakeSteps{2990});
    const auto on_the_way = snapshot_when(*session, [](const Snapshot& s) {
        return s.place == RunPlace{0, 2990};
    });
    EXPECT_FALSE(has_doubt(*on_the_way));
    done(*session, TakeSteps{10});
    const auto ended = snapshot_when(*session, [](const Snapshot& s) {
        return s.stages[0].has_ended && !s.is_going_on;
    });
    EXPECT_TRUE(has_doubt(*ended));
    EXPECT_EQ(ended->remarks.size(), 1u) << "a stage in doubt gets no other remark";
}

TEST(SessionTest, TellsTheDoubtsOfAStageThatIsLeft) {
    const auto session = begun(too_long_steps);
    done(*session, TakeSteps{2990});
    snapshot_when(*session, [](const Snapshot& s) { return s.place == RunPlace{0, 2990}; });
    EXPECT_EQ(done(*session, MakeChange{NextStage{}}), "");
    snapshot_when(*session, has_doubt);
}

TEST(SessionTest, ForgetsWhatItSaidOfAnEndThatIsTakenBack) {
    const auto session = begun(too_long_steps);
    done(*session, TakeSteps{3000});
    snapshot_when(*session, [](const Snapshot& s) { return has_doubt(s) && !s.is_going_on; });
    done(*session, Show{"b"});
    snapshot_when(*session, has_doubt);
    done(*session, GoToStage{0});
    snapshot_when(*session, [](const Snapshot& s) {
        return s.place == RunPlace{0, 0} && !has_doubt(s);
    });
}

TEST(SessionTest, AnswersWhatIsWrongAndGoesOn) {
    const auto session = begun(spots_of_session);
    done(*session, GoOn{});
    EXPECT_THAT(done(*session, MakeChange{SetText{"stage x: nonsense {}"}}),
                HasSubstr("test:1:10: error"));
    EXPECT_THAT(done(*session, MakeChange{Paint{"nobody", "1"}}), HasSubstr("nobody"));
    EXPECT_THAT(done(*session, Show{"b +"}), HasSubstr("error"));
    EXPECT_THAT(done(*session, GoToStage{7}), HasSubstr("no stage 8"));
    EXPECT_THAT(done(*session, Undo{}), HasSubstr("nothing is left to undo"));
    done(*session, GoOn{});
    snapshot_when(*session, [](const Snapshot& s) { return s.stages[1].has_ended; });
}

TEST(SessionTest, ShowsWhatIsAskedFor) {
    const auto session = begun(spots_of_session);
    EXPECT_EQ(done(*session, Show{"a + 100"}), "");
    const auto snapshot =
        snapshot_when(*session, [](const Snapshot& s) { return s.fields[0].number_at(0, 0) > 50; });
    EXPECT_EQ(done(*session, Show{"rgb(0.1, 0.2, 0.3)"}), "");
    snapshot_when(*session, [](const Snapshot& s) { return s.fields.size() == 3; });
    EXPECT_EQ(done(*session, Show{""}), "");
    snapshot_when(*session, [](const Snapshot& s) { return s.fields.size() == 1; });
}

TEST(SessionTest, ShowsTheSliceThatIsAskedFor) {
    const auto session = begun(
        "domain { grid: 6, 5, 4 }\nsystem s { u: x + 10 * y + 100 * z; u' = 0 }\n"
        "stage s: s { iterations: 9 }\n");
    const auto is_wide = [](std::int64_t width, std::int64_t height) {
        return [=](const Snapshot& s) {
            const PlaneLayout& layout = s.fields[0].layout();
            return layout.width == width && layout.height == height && layout.depth == 1;
        };
    };
    snapshot_when(*session, is_wide(6, 5));
    EXPECT_EQ(done(*session, ShowSlice{{Axis::y, 0.7}}), "");
    const auto snapshot = snapshot_when(*session, is_wide(6, 4));
    EXPECT_EQ(snapshot->slice, (Slice{Axis::y, 0.7}));
    EXPECT_EQ(snapshot->grid.depth, 4);
    EXPECT_NEAR(snapshot->fields[0].number_at(2, 1), (2.5 + 35 + 150) / 6, 1e-4);
    EXPECT_EQ(done(*session, ShowSlice{{Axis::x, 0}}), "");
    snapshot_when(*session, is_wide(4, 5));
}

TEST(SessionTest, AFailureStopsItAtTheLastGoodStep) {
    const auto session = begun(
        "domain { grid: 8, 8 }\nsystem s { u: 1 + x; u' = u^2 }\nstage s: s { iterations: 999 }\n");
    done(*session, GoOn{});
    const auto stopped =
        snapshot_when(*session, [](const Snapshot& s) { return !s.failure.empty(); });
    EXPECT_FALSE(stopped->is_going_on);
    EXPECT_THAT(stopped->failure, HasSubstr("not finite"));
    EXPECT_GT(stopped->place.steps, 0);
    EXPECT_EQ(done(*session, GoToStage{0}), "");
    snapshot_when(*session, [](const Snapshot& s) { return s.failure.empty(); });
}

/// Whatever readers and writers do at the same time, playing the log gives the same bits.
TEST(SessionTest, ThreadsChangeNoBit) {
    std::string text = spots_of_session;
    text.replace(text.find("400"), 3, "400000");
    const auto session = begun(text);
    std::atomic<bool> is_over{false};
    std::uint64_t seen = 0;
    std::thread reader([&] {
        while (!is_over) {
            const auto snapshot = session->newer_than(seen, 5ms);
            if (!snapshot) continue;
            EXPECT_GT(snapshot->number, seen);
            seen = snapshot->number;
        }
    });
    done(*session, GoOn{});
    std::thread painter([&] {
        for (int k = 0; k < 12; ++k) {
            session->post(MakeChange{Paint{"b", "b + disc(0.5, 0.5, 0.2)"}, k % 3 > 0});
            std::this_thread::sleep_for(3ms);
        }
    });
    for (int k = 0; k < 12; ++k) {
        session->post(MakeChange{SetNumber{"one.ka", "1/" + std::to_string(70 + k)}});
        std::this_thread::sleep_for(4ms);
        if (k % 4 == 3) session->post(Undo{});
        session->post(GoOn{});
    }
    painter.join();
    session->post(Pause{});
    EXPECT_EQ(done(*session, MakeChange{NextStage{}}), "");
    EXPECT_EQ(done(*session, TakeSteps{20}), "");
    snapshot_when(*session, [](const Snapshot& s) { return s.place == RunPlace{1, 20}; });
    is_over = true;
    reader.join();
    RunControl control;
    SimulationOptions options;
    options.threads = 2;
    const auto again = LiveRun::play(log_of(*session), ".", options, control);
    ASSERT_TRUE(again) << again.error().messages(false);
    EXPECT_EQ(same_bits(species_of(*session), (*again)->simulation().state(1).species()), "");
}

TEST(SessionTest, EndsWhileStepsAreTaken) {
    std::string text = spots_of_session;
    text.replace(text.find("400"), 3, "400000000");
    for (int k = 0; k < 20; ++k) {
        const auto session = begun(text);
        session->post(GoOn{});
        if (k % 2 == 0) std::this_thread::sleep_for(2ms);
        if (k % 3 == 0) session->cancel();
    }
}

}  // namespace
}  // namespace cascade::test
