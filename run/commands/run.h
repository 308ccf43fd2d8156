// `cascade run`: takes a loaded script through its stages and writes pictures, frames and fields.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "measure/features.h"
#include "run/commands/film_request.h"
#include "run/commands/moments.h"
#include "run/commands/run_log.h"
#include "run/pictures/model_files.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"
#include "run/session/session_log.h"
#include "run/simulation/simulation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A step at which the run stops as if by Ctrl-C.
struct StopAt {
    std::string stage;
    std::int64_t step = 0;
    bool operator==(const StopAt&) const = default;
};

struct RunRequest {
    SimulationOptions simulation;
    PictureRequest picture;
    /// Pictures, films, models and cells, by their endings (output_kind); if empty, SCRIPT.png in
    /// the current folder.
    std::vector<std::filesystem::path> outputs;
    ModelFileOptions model_files;
    int turntable = 0;  ///< Number of pictures from all around; 0 for one.
    FilmRequest film;
    int slices = 0;                   ///< Of a volume, filmed one after the other; 0 for none.
    std::vector<std::string> panels;  ///< Expressions of `--panel`: figures show them in turn.
    std::vector<std::string> labels;  ///< What is written into frames: `--label`.
    std::filesystem::path sheet;      ///< `--sheet FILE`; empty for none.
    std::filesystem::path frames;     ///< `--frames DIR`; empty for none.
    std::filesystem::path save;       ///< `--save DIR`; empty for none.
    double checkpoint_seconds = 0;    ///< Above 0: seconds between saves during the run.
    std::filesystem::path volume;     ///< `--volume FILE`; empty for none.
    std::filesystem::path series;     ///< `--series FILE`; empty for none.
    std::vector<std::string> fields;  ///< Expressions of `--field`: the arrays of `series`.
    std::filesystem::path resume;     ///< `--resume DIR`; empty to start anew.
    std::optional<StopAt> stop_at;
    /// Played instead of the stages; its script at the end is the one that is run.
    std::optional<SessionLog> session;
    MomentsRequest moments;  ///< When it is observed.
    LogRequest log;
    bool features = false;  ///< Measure the values that the picture shows.
};

enum class RunStatus {
    finished,
    stopped,    ///< At `stop_at`.
    cancelled,  ///< By the user.
};

/// True if a film of the run's steps is written, and not one of its end.
bool films_steps(const RunRequest& request);

struct RunReport {
    RunStatus status = RunStatus::finished;
    std::string where;                           ///< "stage 'small', step 312 of 7000".
    bool has_begun = false;                      ///< True if there is something to write.
    std::vector<std::filesystem::path> written;  ///< In order.
    std::vector<std::string> notes;              ///< On these files, a sentence each.
    std::int64_t steps = 0;                      ///< Steps taken by this run.
    double seconds = 0;                          ///< Time of stepping.
    std::optional<measure::Features> features;   ///< If they were requested.
    /// Remarks on the result, a sentence each; `control.warn` has received them, too.
    std::vector<std::string> remarks;
};

/// Runs the script and writes the requested outputs. All outputs are checked before the first step.
/// After a cancel the results so far are written. The text of a failure is complete; if it is an
/// error in the script, `script.diagnostics` has errors.
Result<RunReport> run(Script& script, const RunRequest& request, RunControl& control);

/// Writes every field of the started stages as STAGE.NAME.npy, the script, and `run.json`. A saved
/// run in the folder is replaced atomically (run/commands/saved_folder.h): it stays valid until the
/// new one is complete. Fails, and changes nothing, if a file that is not part of that run has one
/// of these names.
Result<std::vector<std::filesystem::path>> save_run(const std::filesystem::path& folder,
                                                    const Script& script,
                                                    const Simulation& simulation);

/// Checks before a run that it can be saved in the folder.
Result<void> check_savable(const std::filesystem::path& folder, const Script& script);

/// Starts the stages of a saved run again and restores their species. The script must be the one
/// that was saved (load it with load_saved_script).
Result<void> restore_run(const std::filesystem::path& folder, const Script& script,
                         Simulation& simulation, const std::atomic<bool>& cancel = never_cancelled);

/// The script and overrides of a saved run. `changes` may lift or set `steps` and `until_stage`,
/// grant reads and name the place of the model. Files of the script are looked up in
/// `script_folder` if the user named it, else where find_script_folder() says. `look` is a script
/// that differs from the saved one in pictures only and takes its place.
Result<Script> load_saved_script(const std::filesystem::path& folder, const Overrides& changes,
                                 const std::filesystem::path& script_folder = {},
                                 const Script* look = nullptr);

}  // namespace cascade
