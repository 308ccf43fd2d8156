// The command `cascade run` runs the stages of a loaded script, and writes pictures, frames and
// fields.
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

class LiveRun;

/// The step at which the run stops as if the user had pressed Ctrl-C there.
struct StopAt {
    std::string stage;
    std::int64_t step = 0;
    bool operator==(const StopAt&) const = default;
};

struct RunRequest {
    SimulationOptions simulation;
    PictureRequest picture;
    /// The files of option -o: pictures, films, models and cells, in the formats of their endings
    /// (see output_kind()). If empty, SCRIPT.png in the current folder.
    std::vector<std::filesystem::path> outputs;
    ModelFileOptions model_files;
    /// The number of pictures around an object, from equally spaced directions. 0: a single
    /// picture.
    int turntable = 0;
    FilmRequest film;
    /// The number of slices of a volume that a film shows one after the other. 0: no film shows
    /// slices.
    int slices = 0;
    std::vector<std::string> panels;  ///< Expressions of `--panel`. Figures have a panel for each.
    /// Words of `--label`, which are drawn into the corner of frames.
    std::vector<std::string> labels;
    std::filesystem::path sheet;    ///< `--sheet FILE`. Empty: no sheet is written.
    std::filesystem::path frames;   ///< `--frames DIR`. Empty: no frames are written.
    std::filesystem::path save;     ///< `--save DIR`. Empty: the run is not saved.
    double checkpoint_seconds = 0;  ///< If above 0, the seconds between saves during the run.
    std::filesystem::path volume;   ///< `--volume FILE`. Empty: no volume is written.
    std::filesystem::path series;   ///< `--series FILE`. Empty: no series is written.
    /// Expressions of `--field`, which give the arrays of `series`.
    std::vector<std::string> fields;
    std::filesystem::path resume;  ///< `--resume DIR`. Empty: the run starts anew.
    std::optional<StopAt> stop_at;
    /// The log of a session. If there is one, the session is repeated, and the stages are not run
    /// from their start. Afterwards the run continues with the last script of the session.
    std::optional<SessionLog> session;
    /// A live run of this script. If there is one, its present moment is written and no stage is
    /// run. `session` is then only the log that pictures contain, if any. Null: the stages are run.
    const LiveRun* present = nullptr;
    MomentsRequest moments;  ///< The times at which the run is observed.
    LogRequest log;
    bool features = false;  ///< Whether features of the values in the picture are measured.
};

enum class RunStatus {
    finished,
    stopped,    ///< The run reached the step `stop_at`.
    cancelled,  ///< The user cancelled the run.
};

/// Whether only the last moment of a session or of a live run is written.
inline bool writes_one_moment(const RunRequest& request) {
    return request.session || request.present != nullptr;
}

/// Whether a film shows the run's steps, rather than its end from several sides or in several
/// slices.
bool films_steps(const RunRequest& request);

struct RunReport {
    RunStatus status = RunStatus::finished;
    /// The stage and step at which the run ended: "stage 'small', step 312 of 7000".
    std::string where;
    bool has_begun = false;                      ///< Whether there is anything to write.
    std::vector<std::filesystem::path> written;  ///< The written files, in the order of writing.
    std::vector<std::string> notes;             ///< Notes on the written files. Each is a sentence.
    std::int64_t steps = 0;                     ///< Steps taken by this run.
    double seconds = 0;                         ///< Seconds spent on stepping.
    std::optional<measure::Features> features;  ///< Empty if they were not requested.
    /// Remarks on the result. Each is a sentence. They were also passed to `control.warn`.
    std::vector<std::string> remarks;
};

/// Runs the script and writes the requested outputs. All outputs are checked before the first step.
/// After a cancel, the results so far are written. The text of a failure is a complete message. If
/// the failure is an error in the script, it is also in `script.diagnostics`.
Result<RunReport> run(Script& script, const RunRequest& request, RunControl& control);

/// Writes every field of the started stages as STAGE.NAME.npy, the script, and `run.json`. A saved
/// run in the same folder is replaced atomically (run/commands/saved_folder.h), so the earlier run
/// stays valid until the new one is complete. Fails without changing anything if the folder has a
/// file with one of these names that is not part of the saved run.
Result<std::vector<std::filesystem::path>> save_run(const std::filesystem::path& folder,
                                                    const Script& script,
                                                    const Simulation& simulation);

/// Checks before a run whether it can be saved in the folder.
Result<void> check_savable(const std::filesystem::path& folder, const Script& script);

/// Starts the stages of a saved run and restores their species. `script` must be the result of
/// load_saved_script() for this folder.
Result<void> restore_run(const std::filesystem::path& folder, const Script& script,
                         Simulation& simulation, const std::atomic<bool>& cancel = never_cancelled);

/// Loads the script and overrides of a saved run. `changes` may remove or set `steps` and
/// `until_stage`, permit folders to be read, and give a new path of the model. Files that the
/// script names are looked for in `script_folder` or, if that is empty, in find_script_folder(). If
/// `look` is not null, it replaces the saved script. It may differ from the saved script only in
/// pictures.
Result<Script> load_saved_script(const std::filesystem::path& folder, const Overrides& changes,
                                 const std::filesystem::path& script_folder = {},
                                 const Script* look = nullptr);

}  // namespace cascade
