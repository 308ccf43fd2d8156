// `cascade run`: stages, pictures, frames, saved fields, from a loaded script to files.
#pragma once

#include "core/result.h"
#include "core/run_control.h"
#include "measure/features.h"
#include "run/commands/run_log.h"
#include "run/pictures/model_files.h"
#include "run/script/picture_request.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// A place to stop at: as Ctrl-C would, but at a step that is known.
struct StopAt {
    std::string stage;
    std::int64_t step = 0;
};

struct RunRequest {
    SimulationOptions simulation;
    PictureRequest picture;
    /// Pictures, models and cells, by their endings (output_kind); empty: SCRIPT.png in the current
    /// folder.
    std::vector<std::filesystem::path> outputs;
    ModelFileOptions model_files;
    int turntable = 0;              ///< Pictures from so many places around; 0: from one.
    std::filesystem::path sheet;    ///< `--sheet FILE`; empty: none.
    std::filesystem::path frames;   ///< `--frames DIR`; empty: none.
    std::filesystem::path save;     ///< `--save DIR`; empty: none.
    double checkpoint_seconds = 0;  ///< Above 0: what --save writes is also written so often.
    std::filesystem::path volume;   ///< `--volume FILE.vti`; empty: none.
    std::filesystem::path resume;   ///< `--resume DIR`; empty: from the start.
    std::optional<StopAt> stop_at;
    LogRequest log;
    bool features = false;  ///< Measure what the picture shows.
};

enum class RunStatus {
    finished,
    stopped,    ///< At `stop_at`.
    cancelled,  ///< By the user.
};

struct RunReport {
    RunStatus status = RunStatus::finished;
    std::string where;                           ///< "stage 'small', step 312 of 7000".
    bool has_begun = false;                      ///< There is something to write.
    std::vector<std::filesystem::path> written;  ///< In order.
    std::int64_t steps = 0;                      ///< Taken by this run.
    double seconds = 0;                          ///< Of stepping.
    std::optional<measure::Features> features;   ///< Where they were asked for.
    /// What is to be said of the result, a sentence each; `control.warn` has been told.
    std::vector<std::string> remarks;
};

/// Runs the script and writes what was asked for. All outputs are checked before the first step.
/// After a cancel what there is is written. A failure's text is complete; where it is a fault of
/// the script, `script.diagnostics` has errors.
Result<RunReport> run(Script& script, const RunRequest& request, RunControl& control);

/// Writes every field of the started stages as STAGE.NAME.npy, the script, and `run.json`. A run
/// that is saved there already is replaced in one move (run/commands/saved_folder.h): until the new
/// one is complete, the old one is. Fails, and changes nothing, where a file that is not of that
/// run has one of these names.
Result<std::vector<std::filesystem::path>> save_run(const std::filesystem::path& folder,
                                                    const Script& script,
                                                    const Simulation& simulation);

/// Looks before a run whether it will be possible to save it there.
Result<void> check_savable(const std::filesystem::path& folder, const Script& script);

/// Starts the stages of a saved run again and puts their species back. The script must be the one
/// that was saved (load it with load_saved_script).
Result<void> restore_run(const std::filesystem::path& folder, const Script& script,
                         Simulation& simulation);

/// The script and overrides of a saved run. `changes` may lift or set `steps` and `until_stage`,
/// grant reads and say where the model lies. The script's files lie in `script_folder`, where the
/// user has named it, else where find_script_folder() says.
Result<Script> load_saved_script(const std::filesystem::path& folder, const Overrides& changes,
                                 const std::filesystem::path& script_folder = {});

}  // namespace cascade
