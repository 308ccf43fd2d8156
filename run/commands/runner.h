// Carries out a run, from the first check to the report.
#pragma once

#include "run/commands/detailed_run.h"
#include "run/commands/frame_labels.h"
#include "run/commands/run.h"
#include "run/commands/run_checks.h"
#include "run/commands/run_results.h"
#include "run/pictures/frames.h"
#include "run/session/live_run.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace cascade {

/// All arguments except the request must outlive the runner.
class Runner {
public:
    Runner(Script& script, const RunRequest& request, RunControl& control)
        : script_(script), request_(request), control_(control) {}

    /// See cascade::run().
    Result<RunReport> run();
    /// Finishes the work of the simulation, which may then report on its stages.
    void settle() {
        if (simulation_) simulation_->settle(control_);
    }

private:
    using Clock = std::chrono::steady_clock;

    // The following functions run before the first step (run_preparation.cpp).
    Result<void> prepare();
    Result<void> check_places(Folders folders);
    Result<void> make_simulation();
    Result<void> find_texture(const SurfaceMesh& mesh);
    void choose_map_size();
    Result<std::unique_ptr<LiveRun>> play_session();
    Result<void> make_detailed();
    bool has_cancelled(std::string what);
    void keep_while_running();

    bool has_nothing_to_lose() const;
    Result<void> run_stages();
    Result<void> settle_in_detail();
    Result<StageEnd> run_stage(std::uint32_t stage);
    void remark(std::string words);
    void remark_on_resumed();
    void look();
    void add_to_series(std::uint32_t stage);
    void observe(std::uint32_t stage);
    void remark_on_moments();
    bool frame_is_due(std::uint32_t stage);
    double marks_done(std::uint32_t stage) const;
    std::int64_t observation_interval(const Stage& stage) const;
    std::string place() const;
    RunResults results();
    const Simulation& shown() const {
        return is_detailed_ ? detailed_->simulation() : *simulation_;
    }
    Painter& painter() { return is_detailed_ ? detailed_->painter() : *painter_; }

    Script& script_;
    RunRequest request_;
    Moments moments_;  ///< The moments of the request, in the unit of the script.
    RunControl& control_;
    RunReport report_;
    std::vector<std::filesystem::path> outputs_;
    std::unique_ptr<Simulation> simulation_;
    MeshTexture texture_;                    ///< Texture coordinates that were made for the model.
    std::unique_ptr<DetailedRun> detailed_;  ///< Null without --detail.
    /// Whether the end of the run has been transferred to the smaller cells of --detail.
    bool is_detailed_ = false;
    std::optional<Painter> painter_;
    std::vector<Painter> panels_;  ///< A painter for each panel of a figure.
    std::optional<FrameRecorder> frames_;
    std::optional<FrameLabels> labels_;
    /// Frames that an earlier run has written to the same folder.
    std::vector<std::filesystem::path> earlier_frames_;
    std::optional<RunLog> log_;
    std::unique_ptr<SeriesWriter> series_;
    /// The number of marks of the stage that had passed at the last call of frame_is_due().
    double marks_seen_ = 0;
    /// The stage of the last moment in the series, and the time in that stage. If the stage has no
    /// time, its step.
    std::optional<std::pair<std::uint32_t, double>> last_in_series_;
};

}  // namespace cascade
