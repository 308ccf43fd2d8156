// Frames: moments of a run, stored until the range of all of them is known.
#pragma once

#include "core/result.h"
#include "run/pictures/painter.h"

#include <atomic>
#include <bitset>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Stores the values of frames in an unnamed temporary file, since those of a long run may not fit
/// into memory, and draws them at the end.
class FrameRecorder {
public:
    /// `keep_values` is for pictures and films; `space_time` for a space-time picture, whose rows
    /// are kept in memory.
    static Result<FrameRecorder> create(bool keep_values, bool space_time);

    /// Adds a frame. A full disk is remembered for failure().
    /// `label` is drawn into a corner of its picture, if it is not empty and the picture has room.
    void record(const Canvas& canvas, const std::string& stage, std::int64_t step,
                std::string label = "");
    std::optional<Failure> failure() const { return failure_; }
    /// True if no frame is of a stage that has taken a step.
    bool holds_starts_alone() const;

    std::size_t count() const { return frames_.size(); }
    /// The values of a frame. Fails if they cannot be read back.
    Result<Canvas> canvas(std::size_t number) { return read_back(frames_[number]); }
    /// The range of all frames.
    ValueRange range() const { return automatic_range(values_); }

    /// What remains to be done with a picture once those before it are done.
    using InOrder = std::function<Result<void>()>;
    /// Takes the picture of frame `number`, on several threads at once.
    using UseImage = std::function<Result<InOrder>(std::size_t number, const Image& image)>;

    /// Draws frames, whose numbers rise, with one range for all, several at a time on at most this
    /// number of threads. After a failure, and once `cancel` is set, no more are done.
    Result<void> draw(Painter& painter, std::span<const std::size_t> numbers, int threads,
                      const std::atomic<bool>& cancel, const UseImage& use);

    /// Draws every frame as NUMBER-STAGE-STEP.png into the folder. On failure there are those
    /// before the one that failed, and no others.
    Result<std::vector<std::filesystem::path>> write(const std::filesystem::path& folder,
                                                     Painter& painter, const PngTexts& texts,
                                                     int threads);

    /// The rows of a one-row grid, stacked vertically, the first frame at the top.
    Image space_time(Painter& painter) const;

private:
    struct Frame {
        std::string stage;
        std::int64_t step = 0;
        std::string label;
        std::size_t planes = 1;
        std::bitset<2 + material_parts> extras;  ///< Which of extra_planes() follow.
        PlaneLayout layout;
        std::int64_t place = 0;  ///< Of its values in the file, in bytes.
        /// Of a stage of cells that crawl; the vectors with an entry for each of them are in the
        /// file.
        std::shared_ptr<const DrawnCells> cells;
        std::size_t placements = 0, colours = 0;  ///< The lengths of these vectors.
        bool has_body = false;                    ///< Canvas::body is in the file, …
        std::size_t points = 0, triangles = 0;    ///< … with these.
    };
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    /// Takes the values of frame `number`, on several threads at once. `image` is its own for each
    /// thread, and keeps its memory from frame to frame.
    using UseCanvas =
        std::function<Result<InOrder>(std::size_t number, const Canvas& canvas, Image& image)>;
    Result<void> use_canvases(std::span<const std::size_t> numbers, int threads,
                              const std::atomic<bool>& cancel, const UseCanvas& use);
    void draw_one(Painter& painter, std::size_t number, const Canvas& canvas, Image& image) const;
    int threads_for(const Painter& painter, int threads) const;
    /// Is a frame of cells that crawl among them?
    bool shows_cells() const;
    bool keep(const Field& field);
    bool keep_cells(const DrawnCells& cells, Frame& frame);
    bool keep_body(const SurfaceMesh& body, Frame& frame);
    template <typename T>
    bool keep_items(const std::vector<T>& items);
    template <typename T>
    bool read_items(std::vector<T>& items, std::size_t count);
    /// Fields may be made in the memory of other planes.
    Result<Canvas> read_back(const Frame& frame, std::vector<Field> planes = {});

    bool keep_rows_ = false;
    std::unique_ptr<std::FILE, CloseFile> file_;
    std::int64_t kept_ = 0;  ///< Bytes in the file.
    std::vector<Frame> frames_;
    std::vector<Canvas> rows_;
    Spread values_;  ///< Of all frames.
    std::optional<Failure> failure_;
};

}  // namespace cascade
