// The command `cascade sweep` runs a script with many values of its parameters, and writes a
// labelled sheet and a table of features.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "ranks/messenger.h"
#include "run/commands/film_request.h"
#include "run/commands/moments.h"
#include "run/commands/parameter_sets.h"
#include "run/commands/run_log.h"
#include "run/commands/sweep_result.h"
#include "run/commands/variation.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <atomic>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// One of `count` nearly equal parts of a sweep. It consists of the runs `number` − 1, `number` − 1
/// + `count`, and so on. Several processes can take the parts of one sweep in one folder at the
/// same time.
struct SweepPart {
    std::size_t number = 1;  ///< From 1 to `count`.
    std::size_t count = 1;

    bool is_all() const { return count == 1; }
    bool has(std::size_t run) const { return run % count == number - 1; }
};

struct SweepRequest {
    /// The first variation changes along the rows of the sheet, from left to right. The second
    /// variation changes along the columns, from the bottom to the top.
    std::vector<Variation> varied;
    /// The table of option --sets. If it is given, the first element of `varied` is the variation
    /// of the table.
    std::optional<ParameterSets> sets;
    /// The folder of all outputs. Empty: SCRIPT_sweep in the current folder.
    std::filesystem::path folder;
    /// The path of a film that shows the ends of all runs. Empty: no film is written.
    std::filesystem::path film;
    FilmRequest pace;
    /// The names of numbers to draw over the first varied name other than the seed. Each gives a
    /// file NUMBER.svg.
    std::vector<std::string> curves;
    LogRequest log;          ///< What every run logs. Its member `file` is ignored.
    MomentsRequest moments;  ///< When every run logs.
    PictureRequest picture;  ///< Says which values to show and measure. `scale` is ignored.
    int tile_side = 160;     ///< In pixels. Larger pictures are reduced to this size by averaging.
    /// The path of an HDF5 file with the fields of all runs. If not empty, `fields` must be true.
    std::filesystem::path data;
    bool fields = false;  ///< Whether the fields of every run are saved, to be read or resumed.
    bool force = false;   ///< Whether runs of an earlier sweep are repeated.
    SweepPart part;       ///< The runs that this process takes.
    /// Folders of other sweeps. Their results are copied instead of taking the runs again.
    std::vector<std::filesystem::path> gathered;
    SimulationOptions simulation;  ///< Its member `threads` is the number of concurrent runs.
    /// The ranks that share the runs. Null if this process takes all of them.
    Messenger* messenger = nullptr;
    int ranks_here = 1;  ///< The number of ranks on this machine, which share its memory.
};

/// The progress of a sweep.
struct SweepProgress {
    std::size_t runs_done = 0;  ///< Includes runs that an earlier sweep has taken.
    std::size_t runs = 0;
    double share = 0;  ///< The finished fraction of the runs that this sweep takes, 0 … 1.
    double seconds_left = -1;  ///< Negative if unknown.
};

struct SweepControl {
    std::atomic<bool> cancel{false};  ///< Ends every run after its present step.
    std::function<void(const SweepProgress&)>
        report;  ///< Called in the thread that has called sweep().
};

struct SweepReport {
    std::size_t runs = 0;         ///< The number of runs of this part.
    std::size_t done_before = 0;  ///< Runs whose results come from an earlier sweep.
    /// Runs with values that were not finite. Each of these runs gets an empty tile and a remark.
    std::size_t failed = 0;
    std::size_t missing = 0;    ///< Runs that were left out after a cancel.
    std::string first_failure;  ///< The message of the first failed run.
    std::int64_t steps = 0;     ///< The number of steps that this sweep has taken.
    double seconds = 0;
    std::vector<std::filesystem::path> written;
};

/// An error in the request, in the file of parameter sets, or in the script with the values of a
/// run. If the script has errors, `script` contains their messages.
struct SweepError {
    Failure failure;
    std::optional<Script> script = {};
    bool is_in_sets = false;
};

/// Takes all runs that have no result yet, each in a single thread. Writes the files of
/// write_sweep(), runs/ (a small result for each run) and, if requested, fields/NAME=VALUE,…/. A
/// part of a sweep writes neither sheet nor table. Every script is checked before the first step. A
/// run that fails because values are not finite counts as a result, too. Fails if no run can be
/// made or a file cannot be written.
///
/// If ranks share the sweep, all of them call this function. Rank 0 hands out the runs and writes
/// all files but fields. The report of the other ranks is empty. Fails on a rank whose runs have
/// other keys than the runs of rank 0.
tl::expected<SweepReport, SweepError> sweep(const Script& script, const SweepRequest& request,
                                            SweepControl& control);

/// Draws a sheet of all results in the order of their runs. The tile of a missing result is empty.
/// If the domain has a mask, NaN is transparent.
Image draw_sweep(const std::vector<std::optional<SweepResult>>& results,
                 const std::vector<Variation>& varied, const PictureRequest& picture,
                 bool has_mask);

/// Writes sheet.png, features.csv, and the requested curves, logs and film to the folder. If the
/// seed is varied, also writes tables of ensembles (ensemble.h, sweep_logs.h). Returns the paths of
/// the files. `cancel` stops only the film.
Result<std::vector<std::filesystem::path>> write_sweep(
    const Script& script, const SweepRequest& request, const std::filesystem::path& folder,
    const std::vector<std::optional<SweepResult>>& results, const std::atomic<bool>& cancel);

/// Checks before the first run whether the film can be written.
Result<void> check_sweep_film(const SweepRequest& request, const std::atomic<bool>& cancel);

/// Writes a film that shows the ends of all runs, in their order. Each frame shows in a corner the
/// varied values of its run. The colours of all frames cover the range of the sheet. Runs that
/// failed or are missing are left out. Fails if no run is left. After `cancel` is set, waits for
/// ffmpeg only while ffmpeg makes progress.
Result<void> film_sweep(const std::filesystem::path& path, const FilmRequest& pace,
                        const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied, const PictureRequest& picture,
                        bool has_mask, const std::atomic<bool>& cancel = never_cancelled);

/// Writes the table of features. It has a row for each run, with the run's values, features, number
/// of steps and remark.
std::string sweep_table(const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied);

}  // namespace cascade
