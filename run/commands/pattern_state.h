// What a Pattern of the public library holds.
#pragma once

#include "cascade/cascade.h"
#include "core/failure_line.h"
#include "run/session/live_run.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace cascade {

/// A diagnostic with its place.
Message message_of(const Diagnostic& diagnostic, const Sources& sources);
/// The first error; empty if there is none.
Message first_of(const Diagnostics& diagnostics, const Sources& sources);

struct Pattern::Implementation {
    std::unique_ptr<LiveRun> run;            ///< Null if the script is wrong.
    std::shared_ptr<const Program> program;  ///< Of a script that could not be run; may be null.
    Diagnostics diagnostics;                 ///< Of the script,
    Sources sources;                         ///< and its sources, where there is no run.
    RunControl control;
    std::string error;
    Message problem;  ///< The error with its place.
    bool failed = false;
    std::uint64_t moment = 0;                 ///< Grows with every step and change.
    std::uint64_t checked_moment = 0;         ///< At which all values are known to be finite.
    std::map<std::string, Formula> formulas;  ///< Of values(), by stage and text.

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

    /// Takes over a run, or why there is none.
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

    /// Notes why a change was refused.
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

    /// The checked expression; null, with `error` set, if it has errors.
    const Formula* formula(const std::string& text);
    /// The plane in which a formula's values lie; null if they must be computed.
    const Field* plane_of(const Formula& formula) const;
    /// The values of a formula, row by row.
    Field computed(const Formula& formula) const;

    std::uint32_t stage() const { return run->place().stage; }
    const Stage& current() const { return run->script().program->stages[stage()]; }
    /// Of all stages so far.
    std::int64_t steps() const {
        std::int64_t steps = 0;
        for (std::uint32_t k = 0; k <= stage(); ++k) steps += run->simulation().state(k).steps;
        return steps;
    }

    /// Are all values of the present step finite? Fails as the steps would have where not.
    bool check() {
        if (checked_moment == moment) return !failed;
        control.cancel = control.checks_later = false;
        if (const auto good = run->check(control); !good) fail(good.error());
        checked_moment = moment;
        return !failed;
    }
};

}  // namespace cascade
