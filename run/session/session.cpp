// The thread of a session: it obeys what is queued, takes some steps, and shows them.
#include "run/session/session.h"

#include "run/stage/stage_time.h"

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace cascade {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Steps are taken for about this long before the queue is looked at.
constexpr double turn_seconds = 0.015;
/// Fewer steps than this leave too little for several steps a pass through memory, so a turn takes
/// at least these where that is not longer than
constexpr std::int64_t least_steps = 32;
constexpr double longest_turn_seconds = 0.2;
/// Steps in which nothing happens take no time.
constexpr double most_steps_of_turn = 1e9;
/// Snapshots are at least this far apart, and take at most this part of the time.
constexpr double snapshot_seconds = 1.0 / 60;
constexpr double part_of_snapshots = 0.02;
constexpr std::size_t most_remarks = 20;

double seconds_since(Clock::time_point moment) { return Seconds(Clock::now() - moment).count(); }

}  // namespace

struct Session::Implementation {
    struct Task {
        std::variant<SessionCommand, std::function<void(LiveRun&)>> what;
        std::function<void(const Accepted<void>&)> done;
    };

    explicit Implementation(std::unique_ptr<LiveRun> live) : run(std::move(live)) {
        control.checks_later = true;
        publish();
        thread = std::thread([this] { work(); });
    }

    // The session's thread alone uses these.
    std::unique_ptr<LiveRun> run;
    RunControl control;
    bool is_going_on = false;
    std::optional<std::int64_t> steps_left;  ///< Of TakeSteps.
    std::string failure;
    std::vector<std::string> remarks;
    double steps_per_second = 0;
    std::uint64_t script_number = 1;
    std::string shown;  ///< The expression that is asked for.
    std::optional<Painter> painter;
    const Script* painted_script = nullptr;
    Clock::time_point shown_at;
    double snapshot_cost = 0;
    bool has_changed = false;  ///< Since the last snapshot.

    // Shared with other threads.
    std::mutex mutex;
    std::condition_variable has_task, has_snapshot;
    std::deque<Task> tasks;
    std::shared_ptr<const Snapshot> newest;
    bool is_wanted = false;  ///< Has the newest snapshot been read?
    bool is_ending = false;
    std::thread thread;

    void work();
    void obey(Task task);
    Accepted<void> carry_out(const SessionCommand& command);
    void take_steps();
    std::int64_t steps_of_turn() const;
    void remark(const std::string& words);
    bool is_due();
    void publish();
    Accepted<Painter> make_painter(const std::string& expression);
    Canvas canvas();
};

void Session::Implementation::work() {
    std::unique_lock lock(mutex);
    while (true) {
        const auto is_needed = [&] { return is_ending || !tasks.empty() || is_going_on; };
        if (!is_needed() && has_changed) {
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
            // A cancellation has ended what was being done before.
            control.cancel = false;
            lock.unlock();
            obey(std::move(task));
            has_changed = true;
        } else {
            lock.unlock();
            take_steps();
        }
        if (has_changed && is_due()) publish();
        lock.lock();
    }
}

void Session::Implementation::obey(Task task) {
    if (auto* question = std::get_if<std::function<void(LiveRun&)>>(&task.what)) {
        (*question)(*run);
        return;
    }
    const Script* const script = &run->script();
    // Not while steps are taken: a stage that looks for what to warn of keeps nothing between
    // turns.
    control.warn = [this](const std::string& words) { remark(words); };
    const Accepted<void> result = carry_out(std::get<SessionCommand>(task.what));
    control.warn = {};
    if (&run->script() != script) ++script_number;
    if (result) failure.clear();
    if (task.done) task.done(result);
}

Accepted<void> Session::Implementation::carry_out(const SessionCommand& command) {
    if (const auto* make = std::get_if<MakeChange>(&command)) {
        return run->apply(make->change, control, make->joins_last);
    }
    if (const auto* go = std::get_if<GoToStage>(&command)) return run->go_to(go->stage, control);
    if (std::holds_alternative<Undo>(command)) {
        // What was undone should be looked at before it changes again.
        is_going_on = false;
        return run->undo(control);
    }
    if (std::holds_alternative<Redo>(command)) {
        is_going_on = false;
        return run->redo(control);
    }
    if (const auto* show = std::get_if<Show>(&command)) {
        auto made = make_painter(show->expression);
        if (!made) return tl::unexpected(std::move(made.error()));
        shown = show->expression;
        painter = std::move(*made);
        painted_script = &run->script();
        return {};
    }
    const auto* steps = std::get_if<TakeSteps>(&command);
    is_going_on = !std::holds_alternative<Pause>(command) && !run->is_over();
    steps_left.reset();
    if (steps != nullptr) steps_left = std::max<std::int64_t>(steps->count, 0);
    return {};
}

std::int64_t Session::Implementation::steps_of_turn() const {
    const double usual = std::min(turn_seconds * steps_per_second, most_steps_of_turn);
    const double longest = longest_turn_seconds * steps_per_second;
    const double least = std::min(static_cast<double>(least_steps), longest);
    const auto steps = static_cast<std::int64_t>(std::max({usual, least, 1.0}));
    return steps_left ? std::min(steps, *steps_left) : steps;
}

void Session::Implementation::take_steps() {
    const Clock::time_point begun = Clock::now();
    const RunPlace before = run->place();
    Watching watching;
    watching.stage_ended = [this](std::uint32_t stage) {
        if (const auto words = run->simulation().remark_on(stage); !words.empty()) remark(words);
    };
    const std::int64_t asked = steps_of_turn();
    const auto end = run->advance(asked, control, watching);
    const RunPlace after = run->place();
    const std::int64_t taken = after.stage == before.stage ? after.steps - before.steps : asked;
    if (steps_left) *steps_left -= taken;
    const double seconds = std::max(seconds_since(begun), 1e-6);
    const double rate = static_cast<double>(taken) / seconds;
    steps_per_second = steps_per_second == 0 || after.stage != before.stage
                           ? rate
                           : 0.7 * steps_per_second + 0.3 * rate;
    has_changed = true;
    if (!end) {
        failure = end.error().message;
        if (!end.error().hint.empty()) failure += " (" + end.error().hint + ")";
    }
    is_going_on = end && *end == StageEnd::stopped && steps_left != 0;
}

void Session::Implementation::remark(const std::string& words) {
    if (remarks.size() == most_remarks) remarks.erase(remarks.begin());
    remarks.push_back(words);
}

bool Session::Implementation::is_due() {
    const double patience = std::max(snapshot_seconds, snapshot_cost / part_of_snapshots);
    if (seconds_since(shown_at) < patience && is_going_on) return false;
    const std::lock_guard lock(mutex);
    return is_wanted || !is_going_on;
}

Accepted<Painter> Session::Implementation::make_painter(const std::string& expression) {
    Script& script = run->script();
    PictureRequest request;
    request.show = expression;
    // The warnings of the script stay as they are.
    Diagnostics warnings = std::exchange(script.diagnostics, {});
    auto made = Painter::create(script, request);
    Diagnostics errors = std::exchange(script.diagnostics, std::move(warnings));
    if (made) return std::move(*made);
    Refusal refused;
    if (!errors.has_errors()) refused.failure = made.error();
    refused.diagnostics = std::move(errors);
    refused.sources = script.sources;
    return tl::unexpected(std::move(refused));
}

Canvas Session::Implementation::canvas() {
    if (painted_script != &run->script()) {
        auto made = make_painter(shown);
        // The expression may have lost its meaning with the old script.
        if (!made) made = make_painter("");
        painter = std::move(*made);
        painted_script = &run->script();
    }
    return painter->canvas(run->simulation());
}

void Session::Implementation::publish() {
    const Clock::time_point begun = Clock::now();
    auto made = std::make_shared<Snapshot>();
    made->number = newest ? newest->number + 1 : 1;
    made->script = script_number;
    made->is_going_on = is_going_on;
    made->place = run->place();
    const Program& program = *run->script().program;
    for (std::uint32_t k = 0; k < run->script().stage_count(); ++k) {
        const Stage& stage = program.stages[k];
        const StageState& state = run->simulation().state(k);
        StageProgress progress{stage.name, state.steps,   stage.iterations, state.t,
                               0,          state.started, state.done};
        if (state.started && stage.time.has_duration()) {
            progress.duration = duration_of(stage, program.system_of(k), state);
        }
        made->stages.push_back(std::move(progress));
    }
    made->steps_per_second = steps_per_second;
    made->can_undo = run->can_undo();
    made->can_redo = run->can_redo();
    made->failure = failure;
    made->remarks = remarks;
    made->fields = std::move(canvas().fields);
    made->model = run->simulation().model();
    has_changed = false;
    shown_at = Clock::now();
    snapshot_cost = seconds_since(begun);
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
    return std::unique_ptr<Session>(new Session(std::move(*run)));
}

Session::~Session() {
    {
        const std::lock_guard lock(self_->mutex);
        self_->is_ending = true;
        self_->control.cancel = true;
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
        self_->control.cancel = true;
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
