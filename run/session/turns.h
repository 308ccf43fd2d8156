// A live run in turns: commands in, a few steps at a time, snapshots out. A session takes its turns
// in a thread. Without threads, as in a browser's worker, the caller takes them.
#pragma once

#include "core/run_control.h"
#include "run/pictures/painter.h"
#include "run/pictures/shown_cells.h"
#include "run/pictures/shown_surface.h"
#include "run/session/live_run.h"
#include "run/stage/stage_state.h"

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
struct TakeSteps { std::int64_t count = 1; };    ///< Pauses after the steps.
/// Sets the expression in snapshots. Empty: the script's own picture.
struct Show { std::string expression; };
/// Sets the slice of a volume in snapshots.
struct ShowSlice { Slice slice; };
// clang-format on

using SessionCommand =
    std::variant<MakeChange, GoToStage, Undo, Redo, GoOn, Pause, TakeSteps, Show, ShowSlice>;

/// The progress of a stage.
struct StageProgress {
    std::string name;
    std::int64_t steps = 0;
    std::int64_t iterations = 0;  ///< The most steps of the stage.
    double t = 0;
    double duration = 0;  ///< 0 if the stage ends by its iterations.
    bool has_begun = false;
    bool has_ended = false;
    /// For a stage of crawling cells, when it has begun.
    std::optional<CellCounts> cells = {};
};

/// A moment of a session. Its reader may keep it.
struct Snapshot {
    std::uint64_t number = 0;  ///< Snapshots count from 1.
    std::uint64_t script = 0;  ///< Differs if and only if the script does.
    bool is_going_on = false;  ///< Whether steps are being taken.
    RunPlace place;
    std::vector<StageProgress> stages;
    double steps_per_second = 0;  ///< Recent. 0 while unknown.
    bool can_undo = false, can_redo = false;
    std::string failure;               ///< Why the run stopped by itself. Empty if it has not.
    std::vector<std::string> remarks;  ///< About ended stages, and warnings, newest last.
    /// The values shown, in binary32: one field, or red, green and blue. A slice for a volume.
    /// Outside of a mask they are NaN. The cells of a model are in their rows (ModelCells::order).
    /// Crawling cells are in one row, in ascending order of their numbers.
    std::vector<Field> fields;
    std::shared_ptr<const ShownCells> cells;       ///< Null where fields are shown.
    Grid grid;                                     ///< The domain's.
    Slice slice;                                   ///< The slice shown of a volume.
    std::shared_ptr<const ModelCells> model;       ///< Null on grids.
    std::shared_ptr<const SurfaceSource> surface;  ///< Null if the domain is not a surface.
    std::uint64_t surface_number = 0;              ///< Different for each surface. 0 for none.
};

/// Not thread-safe, except that any thread may set `control().cancel`.
class Turns {
public:
    /// Starts paused.
    explicit Turns(std::unique_ptr<LiveRun> run);

    LiveRun& run() { return *run_; }
    RunControl& control() { return control_; }

    Accepted<void> obey(const SessionCommand& command);

    /// Whether steps are to be taken.
    bool is_going_on() const { return is_going_on_; }
    /// Takes steps for a few milliseconds: few enough that a command need not wait, and enough that
    /// steps stay fast.
    void take();

    /// Whether anything has happened since the last snapshot.
    bool has_changed() const { return has_changed_; }
    /// Whether a snapshot would now cost only a small part of the time, and not come sooner than a
    /// screen can show it.
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
    std::optional<std::int64_t> steps_left_;  ///< For TakeSteps.
    std::string failure_;
    std::vector<std::string> remarks_;
    double steps_per_second_ = 0;
    std::uint64_t script_number_ = 1;
    std::string shown_;  ///< The requested expression.
    Slice slice_;
    std::optional<Painter> painter_;
    std::shared_ptr<const SurfaceSource> surface_;
    std::uint64_t surface_number_ = 0;
    std::uint64_t looked_at_ = 0;  ///< The script of this surface.
    const Script* painted_script_ = nullptr;
    std::uint64_t snapshots_ = 0;
    Clock::time_point shown_at_;
    double snapshot_cost_ = 0;
    bool has_changed_ = true;
};

}  // namespace cascade
