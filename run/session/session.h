// Runs a LiveRun in its own thread. Other threads post commands and read the newest snapshot.
#pragma once

#include "run/session/turns.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace cascade {

/// Runs Turns in a thread. Every function may be called from any thread. No function waits for
/// steps.
class Session {
public:
    /// Starts a paused session. Ignores `options.control`. `control` is used only while the cells
    /// of a model are made.
    static Accepted<std::unique_ptr<Session>> begin(Script script, const SimulationOptions& options,
                                                    RunControl& control);
    /// Takes over a run that has begun, and pauses it.
    explicit Session(std::unique_ptr<LiveRun> run);
    /// Stops the steps at the next complete step.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Queues a command. `done`, which may be empty, is called with the result in the session's
    /// thread.
    void post(SessionCommand command, std::function<void(const Accepted<void>&)> done = {});

    /// Calls a function in the session's thread between two steps, for example to read values, to
    /// save, or to get the log. The function must not change the run.
    void ask(std::function<void(LiveRun&)> question);

    /// Sets a function that is called in the session's thread during commands that take long, such
    /// as spreading the cells of a model. After each of these commands, it is called with an empty
    /// Progress.
    void watch(std::function<void(const Progress&)> watcher);

    /// Interrupts long work, such as computing values again, and pauses the session.
    void cancel();

    /// Returns the newest snapshot, of which there is always one. Snapshots are made only when they
    /// are requested, at most about 60 times a second. Making them takes at most a small fraction
    /// of the time.
    std::shared_ptr<const Snapshot> newest();
    /// Waits for a snapshot with a number above `number`. Returns null if there is none within the
    /// time.
    std::shared_ptr<const Snapshot> newer_than(std::uint64_t number,
                                               std::chrono::milliseconds patience);

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
