// A live run in a thread of its own: commands in, the newest snapshot out.
#pragma once

#include "core/run_control.h"
#include "run/pictures/painter.h"
#include "run/session/live_run.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace cascade {

// clang-format off
/// LiveRun::apply(): with `joins_last`, undone together with the change before.
struct MakeChange { Change change; bool joins_last = false; };
struct GoToStage { std::uint32_t stage = 0; };
struct Undo {};
struct Redo {};
struct GoOn {};                                  ///< Takes steps until told otherwise.
struct Pause {};
struct TakeSteps { std::int64_t count = 1; };    ///< And pauses then.
/// The expression that snapshots show; empty: what pictures of the script show.
struct Show { std::string expression; };
// clang-format on

using SessionCommand =
    std::variant<MakeChange, GoToStage, Undo, Redo, GoOn, Pause, TakeSteps, Show>;

/// How far a stage has come.
struct StageProgress {
    std::string name;
    std::int64_t steps = 0;
    std::int64_t iterations = 0;  ///< The most steps that it takes.
    double t = 0;
    double duration = 0;  ///< 0 if the stage ends by its iterations.
    bool has_begun = false;
    bool has_ended = false;
};

/// A moment of a session, which its reader may keep as long as it likes.
struct Snapshot {
    std::uint64_t number = 0;  ///< Snapshots count from 1.
    std::uint64_t script = 0;  ///< Differs if and only if the script does.
    bool is_going_on = false;  ///< Are steps taken?
    RunPlace place;
    std::vector<StageProgress> stages;
    double steps_per_second = 0;  ///< Recent; 0 while unknown.
    bool can_undo = false, can_redo = false;
    std::string failure;               ///< Why the run stopped by itself; empty if it has not.
    std::vector<std::string> remarks;  ///< On stages that have ended, and warnings, newest last.
    /// What is shown, in binary32: one field, or red, green and blue; a slice of a volume. Outside
    /// of a mask it is NaN. The cells of a model are in their rows (ModelCells::order).
    std::vector<Field> fields;
    std::shared_ptr<const ModelCells> model;  ///< Null on grids.
};

/// Runs a LiveRun. Every function may be called from any thread, and none waits for steps.
class Session {
public:
    /// Starts paused. `options.control` is not used; `control` is for making the cells of a model.
    static Accepted<std::unique_ptr<Session>> begin(Script script, const SimulationOptions& options,
                                                    RunControl& control);
    /// Stops at the next complete step.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Queues a command. `done` is called in the session's thread with its result; it may be empty.
    void post(SessionCommand command, std::function<void(const Accepted<void>&)> done = {});

    /// Calls a function in the session's thread between two steps: to read values, to save, to get
    /// the log. It must not change the run.
    void ask(std::function<void(LiveRun&)> question);

    /// Interrupts what takes long, such as values that are grown again, and pauses.
    void cancel();

    /// The newest snapshot. There is always one. A session makes snapshots only as fast as they are
    /// asked for, at most some 60 a second and never for more than a small part of its time.
    std::shared_ptr<const Snapshot> newest();
    /// Waits for one with a larger number; null if there is none within the time.
    std::shared_ptr<const Snapshot> newer_than(std::uint64_t number,
                                               std::chrono::milliseconds patience);

private:
    struct Implementation;
    explicit Session(std::unique_ptr<LiveRun> run);
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
