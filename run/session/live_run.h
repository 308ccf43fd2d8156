// A cascade that runs and changes while it runs: the class behind the prompt, the page and the
// public library.
#pragma once

#include "core/run_control.h"
#include "run/script/script.h"
#include "run/session/change.h"
#include "run/session/kept_state.h"
#include "run/session/refusal.h"
#include "run/session/session_log.h"
#include "run/simulation/simulation.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// What a caller wants to know while steps are taken. Functions may be empty.
struct Watching {
    std::function<void()> observe;  ///< At multiples of `every`, as Simulation::advance_stage().
    std::int64_t every = 0;
    std::function<void(std::uint32_t stage)> stage_ended;
    /// Begin the next stage if the last step of a call has ended one.
    bool begins_next = false;
};

/// Owns a script and its simulation. Logs every change with its step, so that the log, played
/// again, gives the same bits. Changes can be undone. Not thread-safe, but a RunControl may cancel
/// long work from any thread.
class LiveRun {
public:
    /// Starts the first stage of a checked script. Refused if there is none.
    static Accepted<std::unique_ptr<LiveRun>> begin(Script script, const SimulationOptions& options,
                                                    RunControl& control);
    /// Continues from values that `restore` gives a simulation of the script, such as a saved run.
    static Accepted<std::unique_ptr<LiveRun>> resume(
        Script script, const SimulationOptions& options, RunControl& control,
        const std::function<Result<void>(const Script&, Simulation&)>& restore);
    /// Plays a session again up to its end. Searches `folder` for the files of its script.
    static Accepted<std::unique_ptr<LiveRun>> play(const SessionLog& log,
                                                   const std::filesystem::path& folder,
                                                   const SimulationOptions& options,
                                                   RunControl& control);

    const Script& script() const { return *script_; }
    /// For painters, which add their expressions to the sources of the script.
    Script& script() { return *script_; }
    const Simulation& simulation() const { return *simulation_; }
    RunPlace place() const { return {stage_, state().steps}; }
    /// Whether every stage has ended.
    bool is_over() const;
    /// Whether it began with the values of a saved run. Then its log alone does not grow it again.
    bool is_resumed() const { return is_resumed_; }
    /// All values, from which go_on() continues.
    KeptState values() const { return keep(*simulation_, painted_); }

    /// Takes up to `count` steps, from stage to stage. `stopped`: all of them were taken.
    /// `finished`: the last stage has ended. Fails if values are not finite, and returns to the
    /// last step at which they were.
    Result<StageEnd> advance(std::int64_t count, RunControl& control,
                             const Watching& watching = {});

    /// Checks that all values of the present step are finite. Otherwise fails as advance() does.
    /// Matters after calls with RunControl::checks_later.
    Result<void> check(RunControl& control);

    /// Makes a change at the present step. A refused change has no effect. With `joins_last`,
    /// undo() reverts it together with the change before, as the parts of one stroke or of one move
    /// of a slider. A change of the domain's cells restarts the run.
    Accepted<void> apply(const Change& change, RunControl& control, bool joins_last = false);

    /// The checked expression of a number over the state of the current stage. Null, with errors,
    /// if it is wrong. `name` represents its text in messages.
    std::optional<Formula> number(const std::string& name, const std::string& expression,
                                  Diagnostics& errors);

    /// Goes to the start of a stage. Going back leaves texts and numbers unchanged and reverts
    /// strokes made since. Going on ends the stages before it in their present state.
    Accepted<void> go_to(std::uint32_t stage, RunControl& control);

    /// Goes back to the moment before the last change, or forward again. Refused if there is none.
    /// Values from many changes ago are grown again.
    Accepted<void> undo(RunControl& control);
    Accepted<void> redo(RunControl& control);
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }

    /// All changes up to the present moment.
    SessionLog log() const;

    /// Called after every change, and with `is_step` after every advance(): with the log, whose end
    /// is outdated, and the present moment.
    using Listener = std::function<void(const SessionLog& log, RunPlace now, bool is_step)>;
    void tell(Listener listener) { listener_ = std::move(listener); }

    /// The most bytes of values kept for undo(), and of texts with logs. Older values are grown
    /// again. Moments with older texts are forgotten.
    void set_undo_memory(std::size_t values, std::size_t texts = most_texts) {
        undo_memory_ = values;
        undo_texts_ = texts;
    }

    /// The most bytes of texts in the log, and usually in the moments kept for undo(). A change of
    /// the text that needs more is refused.
    static constexpr std::size_t most_texts = std::size_t{256} << 20;

private:
    /// A moment to which undo() or redo() leads.
    struct Moment {
        SessionLog log;
        std::string text;
        Overrides overrides;
        std::optional<KeptState> values;  ///< None: they are grown again.
    };

    LiveRun() = default;
    static Accepted<std::unique_ptr<LiveRun>> made(const Script& script,
                                                   const SimulationOptions& options);
    const StageState& state() const { return simulation_->state(stage_); }
    Accepted<std::unique_ptr<Simulation>> simulate(Script& script, RunControl& control) const;
    Accepted<void> adopt(Script script, const KeptState& values, Continuation how,
                         RunControl& control, std::size_t stages = SIZE_MAX);
    Accepted<void> make(const Change& change, const KeptState& values, RunControl& control);
    Accepted<void> make(const SetText& change, const KeptState& values, RunControl& control);
    Accepted<void> make(const SetNumber& change, const KeptState& values, RunControl& control);
    Accepted<void> make(const Paint& change);
    Accepted<void> make(const NextStage& change, RunControl& control);
    Result<StageEnd> take_steps(std::int64_t count, RunControl& control, const Watching& watching);
    void tell_of(bool is_step) const;
    Accepted<void> start_stage(std::uint32_t stage, const std::atomic<bool>& cancel);
    Accepted<void> run_to(RunPlace place, RunControl& control);
    Accepted<void> return_to(Moment& moment, RunControl& control);
    Accepted<void> step_through(std::vector<Moment>& from, std::vector<Moment>& to,
                                RunControl& control);
    Moment present() const;
    void remember(Moment moment);
    void forget_old_values();
    void add_to_log(const Change& change, RunPlace at);

    SimulationOptions options_;  ///< Including the stepper of all simulations.
    std::unique_ptr<Script> script_;
    std::unique_ptr<Simulation> simulation_;  ///< Refers to *script_.
    std::uint32_t stage_ = 0;
    bool is_resumed_ = false;
    std::vector<PaintedNames> painted_;  ///< By stage.
    SessionLog log_;                     ///< Its end may be outdated.
    Listener listener_;
    std::vector<Moment> past_, future_;
    std::size_t undo_memory_ = std::size_t{256} << 20, undo_texts_ = most_texts;
};

}  // namespace cascade
