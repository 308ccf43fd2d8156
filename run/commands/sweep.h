// `cascade sweep`: the same script with many values of its parameters, to one labelled sheet and
// one table of features.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
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
    std::vector<Variation> varied;  ///< The first runs across the sheet, the second up.
    std::filesystem::path folder;   ///< Where all goes; empty: SCRIPT_sweep in this folder.
    PictureRequest picture;         ///< What is shown and measured; without scale.
    int tile_side = 160;            ///< Larger pictures are averaged down to this, in pixels.
    bool fields = false;            ///< Save the fields of every run, to read or to resume.
    bool force = false;             ///< Run again what an earlier sweep has done.
    SimulationOptions simulation;   ///< `threads` is how many runs go on at once.
};

/// How far a sweep is.
struct SweepProgress {
    std::size_t runs_done = 0;  ///< With those of an earlier sweep.
    std::size_t runs = 0;
    double share = 0;          ///< 0 … 1, of the runs to be taken now.
    double seconds_left = -1;  ///< Negative while unknown.
};

struct SweepControl {
    std::atomic<bool> cancel{false};  ///< Ends every run at its next complete step.
    std::function<void(const SweepProgress&)> report;  ///< Called by the caller's thread.
};

struct SweepReport {
    std::size_t runs = 0;
    std::size_t done_before = 0;  ///< Found in the folder.
    std::size_t failed = 0;       ///< Values that were not finite: an empty tile, a remark.
    std::size_t missing = 0;      ///< Not run: cancelled.
    std::string first_failure;    ///< What the first failed run said.
    std::int64_t steps = 0;       ///< Taken now.
    double seconds = 0;
    std::vector<std::filesystem::path> written;
};

/// A fault of the request, or one of a script with its values: then `faults` holds the messages.
struct SweepFault {
    Failure failure;
    std::optional<Script> faults;
};

/// Runs what has not been run yet, each on one thread, and writes sheet.png, features.csv, runs/
/// (one small result each) and, if asked for, fields/NAME=VALUE,…/. Every script is checked before
/// the first step. Runs that blow up are results too. Fails where nothing can be run or written.
tl::expected<SweepReport, SweepFault> sweep(const Script& script, const SweepRequest& request,
                                            SweepControl& control);

/// A sheet of all results in order of their runs; those that are missing are empty places. Where
/// the domain has a mask, NaN is transparent.
Image draw_sweep(const std::vector<std::optional<SweepResult>>& results,
                 const std::vector<Variation>& varied, const PictureRequest& picture,
                 bool has_mask);

/// A row for each run: the values varied, its features, its steps, its remark.
std::string sweep_table(const std::vector<std::optional<SweepResult>>& results,
                        const std::vector<Variation>& varied);

}  // namespace cascade
