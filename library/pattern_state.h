// The internal state of a Pattern of the public library.
#pragma once

#include "cascade/cascade.h"
#include "core/failure_line.h"
#include "run/commands/film_request.h"
#include "run/pictures/frames.h"
#include "run/session/live_run.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace cascade {

struct RunRequest;

/// Converts a diagnostic, with its position in the sources, to a message of the public library.
Message message_of(const Diagnostic& diagnostic, const Sources& sources);
/// The first error as a message. Empty if there is no error.
Message first_of(const Diagnostics& diagnostics, const Sources& sources);

struct Pattern::Implementation {
    std::unique_ptr<LiveRun> run;  ///< Null if the script has errors.
    /// The program of a script that could not be run. May be null.
    std::shared_ptr<const Program> program;
    Diagnostics diagnostics;  ///< The errors and warnings of the script.
    Sources sources;          ///< The sources of the script, if there is no run.
    RunControl control;
    std::string error;
    Message problem;  ///< The last error, with its position.
    bool failed = false;
    std::uint64_t moment = 0;  ///< Increases with every step and change.
    /// The last moment at which all values were known to be finite.
    std::uint64_t checked_moment = 0;
    /// The formulas that values() has checked, by stage and text.
    std::map<std::string, Formula> formulas;

    std::shared_ptr<const ModelCells> model() const {
        return run ? run->simulation().domain().shared_model() : nullptr;
    }
    bool running() const { return run && !failed; }
    const Program* known_program() const {
        return run ? run->script().program.get() : program.get();
    }

    void fail(const Failure& failure) {
        failed = true;
        note(failure);
    }
    void note(const Failure& failure) {
        error = line_of(failure);
        problem = {true, "", 0, 0, failure.message, failure.hint};
    }
    void note(const Diagnostics& errors, const Sources& of) {
        error = render(errors, of, {});
        problem = first_of(errors, of);
    }
    void note(const Refusal& refused) {
        if (refused.failure) note(*refused.failure);
        else problem = first_of(refused.diagnostics, refused.sources);
        error = refused.messages(false);
    }
    void forget_error() {
        error.clear();
        problem = {};
    }

    /// Takes over the run, or records the reason why there is none.
    void begin(Accepted<std::unique_ptr<LiveRun>> begun) {
        if (begun) {
            run = std::move(*begun);
            return;
        }
        Refusal& refused = begun.error();
        if (refused.failure) fail(*refused.failure);
        else problem = first_of(refused.diagnostics, refused.sources);
        diagnostics = std::move(refused.diagnostics);
        sources = std::move(refused.sources);
    }

    /// Records why a change was refused. Returns true if the change was accepted.
    bool took(const Accepted<void>& done) {
        if (!done) {
            note(done.error());
            return false;
        }
        forget_error();
        formulas.clear();
        checked_moment = ++moment;
        return true;
    }
    bool change(const Change& made) { return running() && took(run->apply(made, control)); }

    /// Takes steps. See Pattern::step(). `watching` gives functions to call between steps.
    std::int64_t advance(std::int64_t count, const ProgressWatcher& watcher, Watching watching);

    // The parts of Pattern::write() and Pattern::film().
    bool write_by_runner(RunRequest request);
    bool write_volume_file(const std::filesystem::path& path);
    Result<void> record(FrameRecorder& frames, Painter& painter, std::int64_t every,
                        const ProgressWatcher& watcher);
    Result<void> write_film(const std::filesystem::path& path, FrameRecorder& frames,
                            Painter& painter, const FilmRequest& pace,
                            const ProgressWatcher& watcher);

    /// The checked expression. If it has errors, returns null and sets `error`.
    const Formula* formula(const std::string& text);
    /// The plane that holds the values of a formula. Null if no plane holds them and they must be
    /// computed.
    const Field* plane_of(const Formula& formula) const;
    /// Computes the values of a formula, row by row.
    Field computed(const Formula& formula) const;

    std::uint32_t stage() const { return run->place().stage; }
    const Stage& current() const { return run->script().program->stages[stage()]; }
    /// The number of steps of all stages so far.
    std::int64_t steps() const {
        std::int64_t steps = 0;
        for (std::uint32_t k = 0; k <= stage(); ++k) steps += run->simulation().state(k).steps;
        return steps;
    }

    /// Returns whether all values of the present step are finite. If not, records the same error as
    /// for a failed step.
    bool check() {
        if (checked_moment == moment) return !failed;
        control.cancel = control.checks_later = false;
        if (const auto good = run->check(control); !good) fail(good.error());
        checked_moment = moment;
        return !failed;
    }
};

}  // namespace cascade
