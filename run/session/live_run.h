// A cascade that can be changed while it runs. The prompt, the page and the public library
// are built on this class.
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

/// Functions to be called while steps are taken. They may be empty.
struct Watching {
    /// Called at multiples of `every` steps. See Simulation::advance_stage().
    std::function<void()> observe;
    std::int64_t every = 0;
    std::function<void(std::uint32_t stage)> stage_ended;
    /// Whether, if the last step of a call has ended a stage, the call also begins the next stage.
    bool begins_next = false;
};

/// Owns a script and its simulation. Logs every change with the step at which it was made.
/// Repeating the log gives the same result, bit for bit. Changes can be undone. Only one thread may
/// use this object at a time, but any thread may cancel long work through the RunControl.
class LiveRun {
public:
    /// Starts the first stage of a checked script. Refuses a script without stages.
    static Accepted<std::unique_ptr<LiveRun>> begin(Script script, const SimulationOptions& options,
                                                    RunControl& control);
    /// Starts a run from the values that `restore` sets in a simulation of the script. These may be
    /// the values of a saved run.
    static Accepted<std::unique_ptr<LiveRun>> resume(
        Script script, const SimulationOptions& options, RunControl& control,
        const std::function<Result<void>(const Script&, Simulation&)>& restore);
    /// Repeats a session from beginning to end. Files that its script names are looked for in
    /// `folder`.
    static Accepted<std::unique_ptr<LiveRun>> play(const SessionLog& log,
                                                   const std::filesystem::path& folder,
                                                   const SimulationOptions& options,
                                                   RunControl& control);

    const Script& script() const { return *script_; }
    /// The script of the run. Painters add their expressions to its sources.
    Script& script() { return *script_; }
    const Simulation& simulation() const { return *simulation_; }
    RunPlace place() const { return {stage_, state().steps}; }
    /// Whether all stages have ended.
    bool is_over() const;
    /// Whether the log alone cannot reproduce this run, because the run began with the values of a
    /// saved run, or because the log would have needed more than `most_texts` bytes for values.
    bool is_resumed() const { return is_resumed_; }
    /// Copies all values that go_on() needs to continue from this moment.
    KeptState values() const { return keep(*simulation_, painted_); }

    /// Takes up to `count` steps, also across the ends of stages. Returns `stopped` if all these
    /// steps were taken, and `finished` if the last stage has ended before. If values are not
    /// finite, fails and returns to the last step at which they were finite.
    Result<StageEnd> advance(std::int64_t count, RunControl& control,
                             const Watching& watching = {});

    /// Checks whether all values of the present step are finite. If not, fails in the same way as
    /// advance(). Must be called after calls of advance() with RunControl::checks_later.
    Result<void> check(RunControl& control);

    /// Makes a change at the present step. A refused change has no effect. If `joins_last` is true,
    /// this change and the previous one are parts of one stroke or of one movement of a slider, so
    /// undo() reverts both together. Changing the domain's cells restarts the run.
    Accepted<void> apply(const Change& change, RunControl& control, bool joins_last = false);

    /// Checks an expression whose value is a number, in the state of the current stage. If the
    /// expression is invalid, returns an empty optional and adds messages to `errors`. The messages
    /// call the expression `name`.
    std::optional<Formula> number(const std::string& name, const std::string& expression,
                                  Diagnostics& errors);

    /// Goes to the start of a stage. Going back undoes later strokes, but not changes of the text
    /// and of numbers. Going forward ends all earlier stages in their present state.
    Accepted<void> go_to(std::uint32_t stage, RunControl& control);

    /// undo() goes back to the moment before the last change, and redo() goes forward again. Both
    /// are refused if there is no such moment. If the values at that moment are no longer stored,
    /// they are computed again.
    Accepted<void> undo(RunControl& control);
    Accepted<void> redo(RunControl& control);
    bool can_undo() const { return !past_.empty(); }
    bool can_redo() const { return !future_.empty(); }

    /// Returns the script at the beginning and all changes up to the present moment.
    SessionLog log() const;

    /// Called after every change with `is_step` false, and after every advance() with `is_step`
    /// true. Receives the present moment and the log, whose member `end` is outdated.
    using Listener = std::function<void(const SessionLog& log, RunPlace now, bool is_step)>;
    void tell(Listener listener) { listener_ = std::move(listener); }

    /// Sets the largest number of bytes of the values that are stored for undo(), and of the texts
    /// and logs that are stored for undo(). If values need more, the oldest values are deleted and
    /// computed again when needed. If texts and logs need more, undo() can no longer return to the
    /// oldest moments.
    void set_undo_memory(std::size_t values, std::size_t texts = most_texts) {
        undo_memory_ = values;
        undo_texts_ = texts;
    }

    /// Limits the seconds for making the cells of the model that another text names. 0 means no
    /// limit.
    void limit_models(double seconds) { options_.model_seconds = seconds; }

    /// The largest number of bytes of the texts and values in the log and, by default, of the texts
    /// stored for undo(). A change of the text that needs more is refused. Values that need more
    /// are set, but from then on is_resumed() is true.
    static constexpr std::size_t most_texts = std::size_t{256} << 20;

private:
    /// A moment to which undo() or redo() returns.
    struct Moment {
        SessionLog log;
        std::string text;
        Overrides overrides;
        /// If empty, the values must be computed again from the log.
        std::optional<KeptState> values;
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
    Accepted<void> make(const SetValues& change);
    Accepted<ItemId> painted_item(const std::string& name, const char* paintable) const;
    Accepted<Field> painted_values(const Paint& change);
    Accepted<Field> painted_values(const SetValues& change);
    using StrokeValues = std::function<Accepted<Field>()>;
    Accepted<void> paint(const std::string& name, const StrokeValues& values);
    Accepted<void> paint_fields(const std::string& name, const StrokeValues& values);
    Accepted<void> paint_cells(const std::string& name, const StrokeValues& values);
    void give(const std::string& name, ItemId item, Field values);
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

    /// The options of all simulations, including the stepper that they share.
    SimulationOptions options_;
    std::unique_ptr<Script> script_;
    std::unique_ptr<Simulation> simulation_;  ///< Refers to *script_.
    std::uint32_t stage_ = 0;
    bool is_resumed_ = false;
    std::vector<PaintedNames> painted_;  ///< The names of the painted items of each stage.
    SessionLog log_;                     ///< The log. Its member `end` may be outdated.
    Listener listener_;
    std::vector<Moment> past_, future_;
    std::size_t undo_memory_ = std::size_t{256} << 20, undo_texts_ = most_texts;
};

}  // namespace cascade
