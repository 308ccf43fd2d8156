// Frames show moments of a run. All frames share one range of values, which is known only at the
// end of the run. So frames are stored until then.
#pragma once

#include "core/result.h"
#include "run/pictures/painter.h"
#include "run/pictures/proportions.h"

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

/// Stores the values of frames in an unnamed temporary file, because the frames of a long run may
/// not fit into memory. Draws the frames after the run.
class FrameRecorder {
public:
    /// If `keep_values` is true, stores values for pictures and films. If `space_time` is true,
    /// stores rows for a space-time picture in memory.
    static Result<FrameRecorder> create(bool keep_values, bool space_time);

    /// Adds a frame. If the disk is full, failure() reports this later. `label` is drawn into a
    /// corner of the picture if there is room for it.
    void record(const Canvas& canvas, const std::string& stage, std::int64_t step,
                std::string label = "");
    std::optional<Failure> failure() const { return failure_; }
    /// Whether every frame shows a stage before its first step.
    bool holds_starts_alone() const;

    std::size_t count() const { return frames_.size(); }
    /// Reads the values of a frame. Fails if they cannot be read from the file.
    Result<Canvas> canvas(std::size_t number) { return read_back(frames_[number]); }
    /// Returns the automatic range of the values of all frames.
    ValueRange range() const { return automatic_range(values_); }

    /// The part of the work on a picture that must be done in the order of the pictures. It runs
    /// after the same part for all earlier pictures has run.
    using InOrder = std::function<Result<void>()>;
    /// Processes the picture of frame `number`, and returns the work that must be done in order.
    /// Called on several threads at the same time.
    using UseImage = std::function<Result<InOrder>(std::size_t number, const Image& image)>;

    /// Draws the frames with the given ascending numbers. All frames have the same range. Draws
    /// several frames at the same time, on at most `threads` threads. Stops after a failure, and
    /// when `cancel` is set.
    Result<void> draw(Painter& painter, std::span<const std::size_t> numbers, int threads,
                      const std::atomic<bool>& cancel, const UseImage& use);

    /// Draws every frame into the folder as NUMBER-STAGE-STEP.png. After a failure, only the frames
    /// before the failed frame remain. Once `cancel` is set, no more frames are begun.
    Result<std::vector<std::filesystem::path>> write(const std::filesystem::path& folder,
                                                     Painter& painter, const PngTexts& texts,
                                                     int threads, const std::atomic<bool>& cancel);

    /// Returns the space-time picture of a grid of one row. Each frame is a row of pixels, and the
    /// first frame is at the top.
    Image space_time(Painter& painter) const;

private:
    struct Frame {
        PlaneScales scales{1, 1};  ///< See Canvas::scales.
        std::string stage;
        std::int64_t step = 0;
        std::string label;
        std::size_t planes = 1;
        /// The planes of extra_planes() that the file contains after the fields.
        std::bitset<2 + material_parts> extras;
        PlaneLayout layout;
        /// The position in the file, in bytes, at which the values of the frame begin.
        std::int64_t place = 0;
        /// The cells of a stage of crawling cells. Their vectors are empty, because the file
        /// contains the elements.
        std::shared_ptr<const DrawnCells> cells;
        /// The numbers of placements and colours in the file.
        std::size_t placements = 0, colours = 0;
        bool has_body = false;  ///< Whether the frame has a body (Canvas::body) in the file.
        /// The numbers of points and triangles of the body.
        std::size_t points = 0, triangles = 0;
    };
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    /// Processes the values of frame `number`, and returns the work that must be done in order.
    /// Called on several threads at the same time. Each thread has its own `image`, whose memory is
    /// reused from frame to frame.
    using UseCanvas =
        std::function<Result<InOrder>(std::size_t number, const Canvas& canvas, Image& image)>;
    Result<void> use_canvases(std::span<const std::size_t> numbers, int threads,
                              const std::atomic<bool>& cancel, const UseCanvas& use);
    void draw_one(Painter& painter, std::size_t number, const Canvas& canvas, Image& image) const;
    int threads_for(const Painter& painter, int threads) const;
    /// Whether any frame shows crawling cells.
    bool shows_cells() const;
    bool keep(const Field& field);
    bool keep_cells(const DrawnCells& cells, Frame& frame);
    bool keep_body(const SurfaceMesh& body, Frame& frame);
    template <typename T>
    bool keep_items(const std::vector<T>& items);
    template <typename T>
    bool read_items(std::vector<T>& items, std::size_t count);
    /// Reads a frame. Its fields reuse the memory of `planes`.
    Result<Canvas> read_back(const Frame& frame, std::vector<Field> planes = {});

    bool keep_rows_ = false;
    std::unique_ptr<std::FILE, CloseFile> file_;
    std::int64_t kept_ = 0;  ///< The number of bytes in the file.
    std::vector<Frame> frames_;
    std::vector<Canvas> rows_;
    PlaneScales largest_{0, 0};  ///< The largest scales of all frames.
    Spread values_;              ///< The spread of the values of all frames.
    std::optional<Failure> failure_;
};

}  // namespace cascade
