// Writes the outputs of a run: pictures, models, frames, the log, a volume and the saved run.
#pragma once

#include "core/file_format.h"
#include "film/film_frame.h"
#include "picture/drawing.h"
#include "run/commands/run.h"
#include "run/pictures/frames.h"
#include "run/pictures/model_files.h"
#include "run/pictures/series.h"
#include "run/pictures/shown_files.h"

#include <functional>
#include <span>

namespace cascade {

class FilmCrew;

/// Everything that a finished or cancelled run has recorded.
struct RunResults {
    const Script& script;
    const RunRequest& request;
    RunControl& control;
    const std::vector<std::filesystem::path>& outputs;  ///< The paths of option -o.
    const Simulation& simulation;
    /// The run in the script's own cells, which is saved. With --detail, `script` and `simulation`
    /// above have smaller cells.
    struct {
        const Script& script;
        const Simulation& simulation;
    } own;
    /// Texture coordinates that were made for the model. May be empty.
    const MeshTexture& texture;
    Painter& painter;
    /// A painter for each panel of figures. If empty, figures show the picture.
    std::span<Painter> panels;
    FrameRecorder* frames;  ///< Null if no frames are recorded.
    /// Frames that an earlier run has written to the folder of frames.
    const std::vector<std::filesystem::path>& earlier_frames;
    RunLog* log;           ///< Null without --log.
    SeriesWriter* series;  ///< Null without --series.
    RunReport& report;     ///< Receives the paths of the written files.

    /// The outputs that are written before pictures, because drawing may fail or be interrupted:
    /// the saved run and, after a cancel, all numbers.
    struct Early {
        Result<void> saved, numbers;
        bool has_numbers = false;
    };
    Early write_early();
    /// Writes all other requested outputs. Pictures show the painter's last canvas. If one output
    /// fails, the others are still written. Returns the first failure, which may be one of `early`.
    Result<void> write(const Canvas& canvas, const Early& early);
    /// Writes only the log. The run must have a log.
    Result<void> write_log();

private:
    Result<void> write_outputs(const Canvas& canvas);
    Result<void> write_final_picture(const std::filesystem::path& path, const Canvas& canvas);
    /// Draws a canvas as a picture for the file `path`. If Ctrl-C stops the drawing, the result is
    /// empty, and a note in the report says that `what` was left out and which part of it had been
    /// drawn.
    std::optional<Image> drawn(const Canvas& canvas, const std::string& what,
                               const std::filesystem::path& path);
    /// Returns the flag that stops drawing. Ctrl-C sets it or, if the run was already cancelled,
    /// the need to end soon.
    const std::atomic<bool>& stop() const {
        return report.status == RunStatus::cancelled ? control.hurry : control.cancel;
    }
    void note_stop(const std::string& where);
    bool is_left_out(const std::string& what);
    Result<void> save();
    Result<void> write_numbers();
    Result<void> write_turntable(const std::filesystem::path& path, const Canvas& canvas);
    View turned_view(std::size_t number, std::size_t count) const;
    void warn_of(const std::vector<std::string>& warnings) const;
    Result<void> write_each(const FileWriter& write_one);
    Result<void> write_shown_files(const Canvas& canvas);
    Result<void> write_growth(const std::filesystem::path& path);
    bool shows_number(const Canvas& canvas) const;
    bool has(FormatKind kind) const;
    void say(std::string what) const;
    Result<void> write_frames();
    Result<void> write_figure(const std::filesystem::path& path, const Canvas& canvas);
    Drawing figure_of(Painter& of, const Canvas& canvas, const std::string& title) const;
    Result<void> write_films(const Canvas& canvas);
    Result<void> film_frames(FilmCrew& crew);
    Result<void> film_turntable(FilmCrew& crew, const Canvas& canvas);
    Result<void> film_slices(FilmCrew& crew);
    Result<void> film_end(FilmCrew& crew, int count,
                          const std::function<Result<FilmFrame>(std::size_t number)>& draw);
    void note_end_of_films(const FilmCrew& crew, std::size_t count);
    int drawing_threads() const;
    Result<void> write_volume();
    Result<void> write_series();
    Result<void> write_picture(const std::filesystem::path& path, const Image& image);
    PngTexts texts(const PictureRequest& picture) const;
};

}  // namespace cascade
