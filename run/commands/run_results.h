// The outputs of a run: pictures, models, frames, the log, a volume and the saved run.
#pragma once

#include "core/file_format.h"
#include "film/film_frame.h"
#include "picture/drawing.h"
#include "run/commands/run.h"
#include "run/pictures/frames.h"
#include "run/pictures/model_files.h"
#include "run/pictures/series.h"
#include "run/pictures/written_files.h"

#include <functional>
#include <span>

namespace cascade {

class FilmCrew;

/// A run whose stages have ended or were cancelled, with everything that it recorded.
struct RunResults {
    const Script& script;
    const RunRequest& request;
    RunControl& control;
    const std::vector<std::filesystem::path>& outputs;  ///< Of -o.
    const Simulation& simulation;
    /// What is saved: the run of the script's own cells, where the others show finer ones.
    struct {
        const Script& script;
        const Simulation& simulation;
    } own;
    const MeshTexture& texture;  ///< That was made for the model; may be empty.
    Painter& painter;
    std::span<Painter> panels;                                 ///< Of figures; empty: the picture.
    FrameRecorder* frames;                                     ///< Null without frames.
    const std::vector<std::filesystem::path>& earlier_frames;  ///< In the folder of frames.
    RunLog* log;                                               ///< Null without --log.
    SeriesWriter* series;                                      ///< Null without --series.
    RunReport& report;                                         ///< Gets the paths of files.

    /// Saves the run, if that was requested.
    Result<void> save();
    /// Writes everything else that was requested, pictures from the painter's last canvas. An
    /// output that fails does not prevent the others; returns the first failure, of `saved`, too.
    Result<void> write(const Canvas& canvas, const Result<void>& saved);
    /// Writes only the log. There must be one.
    Result<void> write_log();

private:
    Result<void> write_outputs(const Canvas& canvas);
    Result<void> write_final_picture(const std::filesystem::path& path, const Canvas& canvas);
    /// The picture of a canvas for a file; `what` is said with the part that is drawn. Nothing,
    /// with a note in the report, if Ctrl-C stops it.
    std::optional<Image> drawn(const Canvas& canvas, const std::string& what,
                               const std::filesystem::path& path);
    /// Set by a Ctrl-C that has not ended the run before.
    const std::atomic<bool>& stop() const {
        return report.status == RunStatus::cancelled ? never_cancelled : control.cancel;
    }
    void note_stop(std::string where);
    Result<void> write_turntable(const std::filesystem::path& path, const Canvas& canvas);
    View turned_view(std::size_t number, std::size_t count) const;
    void warn_of(const std::vector<std::string>& warnings) const;
    Result<void> write_each(
        const std::function<Result<WrittenFiles>(const std::filesystem::path&)>& write_one);
    Result<void> write_model_files(const Canvas& canvas);
    Result<void> write_growth(const std::filesystem::path& path);
    Result<void> write_cell_files(const Canvas& canvas);
    Result<void> write_body_files(const Canvas& canvas);
    Result<void> write_plane_files(const Canvas& canvas);
    std::vector<Channel> channels(const Canvas& canvas) const;
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
