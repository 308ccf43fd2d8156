// Runs a LiveRun in its own thread. Other threads post commands and read the newest snapshot.
#pragma once

#include "run/session/turns.h"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

namespace cascade {

/// Runs Turns in a thread. Every function may be called from any thread. None waits for steps.
class Session {
public:
    /// Starts a paused session. Ignores `options.control`. `control` serves only to make
    /// the cells of a model.
    static Accepted<std::unique_ptr<Session>> begin(Script script, const SimulationOptions& options,
                                                    RunControl& control);
    /// Takes over a run that has begun, and pauses it.
    explicit Session(std::unique_ptr<LiveRun> run);
    /// Stops at the next complete step.
    ~Session();
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;

    /// Queues a command. `done`, which may be empty, is called with the result in the session's
    /// thread.
    void post(SessionCommand command, std::function<void(const Accepted<void>&)> done = {});

    /// Calls a function in the session's thread between two steps, for example to read values, to
    /// save, or to get the log. It must not change the run.
    void ask(std::function<void(LiveRun&)> question);

    /// Sets a function that is called in the session's thread during commands that take
    /// long, such as spreading the cells of a model. Each of these commands ends with a call
    /// with an empty Progress.
    void watch(std::function<void(const Progress&)> watcher);

    /// Interrupts long work, such as computing values again, and pauses.
    void cancel();

    /// The newest snapshot, of which there is always one. Snapshots are made only when they
    /// are requested, at most about 60 times a second and never for more than a small
    /// fraction of the time.
    std::shared_ptr<const Snapshot> newest();
    /// Waits for a snapshot with a larger number. Null if there is none within the time.
    std::shared_ptr<const Snapshot> newer_than(std::uint64_t number,
                                               std::chrono::milliseconds patience);

private:
    struct Implementation;
    std::unique_ptr<Implementation> self_;
};

}  // namespace cascade
