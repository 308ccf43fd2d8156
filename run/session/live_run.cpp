// Every change makes a new simulation, which continues from stored values with the changed script.
// Each new simulation takes over kernels and the cells of a model from the previous one, so that
// only the differences are computed.
#include "run/session/live_run.h"

#include "lang/check/check.h"
#include "lang/syntax/parse.h"
#include "run/session/changed_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {
namespace {

/// Returns the bytes of the parts of a change that may be large: a text, or values of all cells.
std::size_t bytes_of(const Change& change) {
    if (const auto* text = std::get_if<SetText>(&change)) return text->text.size();
    if (const auto* set = std::get_if<SetValues>(&change)) {
        return set->values.size() * sizeof set->values[0];
    }
    return 0;
}

std::size_t bytes_of(const SessionLog& log) {
    std::size_t bytes = log.text.size();
    for (const auto& logged : log.changes) bytes += bytes_of(logged->change);
    return bytes;
}

}  // namespace

Accepted<std::unique_ptr<Simulation>> LiveRun::simulate(Script& script, RunControl& control) const {
    SimulationOptions options = options_;
    options.control = &control;
    const bool is_known = simulation_ && have_same_cells(*script_->program, *script.program);
    if (is_known) options.known_model = simulation_->domain().shared_model();
    if (simulation_) options.known_sizes = simulation_->domain().known_sizes;
    auto made = Simulation::create(script, options);
    if (!made) return refuse(std::move(script), made.error());
    return std::move(*made);
}

/// Continues with another script from the values of at most `stages` stages. If there are no
/// values, starts at the beginning.
Accepted<void> LiveRun::adopt(Script changed, const KeptState& values, Continuation how,
                              RunControl& control, std::size_t stages) {
    if (!changed.program) return refuse(std::move(changed));
    if (changed.program->stages.empty()) {
        return refuse("this script has no stage to run", example_of_stage(*changed.program));
    }
    auto script = std::make_unique<Script>(std::move(changed));
    auto simulation = simulate(*script, control);
    if (!simulation) return tl::unexpected(std::move(simulation.error()));
    auto painted = go_on(**simulation, simulation_.get(), values, how, control.cancel, stages);
    if (painted && painted->empty()) {
        if (auto started = (*simulation)->start_stage(0); !started) {
            painted = tl::unexpected(started.error());
        }
    }
    if (!painted) return refuse(std::move(*script), painted.error());
    stage_ = painted->empty() ? 0 : static_cast<std::uint32_t>(painted->size() - 1);
    painted_ = std::move(*painted);
    painted_.resize(script->program->stages.size());
    // The old simulation refers to the old script, so it must be destroyed before the script.
    simulation_ = std::move(*simulation);
    script_ = std::move(script);
    return {};
}

/// Makes a run that has no script yet.
Accepted<std::unique_ptr<LiveRun>> LiveRun::made(const Script& script,
                                                 const SimulationOptions& options) {
    std::unique_ptr<LiveRun> run(new LiveRun);
    run->options_ = options;
    if (!run->options_.stepper) {
        auto stepper = make_stepper(options);
        if (!stepper) return refuse(stepper.error());
        run->options_.stepper = std::move(*stepper);
    }
    run->log_.name = script.name;
    run->log_.text = script.text;
    run->log_.overrides = script.overrides;
    return run;
}

Accepted<std::unique_ptr<LiveRun>> LiveRun::begin(Script script, const SimulationOptions& options,
                                                  RunControl& control) {
    auto run = made(script, options);
    if (!run) return run;
    auto started = (*run)->adopt(std::move(script), {}, Continuation::changed, control);
    if (!started) return tl::unexpected(std::move(started.error()));
    // From now on, the present simulation provides the cells of the model as long as the model
    // stays the same.
    (*run)->options_.known_model = nullptr;
    return run;
}

Accepted<std::unique_ptr<LiveRun>> LiveRun::resume(
    Script script, const SimulationOptions& options, RunControl& control,
    const std::function<Result<void>(const Script&, Simulation&)>& restore) {
    auto run = begin(std::move(script), options, control);
    if (!run) return run;
    LiveRun& live = **run;
    live.is_resumed_ = true;
    if (auto restored = restore(*live.script_, *live.simulation_); !restored) {
        return refuse(restored.error());
    }
    for (std::uint32_t k = 0; k < live.painted_.size(); ++k) {
        if (live.simulation_->state(k).started) live.stage_ = k;
    }
    return run;
}

Accepted<std::unique_ptr<LiveRun>> LiveRun::play(const SessionLog& log,
                                                 const std::filesystem::path& folder,
                                                 const SimulationOptions& options,
                                                 RunControl& control) {
    auto run = begin(load_script(log.name, log.text, folder, log.overrides), options, control);
    if (!run) return run;
    Accepted<void> done;
    std::size_t played = 0, told = 0;
    for (const auto& logged : log.changes) {
        if (control.cancel) return refuse("stopped");
        const std::size_t percent = 100 * played / log.changes.size();
        if (control.report && percent > told) {
            told = percent;
            Progress progress;
            progress.doing = fmt::format("playing the session: {} % of its changes", percent);
            progress.step = static_cast<std::int64_t>(played);
            progress.steps = static_cast<std::int64_t>(log.changes.size());
            control.report(progress);
        }
        ++played;
        done = (*run)->run_to(logged->at, control);
        const bool needs_values = is_of_script(logged->change);
        if (done) {
            done = (*run)->make(logged->change, needs_values ? (*run)->values() : KeptState(),
                                control);
        }
        if (!done) return tl::unexpected(std::move(done.error()));
    }
    done = (*run)->run_to(log.end, control);
    if (!done) return tl::unexpected(std::move(done.error()));
    (*run)->log_ = log;
    return run;
}

bool LiveRun::is_over() const { return state().done && stage_ + 1 == script_->stage_count(); }

Accepted<void> LiveRun::start_stage(std::uint32_t stage, const std::atomic<bool>& cancel) {
    if (auto started = simulation_->start_stage(stage, cancel); !started) {
        return refuse(started.error());
    }
    painted_[stage].clear();
    stage_ = stage;
    return {};
}

void LiveRun::tell_of(bool is_step) const {
    if (listener_) listener_(log_, place(), is_step);
}

Result<StageEnd> LiveRun::advance(std::int64_t count, RunControl& control,
                                  const Watching& watching) {
    auto end = take_steps(count, control, watching);
    tell_of(true);
    return end;
}

Result<StageEnd> LiveRun::take_steps(std::int64_t count, RunControl& control,
                                     const Watching& watching) {
    while (true) {
        if (!state().done) {
            if (count <= 0) return StageEnd::stopped;
            const std::int64_t before = state().steps;
            const std::int64_t iterations = script_->program->stages[stage_].iterations;
            const std::int64_t last = before + std::min(count, iterations - before);
            const auto end =
                simulation_->advance_stage(stage_, last, control, watching.observe, watching.every);
            if (!end || *end != StageEnd::finished) return end;
            count -= state().steps - before;
            if (watching.stage_ended) watching.stage_ended(stage_);
        }
        if (is_over()) return StageEnd::finished;
        if (count <= 0 && !watching.begins_next) return StageEnd::stopped;
        if (auto started = start_stage(stage_ + 1, control.cancel); !started) {
            if (control.cancel) return StageEnd::cancelled;
            return tl::unexpected(*started.error().failure);
        }
    }
}

Result<void> LiveRun::check(RunControl& control) {
    if (state().steps == 0 || state().done) return {};
    const auto end = simulation_->advance_stage(stage_, state().steps, control, {});
    return end ? Result<void>() : tl::unexpected(end.error());
}

Accepted<void> LiveRun::run_to(RunPlace place, RunControl& control) {
    const auto does_not_fit = [&] {
        return refuse(fmt::format("the session goes on at step {} of stage {}, which this run does "
                                  "not reach",
                                  place.steps, place.stage + 1),
                      "its script, or a file that it reads, has changed");
    };
    while (true) {
        const bool is_there = stage_ == place.stage;
        const std::int64_t iterations = script_->program->stages[stage_].iterations;
        const std::int64_t most = state().done ? state().steps : iterations;
        if (place < this->place() || (is_there && most < place.steps)) return does_not_fit();
        if (is_there && state().steps == place.steps) return {};
        if (!is_there && state().done) {
            if (stage_ + 1 >= script_->stage_count()) return does_not_fit();
            if (auto started = start_stage(stage_ + 1, control.cancel); !started) return started;
            continue;
        }
        const std::int64_t last = is_there ? place.steps : iterations;
        const auto end = simulation_->advance_stage(stage_, last, control, {});
        if (!end) return refuse(end.error());
        if (*end == StageEnd::cancelled) return refuse("stopped");
        if (!is_there && *end != StageEnd::finished) return does_not_fit();
    }
}

Accepted<void> LiveRun::make(const Change& change, const KeptState& values, RunControl& control) {
    if (const auto* text = std::get_if<SetText>(&change)) return make(*text, values, control);
    if (const auto* number = std::get_if<SetNumber>(&change)) return make(*number, values, control);
    if (const auto* paint = std::get_if<Paint>(&change)) return make(*paint);
    if (const auto* set = std::get_if<SetValues>(&change)) return make(*set);
    return make(std::get<NextStage>(change), control);
}

Accepted<void> LiveRun::make(const SetText& change, const KeptState& values, RunControl& control) {
    Script script = with_text(*script_, change.text);
    if (!script.program) return refuse(std::move(script));
    const bool goes_on = have_same_cells(*script_->program, *script.program);
    return adopt(std::move(script), goes_on ? values : KeptState(), Continuation::changed, control);
}

Accepted<void> LiveRun::make(const SetNumber& change, const KeptState& values,
                             RunControl& control) {
    return adopt(with_number(*script_, change), values, Continuation::changed, control);
}

std::optional<Formula> LiveRun::number(const std::string& name, const std::string& expression,
                                       Diagnostics& errors) {
    const SourceId source = script_->sources.add(name, expression);
    const auto parsed = parse_expression(source, script_->sources, script_->tree, errors);
    if (!parsed) return std::nullopt;
    auto formula = check_view(script_->tree, *parsed, stage_, stage_, *script_->program,
                              script_->sources, errors);
    if (formula && formula->nodes.back().type != ValueType::number) {
        errors.error(formula->nodes.back().span, "this is not a number");
    }
    return errors.has_errors() ? std::nullopt : formula;
}

Accepted<void> LiveRun::make(const NextStage&, RunControl& control) {
    if (stage_ + 1 >= script_->stage_count()) {
        return refuse(
            fmt::format("stage '{}' is the last one", script_->program->stages[stage_].name));
    }
    const std::uint32_t ended = stage_;
    if (auto started = start_stage(ended + 1, control.cancel); !started) return started;
    simulation_->change_stage(ended, [](StageState& state) { state.done = true; });
    return {};
}

void LiveRun::add_to_log(const Change& change, RunPlace at) {
    // A slider sets the same number many times. Of the values that it sets at the same step, only
    // the last one counts and is logged. Every value is logged in two cases: after strokes, because
    // a uniform number removes painted values for good, and in a stage of crawling cells, because a
    // number that changes and changes back replaces the cells' own values.
    const bool has_strokes =
        std::any_of(log_.changes.begin(), log_.changes.end(),
                    [](const auto& logged) { return is_stroke(logged->change); });
    const auto* number = std::get_if<SetNumber>(&change);
    if (number != nullptr && !has_strokes && state().tissue() == nullptr && !log_.changes.empty()) {
        const LoggedChange& last = *log_.changes.back();
        const auto* before = std::get_if<SetNumber>(&last.change);
        if (last.at == at && before != nullptr && before->name == number->name) {
            log_.changes.pop_back();
        }
    }
    log_.changes.push_back(std::make_shared<const LoggedChange>(LoggedChange{at, change}));
}

Accepted<void> LiveRun::apply(const Change& change, RunControl& control, bool joins_last) {
    if (log_.changes.size() >= most_logged_changes) {
        return refuse("the log of this session cannot hold more changes",
                      "save the script or the values, and begin a session with them");
    }
    const std::size_t bytes = bytes_of(change);
    const bool is_too_large = bytes > 0 && bytes_of(log_) + bytes > most_texts;
    if (is_too_large && std::holds_alternative<SetText>(change)) {
        return refuse("the log of this session cannot hold more texts of scripts",
                      "save the script, and begin a session with it");
    }
    const bool is_remembered = !joins_last || past_.empty();
    std::optional<Moment> before;
    // Parts of a stroke come many times a second, so values are copied only at its beginning.
    if (is_remembered || is_of_script(change)) before = present();
    const RunPlace at = place();
    if (std::holds_alternative<NextStage>(change) && control.checks_later && !is_over()) {
        // Makes the checks that are due at the end of the stage.
        control.checks_later = false;
        const auto good = check(control);
        control.checks_later = true;
        if (!good) return refuse(good.error());
    }
    if (auto made = make(change, before ? *before->values : KeptState(), control); !made) {
        return made;
    }
    if (place() == RunPlace() && at != RunPlace()) {
        // The run has begun anew, so the changes up to here are no longer needed.
        log_ = {script_->name, script_->text, script_->overrides, {}, {}};
    } else if (is_too_large) {
        log_ = {script_->name, script_->text, script_->overrides, {}, {}};
        is_resumed_ = true;
    } else {
        add_to_log(change, at);
    }
    if (is_remembered) remember(std::move(*before));
    future_.clear();
    tell_of(false);
    return {};
}

SessionLog LiveRun::log() const {
    SessionLog log = log_;
    log.end = place();
    return log;
}

}  // namespace cascade
