// Goes to a stage, and implements undo and redo. If values are no longer stored, because many
// changes followed, they are computed again by repeating the log.
#include "run/session/live_run.h"

#include <fmt/format.h>

#include <utility>

namespace cascade {

LiveRun::Moment LiveRun::present() const {
    return {log(), script_->text, script_->overrides, values()};
}

Accepted<void> LiveRun::go_to(std::uint32_t stage, RunControl& control) {
    if (stage >= script_->stage_count()) {
        return refuse(fmt::format("there is no stage {}", stage + 1));
    }
    if (stage > stage_) {
        bool joins_last = false;
        while (stage_ < stage) {
            if (auto next = apply(NextStage{}, control, joins_last); !next) return next;
            joins_last = true;
        }
        return {};
    }
    Moment before = present();
    Script script = load_script(script_->name, script_->text, script_->folder, script_->overrides);
    auto adopted = adopt(std::move(script), *before.values, Continuation::changed, control, stage);
    if (!adopted) return adopted;
    if (stage > 0) {
        // Starting the stage cannot be cancelled. A cancellation would also prevent the return to
        // the previous moment.
        if (auto started = start_stage(stage, never_cancelled); !started) {
            // No step was taken, so the values of the previous stage are unchanged.
            const auto back = return_to(before, control);
            return back ? started : back;
        }
    }
    const auto changes = std::exchange(log_.changes, {});
    for (const auto& logged : changes) {
        if (logged->at.stage < stage) {
            log_.changes.push_back(logged);
        } else if (is_of_script(logged->change)) {
            add_to_log(logged->change, {stage, 0});
        }
    }
    remember(std::move(before));
    future_.clear();
    tell_of(false);
    return {};
}

Accepted<void> LiveRun::return_to(Moment& moment, RunControl& control) {
    if (!moment.values) {
        auto again = play(moment.log, script_->folder, options_, control);
        if (!again) return tl::unexpected(std::move(again.error()));
        simulation_ = std::move((*again)->simulation_);
        script_ = std::move((*again)->script_);
        painted_ = std::move((*again)->painted_);
        stage_ = (*again)->stage_;
    } else {
        Script script = load_script(script_->name, moment.text, script_->folder, moment.overrides);
        auto adopted = adopt(std::move(script), *moment.values, Continuation::same, control);
        if (!adopted) return adopted;
    }
    log_ = std::move(moment.log);
    return {};
}

Accepted<void> LiveRun::undo(RunControl& control) {
    if (past_.empty()) return refuse("nothing is left to undo");
    return step_through(past_, future_, control);
}

Accepted<void> LiveRun::redo(RunControl& control) {
    if (future_.empty()) return refuse("nothing was undone");
    return step_through(future_, past_, control);
}

/// Goes to the last moment of `from`, and stores the present moment in `to`.
Accepted<void> LiveRun::step_through(std::vector<Moment>& from, std::vector<Moment>& to,
                                     RunControl& control) {
    Moment now = present();
    if (auto there = return_to(from.back(), control); !there) return there;
    from.pop_back();
    to.push_back(std::move(now));
    forget_old_values();
    tell_of(false);
    return {};
}

void LiveRun::remember(Moment moment) {
    past_.push_back(std::move(moment));
    forget_old_values();
}

void LiveRun::forget_old_values() {
    std::size_t bytes = 0, other = 0;
    for (std::vector<Moment>* moments : {&past_, &future_}) {
        for (std::size_t k = moments->size(); k-- > 0;) {
            Moment& moment = (*moments)[k];
            if (moment.values) bytes += moment.values->bytes();
            if (bytes > undo_memory_) moment.values.reset();
            // Texts and logs cannot be computed again. So if they need too much memory, the moment
            // is deleted. A moment without values is also deleted if the log cannot reproduce its
            // values.
            const bool is_lost = is_resumed_ && !moment.values;
            other += moment.text.size() + moment.log.text.size() +
                     moment.log.changes.size() * sizeof moment.log.changes[0];
            if (other <= undo_texts_ && !is_lost) continue;
            moments->erase(moments->begin(), moments->begin() + static_cast<std::ptrdiff_t>(k + 1));
            break;
        }
    }
}

}  // namespace cascade
