// A live run in turns: commands in, some steps at a time, snapshots out. A session takes its turns
// in a thread; where there are no threads, as in a browser's worker, the caller takes them.
#pragma once

#include "core/run_control.h"
#include "run/pictures/painter.h"
#include "run/pictures/shown_cells.h"
#include "run/pictures/shown_surface.h"
#include "run/session/live_run.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace cascade {

// clang-format off
/// LiveRun::apply(): with `joins_last`, undone together with the change before.
struct MakeChange { Change change; bool joins_last = false; };
struct GoToStage { std::uint32_t stage = 0; };
struct Undo {};
struct Redo {};
struct GoOn {};                                  ///< Takes steps until told otherwise.
struct Pause {};
struct TakeSteps { std::int64_t count = 1; };    ///< And pauses then.
/// The expression that snapshots show; empty: what pictures of the script show.
struct Show { std::string expression; };
/// The slice of a volume that snapshots show.
struct ShowSlice { Slice slice; };
// clang-format on

using SessionCommand =
    std::variant<MakeChange, GoToStage, Undo, Redo, GoOn, Pause, TakeSteps, Show, ShowSlice>;

/// How far a stage has come.
struct StageProgress {
    std::string name;
    std::int64_t steps = 0;
    std::int64_t iterations = 0;  ///< The most steps that it takes.
    double t = 0;
    double duration = 0;  ///< 0 if the stage ends by its iterations.
    bool has_begun = false;
    bool has_ended = false;
    /// Of a stage of cells that crawl, when it has begun.
    struct Cells {
        std::int64_t count = 0, births = 0, deaths = 0;
    };
    std::optional<Cells> cells = {};
};

/// A moment of a session, which its reader may keep as long as it likes.
struct Snapshot {
    std::uint64_t number = 0;  ///< Snapshots count from 1.
    std::uint64_t script = 0;  ///< Differs if and only if the script does.
    bool is_going_on = false;  ///< Are steps taken?
    RunPlace place;
    std::vector<StageProgress> stages;
    double steps_per_second = 0;  ///< Recent; 0 while unknown.
    bool can_undo = false, can_redo = false;
    std::string failure;               ///< Why the run stopped by itself; empty if it has not.
    std::vector<std::string> remarks;  ///< On stages that have ended, and warnings, newest last.
    /// What is shown, in binary32: one field, or red, green and blue; a slice of a volume. Outside
    /// of a mask it is NaN. The cells of a model are in their rows (ModelCells::order).
    /// Of cells that crawl one row, in ascending order of their numbers.
    std::vector<Field> fields;
    std::shared_ptr<const ShownCells> cells;       ///< Null where fields are shown.
    Grid grid;                                     ///< Of the domain.
    Slice slice;                                   ///< The one that is shown of a volume.
    std::shared_ptr<const ModelCells> model;       ///< Null on grids.
    std::shared_ptr<const SurfaceSource> surface;  ///< Null if the domain is none.
    std::uint64_t surface_number = 0;              ///< Another one for another surface; 0 for none.
};

/// One thread at a time; only `control().cancel` may be set from any.
class Turns {
public:
    /// Starts paused.
    explicit Turns(std::unique_ptr<LiveRun> run);

    LiveRun& run() { return *run_; }
    RunControl& control() { return control_; }

    Accepted<void> obey(const SessionCommand& command);

    /// Are steps to be taken?
    bool is_going_on() const { return is_going_on_; }
    /// Takes steps for some milliseconds: few, so that a command need not wait, but not so few that
    /// steps get slower.
    void take();

    /// Has anything happened since the last snapshot?
    bool has_changed() const { return has_changed_; }
    /// Would a snapshot now cost the steps only a small part of the time, and come no sooner than a
    /// screen shows it?
    bool is_snapshot_due() const;
    std::shared_ptr<const Snapshot> snapshot();

private:
    using Clock = std::chrono::steady_clock;

    Accepted<void> carry_out(const SessionCommand& command);
    std::int64_t steps_of_turn() const;
    void remark(const std::string& words);
    Canvas canvas();
    void look_at_surface(std::shared_ptr<const SurfaceMesh> body);

    std::unique_ptr<LiveRun> run_;
    RunControl control_;
    bool is_going_on_ = false;
    std::optional<std::int64_t> steps_left_;  ///< Of TakeSteps.
    std::string failure_;
    std::vector<std::string> remarks_;
    double steps_per_second_ = 0;
    std::uint64_t script_number_ = 1;
    std::string shown_;  ///< The expression that is asked for.
    Slice slice_;
    std::optional<Painter> painter_;
    std::shared_ptr<const SurfaceSource> surface_;
    std::uint64_t surface_number_ = 0;
    std::uint64_t looked_at_ = 0;  ///< The script whose surface it is.
    const Script* painted_script_ = nullptr;
    std::uint64_t snapshots_ = 0;
    Clock::time_point shown_at_;
    double snapshot_cost_ = 0;
    bool has_changed_ = true;
};

}  // namespace cascade
