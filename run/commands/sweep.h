// `cascade sweep`: runs a script with many values of its parameters, and writes one labelled sheet
// and one table of features.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "run/commands/film_request.h"
#include "run/commands/parameter_sets.h"
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

struct SweepRequest {
    std::vector<Variation> varied;  ///< The first one runs across the sheet, the second one up.
    /// The table of --sets, if one is given: then the first of `varied` comes from it.
    std::optional<ParameterSets> sets;
    std::filesystem::path folder;  ///< Of all outputs; if empty, SCRIPT_sweep here.
    std::filesystem::path film;    ///< Of the ends of all runs; empty for none.
    FilmRequest pace;
    PictureRequest picture;        ///< What to show and measure; its scale is ignored.
    int tile_side = 160;           ///< Larger pictures are averaged down to this, in pixels.
    bool fields = false;           ///< Save the fields of every run, to read or to resume.
    bool force = false;            ///< Repeat runs of an earlier sweep.
    SimulationOptions simulation;  ///< `threads` is the number of concurrent runs.
};

/// The progress of a sweep.
struct SweepProgress {
    std::size_t runs_done = 0;  ///< Including those of an earlier sweep.
    std::size_t runs = 0;
    double share = 0;          ///< 0 … 1, of the runs to be taken now.
    double seconds_left = -1;  ///< Negative if unknown.
};

struct SweepControl {
    std::atomic<bool> cancel{false};                   ///< Ends every run after its present step.
    std::function<void(const SweepProgress&)> report;  ///< Called in the caller's thread.
};

struct SweepReport {
    std::size_t runs = 0;
    std::size_t done_before = 0;  ///< Taken over from an earlier sweep.
    std::size_t failed = 0;       ///< Runs that diverged: an empty tile and a remark.
    std::size_t missing = 0;      ///< Not taken, after a cancel.
    std::string first_failure;    ///< The message of the first failed run.
    std::int64_t steps = 0;       ///< Steps taken now.
    double seconds = 0;
    std::vector<std::filesystem::path> written;
};

/// An error of the request, of a script with its values (then `script` holds the messages), or in
/// the file of parameter sets.
struct SweepError {
    Failure failure;
    std::optional<Script> script = {};
    bool is_in_sets = false;
};

/// Takes the runs without a result, each on one thread, and writes sheet.png, features.csv, runs/
/// (one small result each) and, if requested, fields/NAME=VALUE,…/. Every script is checked before
/// the first step. Runs that diverge are results, too. Fails if nothing can be run or written.
tl::expected<SweepReport, SweepError> sweep(const Script& script, const SweepRequest& request,
                                            SweepControl& control);

/// A sheet of all results in the order of their runs; missing ones are empty tiles. If the domain
/// has a mask, NaN is transparent.
Image draw_sweep(const std::vector<std::optional<SweepResult>>& results,
                 const std::vector<Variation>& varied, const PictureRequest& picture,
                 bool has_mask);

/// Writes sheet.png and features.csv into the folder, and the film, if there is one. Returns the
/// files. `cancel` is for the film.
Result<std::vector<std::filesystem::path>> write_sweep(
    const Script& script, const SweepRequest& request, const std::filesystem::path& folder,
    const std::vector<std::optional<SweepResult>>& results, const std::atomic<bool>& cancel);

/// Checks before the first run that the film can be written.
Result<void> check_sweep_film(const SweepRequest& request, const std::atomic<bool>& cancel);

/// Writes a film that shows the end of each run, in their order, with its values in a corner and in
/// the range of the sheet. Runs that failed or are missing are left out; fails if none is left.
/// Once `cancel` is set, ffmpeg is not waited for unless it gets on.
Result<void> film_sweep(const std::filesystem::path& path, const FilmRequest& pace,
                        const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied, const PictureRequest& picture,
                        bool has_mask, const std::atomic<bool>& cancel = never_cancelled);

/// A row for each run: the values varied, its features, its number of steps, its remark.
std::string sweep_table(const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied);

}  // namespace cascade
