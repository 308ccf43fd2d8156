// One run, from the first check to the report.
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

/// Its arguments but the request must outlive it.
class Runner {
public:
    Runner(Script& script, const RunRequest& request, RunControl& control)
        : script_(script), request_(request), control_(control) {}

    /// As cascade::run().
    Result<RunReport> run();
    /// Ends the simulation, which may report on its stages.
    void settle() {
        if (simulation_) simulation_->settle(control_);
    }

private:
    using Clock = std::chrono::steady_clock;

    // Before the first step (run_preparation.cpp):
    Result<void> prepare();
    Result<void> check_places(Folders folders);
    Result<void> make_simulation();
    Result<void> find_texture(const SurfaceMesh& mesh);
    void choose_map_size();
    Result<std::unique_ptr<LiveRun>> play_session();
    Result<void> make_detailed();
    bool has_cancelled(std::string what);
    void keep_while_running();

    Result<void> run_stages();
    Result<void> settle_in_detail();
    Result<StageEnd> run_stage(std::uint32_t stage);
    void remark(std::string words);
    void remark_on_resumed();
    void look();
    void add_to_series(std::uint32_t stage);
    void observe(std::uint32_t stage);
    NextMoment moments_of(std::uint32_t stage) const;
    void remark_on_moments();
    bool frame_is_due(std::uint32_t stage);
    double tenths_done(std::uint32_t stage) const;
    std::int64_t observation_interval(const Stage& stage) const;
    std::string place() const;
    RunResults results();
    const Simulation& shown() const {
        return is_detailed_ ? detailed_->simulation() : *simulation_;
    }
    Painter& painter() { return is_detailed_ ? detailed_->painter() : *painter_; }

    Script& script_;
    RunRequest request_;
    RunControl& control_;
    RunReport report_;
    std::vector<std::filesystem::path> outputs_;
    std::unique_ptr<Simulation> simulation_;
    MeshTexture texture_;                    ///< That was made for the model.
    std::unique_ptr<DetailedRun> detailed_;  ///< Null without --detail.
    bool is_detailed_ = false;               ///< Has the run been carried there?
    std::optional<Painter> painter_;
    std::vector<Painter> panels_;  ///< Of figures.
    std::optional<FrameRecorder> frames_;
    std::optional<FrameLabels> labels_;
    std::vector<std::filesystem::path> earlier_frames_;  ///< Of an earlier run, in their folder.
    std::optional<RunLog> log_;
    std::unique_ptr<SeriesWriter> series_;
    double tenths_seen_ = 0;  ///< Of the stage's duration, at the last frame.
    std::optional<std::pair<std::uint32_t, double>> last_in_series_;  ///< Stage, and step or time.
};

}  // namespace cascade
