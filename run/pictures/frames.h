// Frames: pictures at each interval, stored until their common range is known.
#pragma once

#include "core/result.h"
#include "run/pictures/painter.h"

#include <cstdint>
#include <filesystem>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace cascade {

/// Stores the values of frames in an unnamed temporary file, since those of a long run may not fit
/// into memory, and draws them at the end.
class FrameRecorder {
public:
    /// `folder` is for the pictures; empty for a space-time picture alone, whose rows are kept in
    /// memory.
    static Result<FrameRecorder> create(const std::filesystem::path& folder, bool space_time);

    /// Adds a frame. A full disk is remembered for failure().
    void record(const Canvas& canvas, const std::string& stage, std::int64_t step);
    std::optional<Failure> failure() const { return failure_; }
    /// True if no frame is of a stage that has taken a step.
    bool holds_starts_alone() const;

    /// Draws every frame as NUMBER-STAGE-STEP.png with one range for all, several at a time on at
    /// most this number of threads. They are written in their order: on failure there are those
    /// before the one that failed, and no others.
    Result<std::vector<std::filesystem::path>> write(Painter& painter, const PngTexts& texts,
                                                     int threads);

    /// The rows of a one-row grid, stacked vertically, the first frame at the top.
    Image space_time(Painter& painter) const;

private:
    struct Frame {
        std::string stage;
        std::int64_t step = 0;
        std::size_t planes = 1;
        bool has_relief = false;  ///< As an additional plane.
        PlaneLayout layout;
        std::shared_ptr<const DrawnCells> cells;  ///< Of a stage of cells that crawl.
    };
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    int threads_for(const Painter& painter, int threads) const;
    bool keep(const Field& field);
    Result<Canvas> read_back(const Frame& frame);

    std::filesystem::path folder_;
    bool keep_rows_ = false;
    std::unique_ptr<std::FILE, CloseFile> file_;
    std::vector<Frame> frames_;
    std::vector<Canvas> rows_;
    Spread values_;  ///< Of all frames.
    std::optional<Failure> failure_;
};

}  // namespace cascade
