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

/// Stores the values of frames in an unnamed temporary file, since a long run may not fit into
/// memory, and draws them at the end.
class FrameRecorder {
public:
    /// `keep_values` is for pictures and films. `space_time` is for a space-time picture, whose
    /// rows stay in memory.
    static Result<FrameRecorder> create(bool keep_values, bool space_time);

    /// Adds a frame. A full disk is remembered for failure(). `label` is drawn into a corner of its
    /// picture, if it is not empty and the picture has room.
    void record(const Canvas& canvas, const std::string& stage, std::int64_t step,
                std::string label = "");
    std::optional<Failure> failure() const { return failure_; }
    /// True if every frame shows a stage before its first step.
    bool holds_starts_alone() const;

    std::size_t count() const { return frames_.size(); }
    /// The values of a frame. Fails if they cannot be read back.
    Result<Canvas> canvas(std::size_t number) { return read_back(frames_[number]); }
    /// The range of all frames.
    ValueRange range() const { return automatic_range(values_); }

    /// The rest of a picture's work, done once the pictures before it are done.
    using InOrder = std::function<Result<void>()>;
    /// Takes the picture of frame `number`, on several threads at once.
    using UseImage = std::function<Result<InOrder>(std::size_t number, const Image& image)>;

    /// Draws frames, whose numbers rise, with one range for all, several at a time on at most this
    /// number of threads. After a failure, and once `cancel` is set, no more are done.
    Result<void> draw(Painter& painter, std::span<const std::size_t> numbers, int threads,
                      const std::atomic<bool>& cancel, const UseImage& use);

    /// Draws every frame as NUMBER-STAGE-STEP.png into the folder. A failure leaves only the frames
    /// before the failed one.
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
        std::bitset<2 + material_parts> extras;  ///< The extra_planes() that follow.
        PlaneLayout layout;
        std::int64_t place = 0;  ///< The offset of its values in the file, in bytes.
        /// For a stage of crawling cells. Vectors with an entry for each of them are in the file.
        std::shared_ptr<const DrawnCells> cells;
        std::size_t placements = 0, colours = 0;  ///< The lengths of its vectors.
        bool has_body = false;                    ///< Canvas::body is in the file.
        std::size_t points = 0, triangles = 0;    ///< The body's counts.
    };
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    /// Takes the values of frame `number`, on several threads at once. Each thread has its own
    /// `image`, which keeps its memory from frame to frame.
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
    /// Fields may be made in the memory of other planes.
    Result<Canvas> read_back(const Frame& frame, std::vector<Field> planes = {});

    bool keep_rows_ = false;
    std::unique_ptr<std::FILE, CloseFile> file_;
    std::int64_t kept_ = 0;  ///< Bytes in the file.
    std::vector<Frame> frames_;
    std::vector<Canvas> rows_;
    Spread values_;  ///< For all frames.
    std::optional<Failure> failure_;
};

}  // namespace cascade
