// A live run in its own thread: commands in, the newest snapshot out.
#pragma once

#include "run/session/turns.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace cascade {

/// Runs Turns. Every function may be called from any thread, and none waits for steps.
class Session {
public:
    /// Starts paused. Ignores `options.control`. `control` is for making the cells of a model.
    static Accepted<std::unique_ptr<Session>> begin(Script script, const SimulationOptions& options,
                                                    RunControl& control);
    /// Takes a run that has begun, paused.
    explicit Session(std::unique_ptr<LiveRun> run);
    /// Stops at the next complete step.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Queues a command. `done` is called in the session's thread with its result. It may be empty.
    void post(SessionCommand command, std::function<void(const Accepted<void>&)> done = {});

    /// Calls a function in the session's thread between two steps: to read values, to save, to get
    /// the log. It must not change the run.
    void ask(std::function<void(LiveRun&)> question);

    /// Gets, in the session's thread, what a command that takes long is doing, such as spreading
    /// the cells of a model, and a Progress of nothing after it.
    void watch(std::function<void(const Progress&)> watcher);

    /// Interrupts long work, such as values that are grown again, and pauses.
    void cancel();

    /// The newest snapshot. There is always one. A session makes snapshots only as fast as they are
    /// requested, at most about 60 a second and never for more than a small part of its time.
    std::shared_ptr<const Snapshot> newest();
    /// Waits for one with a larger number. Null if there is none within the time.
    std::shared_ptr<const Snapshot> newer_than(std::uint64_t number,
                                               std::chrono::milliseconds patience);

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
