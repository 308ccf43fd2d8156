// Executes commands, and chooses the number of steps of a turn.
#include "run/session/turns.h"

#include "core/failure_line.h"
#include "run/session/session_picture.h"
#include "run/simulation/end_remarks.h"
#include "run/simulation/tissue_stage.h"
#include "run/stage/stage_time.h"
#include "run/stage/time_account.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cascade {
namespace {

/// Makes a request for a picture of the cells themselves. If the script's picture shows a volume as
/// a body, this picture shows a slice of the volume.
PictureRequest cells_of(std::string expression) {
    PictureRequest request = picture_of(std::move(expression));
    request.flat = true;
    return request;
}

using Seconds = std::chrono::duration<double>;

/// The time, in seconds, that a turn takes approximately.
constexpr double turn_seconds = 0.015;
/// A turn takes at least this many steps, unless these steps would take longer than
/// longest_turn_seconds. With fewer steps in a turn, taking several steps in one pass through
/// memory would gain too little.
constexpr std::int64_t least_steps = 32;
constexpr double longest_turn_seconds = 0.2;
/// The largest number of steps of a turn. It limits turns in which steps take no measurable time.
constexpr double most_steps_of_turn = 1e9;
/// The shortest time in seconds between snapshots, and the largest fraction of the time that making
/// snapshots may take.
constexpr double snapshot_seconds = 1.0 / 60;
constexpr double part_of_snapshots = 0.02;
constexpr std::size_t most_remarks = 20;

/// Whether a command changes the pattern or goes to another moment.
bool changes_pattern(const SessionCommand& command) {
    return std::holds_alternative<MakeChange>(command) ||
           std::holds_alternative<GoToStage>(command) || std::holds_alternative<Undo>(command) ||
           std::holds_alternative<Redo>(command);
}

}  // namespace

Turns::Turns(std::unique_ptr<LiveRun> run) : run_(std::move(run)) {
    control_.checks_later = true;
    control_.warn = [this](const std::string& words) { remark(run_->place().stage, words); };
}

Accepted<void> Turns::obey(const SessionCommand& command) {
    const Script* const script = &run_->script();
    std::vector<StageRemark> before = std::exchange(remarks_, {});
    Accepted<void> result = carry_out(command);
    if (result && changes_pattern(command)) {
        // The present stage and all later stages will end again, perhaps in another way, so the
        // remarks on their ends are removed.
        std::erase_if(before, [stage = run_->place().stage](const StageRemark& remark) {
            return remark.stage >= stage;
        });
    }
    const std::vector<StageRemark> added = std::exchange(remarks_, std::move(before));
    for (const StageRemark& one : added) remark(one.stage, one.words);
    if (&run_->script() != script) ++script_number_;
    if (result) failure_.clear();
    has_changed_ = true;
    return result;
}

Accepted<void> Turns::carry_out(const SessionCommand& command) {
    if (const auto* make = std::get_if<MakeChange>(&command)) {
        return run_->apply(make->change, control_, make->joins_last);
    }
    if (const auto* go = std::get_if<GoToStage>(&command)) return run_->go_to(go->stage, control_);
    if (std::holds_alternative<Undo>(command)) {
        // Pauses, so that the user sees the restored state before it changes again.
        is_going_on_ = false;
        return run_->undo(control_);
    }
    if (std::holds_alternative<Redo>(command)) {
        is_going_on_ = false;
        return run_->redo(control_);
    }
    if (const auto* show = std::get_if<Show>(&command)) {
        auto made = make_painter(*run_, cells_of(show->expression));
        if (!made) return tl::unexpected(std::move(made.error()));
        shown_ = show->expression;
        painter_ = std::move(*made);
        painted_script_ = &run_->script();
        return {};
    }
    if (const auto* show = std::get_if<ShowSlice>(&command)) {
        slice_ = show->slice;
        return {};
    }
    const auto* steps = std::get_if<TakeSteps>(&command);
    is_going_on_ = !std::holds_alternative<Pause>(command) && !run_->is_over();
    steps_left_.reset();
    if (steps != nullptr) steps_left_ = std::max<std::int64_t>(steps->count, 0);
    return {};
}

std::int64_t Turns::steps_of_turn() const {
    const double usual = std::min(turn_seconds * steps_per_second_, most_steps_of_turn);
    const double longest = longest_turn_seconds * steps_per_second_;
    const double least = std::min(static_cast<double>(least_steps), longest);
    const auto steps = static_cast<std::int64_t>(std::max({usual, least, 1.0}));
    return steps_left_ ? std::min(steps, *steps_left_) : steps;
}

void Turns::take() {
    const Clock::time_point begun = Clock::now();
    const RunPlace before = run_->place();
    Watching watching;
    watching.stage_ended = [this](std::uint32_t stage) {
        if (const auto words = remark_on(run_->simulation(), stage); !words.empty()) {
            remark(stage, words);
        }
    };
    const std::int64_t asked = steps_of_turn();
    const auto end = run_->advance(asked, control_, watching);
    const RunPlace after = run_->place();
    const std::int64_t taken = after.stage == before.stage ? after.steps - before.steps : asked;
    if (steps_left_) *steps_left_ -= taken;
    const double seconds = std::max(seconds_since(begun), 1e-6);
    const double rate = static_cast<double>(taken) / seconds;
    steps_per_second_ = steps_per_second_ == 0 || after.stage != before.stage
                            ? rate
                            : 0.7 * steps_per_second_ + 0.3 * rate;
    has_changed_ = true;
    if (!end) failure_ = line_of(end.error());
    is_going_on_ = end && *end == StageEnd::stopped && steps_left_ != 0;
}

void Turns::remark(std::uint32_t stage, const std::string& words) {
    if (remarks_.size() == most_remarks) remarks_.erase(remarks_.begin());
    remarks_.push_back({stage, words});
}

bool Turns::is_snapshot_due() const {
    const double patience = std::max(snapshot_seconds, snapshot_cost_ / part_of_snapshots);
    // A snapshot is made at the end of the turn that is nearest to the moment when the snapshot is
    // due. Turns are a little shorter than `snapshot_seconds`, so without this allowance only every
    // second turn would end with a snapshot.
    return !is_going_on_ || seconds_since(shown_at_) >= patience - turn_seconds / 2;
}

Canvas Turns::canvas() {
    if (painted_script_ != &run_->script()) {
        auto made = make_painter(*run_, cells_of(shown_));
        // After a change of the script the expression may be invalid.
        painter_ = made ? std::move(*made) : std::move(*make_painter(*run_, cells_of("")));
        painted_script_ = &run_->script();
    }
    painter_->set_slice(slice_);
    return painter_->canvas(run_->simulation());
}

/// Gives a new surface a new number. If a change of the script does not change the surface, its
/// number stays the same.
void Turns::look_at_surface(std::shared_ptr<const SurfaceMesh> body) {
    const bool is_same_body = (surface_ ? surface_->body : nullptr) == body;
    if (std::exchange(looked_at_, script_number_) == script_number_ && is_same_body) return;
    auto source = SurfaceSource::of(*run_->script().program,
                                    run_->simulation().domain().shared_model(), std::move(body));
    if (source && surface_ && source->is_same_as(*surface_)) return;
    surface_ = source ? std::make_shared<const SurfaceSource>(std::move(*source)) : nullptr;
    ++surface_number_;
}

std::shared_ptr<const Snapshot> Turns::snapshot() {
    const Clock::time_point begun = Clock::now();
    auto made = std::make_shared<Snapshot>();
    made->number = ++snapshots_;
    made->script = script_number_;
    made->is_going_on = is_going_on_;
    made->place = run_->place();
    const Program& program = *run_->script().program;
    for (std::uint32_t k = 0; k < run_->script().stage_count(); ++k) {
        const Stage& stage = program.stages[k];
        const StageState& state = run_->simulation().state(k);
        StageProgress progress{stage.name, state.steps,   stage.iterations, state.t,
                               0,          state.started, state.done};
        if (state.started && stage.time.has_duration()) {
            progress.duration = duration_of(stage, program.system_of(k), state);
        }
        progress.cells = counts_of_cells(state);
        made->stages.push_back(std::move(progress));
    }
    made->steps_per_second = steps_per_second_;
    made->can_undo = run_->can_undo();
    made->can_redo = run_->can_redo();
    made->failure = failure_;
    for (const StageRemark& remark : remarks_) made->remarks.push_back(remark.words);
    const Simulation& simulation = run_->simulation();
    Canvas seen = canvas();
    made->fields = std::move(seen.fields);
    made->scales = seen.scales;
    made->grid = simulation.domain().grid;
    made->slice = slice_;
    made->model = simulation.domain().shared_model();
    look_at_surface(seen.cells ? body_under_cells(simulation.state(shown_stage(simulation)))
                               : nullptr);
    made->surface = surface_;
    if (seen.cells) {
        // If a surface is given by a function, only fields are drawn on it. Cells crawl on the
        // plane of its parameters.
        if (surface_ && surface_->function) made->surface = nullptr;
        made->cells =
            std::make_shared<const ShownCells>(shown_cells(*seen.cells, made->surface.get()));
    }
    made->surface_number = made->surface ? surface_number_ : 0;
    has_changed_ = false;
    shown_at_ = Clock::now();
    // A single snapshot may have been slow only because its thread had to wait for a processor.
    const double cost = seconds_since(begun);
    snapshot_cost_ = snapshot_cost_ > 0 ? std::min(cost, 2 * snapshot_cost_) : cost;
    return made;
}

}  // namespace cascade
