// Makes a live run execute commands, take a few steps at a time, and make snapshots. A Session
// calls these functions in a separate thread. Without threads, as in a browser's worker, the owner
// of the Turns calls them.
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
/// Calls LiveRun::apply(). If `joins_last` is true, the change is undone together with the previous
/// one.
struct MakeChange { Change change; bool joins_last = false; };
struct GoToStage { std::uint32_t stage = 0; };
struct Undo {};
struct Redo {};
struct GoOn {};                                  ///< Takes steps until another command stops them.
struct Pause {};
struct TakeSteps { std::int64_t count = 1; };    ///< Pauses after this number of steps.
/// Sets the expression shown in snapshots. If empty, snapshots show the script's own picture.
struct Show { std::string expression; };
/// Sets the slice shown in snapshots of a volume.
struct ShowSlice { Slice slice; };
// clang-format on

using SessionCommand =
    std::variant<MakeChange, GoToStage, Undo, Redo, GoOn, Pause, TakeSteps, Show, ShowSlice>;

/// The progress of a stage.
struct StageProgress {
    std::string name;
    std::int64_t steps = 0;
    std::int64_t iterations = 0;  ///< The stage ends after at most this number of steps.
    double t = 0;
    double duration = 0;  ///< 0 if the stage ends after a number of iterations.
    bool has_begun = false;
    bool has_ended = false;
    /// The numbers of cells if the stage has crawling cells and has begun. Otherwise empty.
    std::optional<CellCounts> cells = {};
};

/// The state of a session at one moment, for display. Its reader may store it.
struct Snapshot {
    std::uint64_t number = 0;  ///< The first snapshot has the number 1.
    std::uint64_t script = 0;  ///< A number that changes if and only if the script changes.
    bool is_going_on = false;  ///< Whether the run takes steps at present.
    RunPlace place;
    std::vector<StageProgress> stages;
    double steps_per_second = 0;  ///< The speed that was measured last. 0 if it is unknown.
    bool can_undo = false, can_redo = false;
    /// The reason why the run stopped without a command. Empty if it did not.
    std::string failure;
    /// Remarks on ended stages, and warnings. The newest ones come last.
    std::vector<std::string> remarks;
    /// The values to show, in binary32: one field for a number, or red, green and blue. For a
    /// volume they are a slice. Values outside the mask are NaN. Cells of a model are in the order
    /// in which memory stores them (SpreadCells::order). Crawling cells form one row, in ascending
    /// order of their numbers.
    std::vector<Field> fields;
    std::shared_ptr<const ShownCells> cells;       ///< Null if fields are shown.
    Grid grid;                                     ///< The grid of the domain.
    Slice slice;                                   ///< The slice of a volume that is shown.
    PlaneScales scales{1, 1};                      ///< See Canvas::scales.
    std::shared_ptr<const ModelCells> model;       ///< Null on grids.
    std::shared_ptr<const SurfaceSource> surface;  ///< Null if the domain has no surface.
    /// The number of the surface. Each surface has a different number. 0 if there is no surface.
    std::uint64_t surface_number = 0;
};

/// Only one thread may use this object, except that any thread may set `control().cancel`.
class Turns {
public:
    /// The run is paused at first.
    explicit Turns(std::unique_ptr<LiveRun> run);

    LiveRun& run() { return *run_; }
    RunControl& control() { return control_; }

    Accepted<void> obey(const SessionCommand& command);

    /// Whether take() would take steps.
    bool is_going_on() const { return is_going_on_; }
    /// Takes steps for a few milliseconds. Commands need not wait longer than that, and with
    /// shorter turns steps would be slower.
    void take();

    /// Whether anything has changed since the last snapshot.
    bool has_changed() const { return has_changed_; }
    /// Whether a snapshot should be made now. Snapshots must take only a small fraction of the
    /// time, and must not be made more often than a screen can show them.
    bool is_snapshot_due() const;
    std::shared_ptr<const Snapshot> snapshot();

private:
    using Clock = std::chrono::steady_clock;

    /// A remark about a stage of the run.
    struct StageRemark {
        std::uint32_t stage;
        std::string words;
    };

    Accepted<void> carry_out(const SessionCommand& command);
    std::int64_t steps_of_turn() const;
    void remark(std::uint32_t stage, const std::string& words);
    Canvas canvas();
    void look_at_surface(std::shared_ptr<const SurfaceMesh> body);

    std::unique_ptr<LiveRun> run_;
    RunControl control_;
    bool is_going_on_ = false;
    /// The number of steps until the pause that TakeSteps has requested.
    std::optional<std::int64_t> steps_left_;
    std::string failure_;
    std::vector<StageRemark> remarks_;
    double steps_per_second_ = 0;
    std::uint64_t script_number_ = 1;
    std::string shown_;  ///< The requested expression. Empty: the script's own picture.
    Slice slice_;
    std::optional<Painter> painter_;
    std::shared_ptr<const SurfaceSource> surface_;
    std::uint64_t surface_number_ = 0;
    /// The number of the script for which the surface was last found.
    std::uint64_t looked_at_ = 0;
    const Script* painted_script_ = nullptr;
    std::uint64_t snapshots_ = 0;
    Clock::time_point shown_at_;
    double snapshot_cost_ = 0;
    bool has_changed_ = true;
};

}  // namespace cascade
