// Implements the thread of a session. It executes queued commands, takes turns, and stores the
// newest snapshot.
#include "run/session/session.h"

#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>
#include <utility>

namespace cascade {

struct Session::Implementation {
    struct Task {
        std::variant<SessionCommand, std::function<void(LiveRun&)>> what;
        std::function<void(const Accepted<void>&)> done;
    };

    explicit Implementation(std::unique_ptr<LiveRun> run) : turns(std::move(run)) {
        publish();
        thread = std::thread([this] { work(); });
    }

    Turns turns;  ///< Only the session's thread uses the turns, but any thread may cancel them.

    // The members below are shared with other threads.
    std::mutex mutex;
    std::condition_variable has_task, has_snapshot;
    std::deque<Task> tasks;
    std::shared_ptr<const Snapshot> newest;
    /// Whether a reader has taken the newest snapshot and so may want another.
    bool is_wanted = false;
    bool is_ending = false;
    std::function<void(const Progress&)> watcher;
    std::thread thread;

    void work();
    void obey(Task task);
    bool is_due();
    void publish();
};

void Session::Implementation::work() {
    std::unique_lock lock(mutex);
    while (true) {
        const auto is_needed = [&] { return is_ending || !tasks.empty() || turns.is_going_on(); };
        if (!is_needed() && turns.has_changed()) {
            lock.unlock();
            publish();
            lock.lock();
            continue;
        }
        has_task.wait(lock, is_needed);
        if (is_ending) return;
        if (!tasks.empty()) {
            Task task = std::move(tasks.front());
            tasks.pop_front();
            // A cancellation is meant only for work that began before it.
            turns.control().cancel = false;
            lock.unlock();
            obey(std::move(task));
        } else {
            lock.unlock();
            turns.take();
        }
        if (turns.has_changed() && is_due()) publish();
        lock.lock();
    }
}

void Session::Implementation::obey(Task task) {
    if (auto* question = std::get_if<std::function<void(LiveRun&)>>(&task.what)) {
        (*question)(turns.run());
        return;
    }
    const auto tell = [&] {
        const std::lock_guard lock(mutex);
        return watcher;
    }();
    bool has_told = false;
    // Reports are set up only for commands, because they would make steps slower.
    if (tell) {
        turns.control().report = [&](const Progress& progress) {
            if (progress.doing.empty()) return;
            has_told = true;
            tell(progress);
        };
    }
    const auto result = turns.obey(std::get<SessionCommand>(task.what));
    turns.control().report = {};
    if (has_told) tell({});
    if (task.done) task.done(result);
}

bool Session::Implementation::is_due() {
    if (!turns.is_snapshot_due()) return false;
    const std::lock_guard lock(mutex);
    return is_wanted || !turns.is_going_on();
}

void Session::Implementation::publish() {
    auto made = turns.snapshot();
    {
        const std::lock_guard lock(mutex);
        newest = std::move(made);
        is_wanted = false;
    }
    has_snapshot.notify_all();
}

Session::Session(std::unique_ptr<LiveRun> run)
    : self_(std::make_unique<Implementation>(std::move(run))) {}

Accepted<std::unique_ptr<Session>> Session::begin(Script script, const SimulationOptions& options,
                                                  RunControl& control) {
    auto run = LiveRun::begin(std::move(script), options, control);
    if (!run) return tl::unexpected(std::move(run.error()));
    return std::make_unique<Session>(std::move(*run));
}

void Session::watch(std::function<void(const Progress&)> watcher) {
    const std::lock_guard lock(self_->mutex);
    self_->watcher = std::move(watcher);
}

Session::~Session() {
    {
        const std::lock_guard lock(self_->mutex);
        self_->is_ending = true;
        self_->turns.control().cancel = true;
    }
    self_->has_task.notify_all();
    self_->thread.join();
}

void Session::post(SessionCommand command, std::function<void(const Accepted<void>&)> done) {
    {
        const std::lock_guard lock(self_->mutex);
        self_->tasks.push_back({std::move(command), std::move(done)});
    }
    self_->has_task.notify_all();
}

void Session::ask(std::function<void(LiveRun&)> question) {
    {
        const std::lock_guard lock(self_->mutex);
        self_->tasks.push_back({std::move(question), {}});
    }
    self_->has_task.notify_all();
}

void Session::cancel() {
    {
        const std::lock_guard lock(self_->mutex);
        self_->turns.control().cancel = true;
    }
    post(Pause{});
}

std::shared_ptr<const Snapshot> Session::newest() {
    const std::lock_guard lock(self_->mutex);
    self_->is_wanted = true;
    return self_->newest;
}

std::shared_ptr<const Snapshot> Session::newer_than(std::uint64_t number,
                                                    std::chrono::milliseconds patience) {
    std::unique_lock lock(self_->mutex);
    self_->is_wanted = true;
    const bool is_newer = self_->has_snapshot.wait_for(lock, patience, [&] {
        return self_->newest->number > number;
    });
    return is_newer ? self_->newest : nullptr;
}

}  // namespace cascade
