// The stored result of one run of a sweep: a small file of features, and the picture's values.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "measure/features.h"
#include "run/pictures/painter.h"
#include "run/script/script.h"
#include "run/stage/stage_state.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace cascade {

struct SweepResult {
    std::optional<measure::Features> features;  ///< Empty if the run failed.
    Canvas tile;  ///< The picture's values, averaged down; no fields if the run failed.
    /// Of the stage that is shown, if it is one of cells that crawl.
    std::optional<CellCounts> cells;
    std::int64_t steps = 0;  ///< Of all stages.
    std::string remark;      ///< The error or warnings of the run; one line, usually empty.

    bool failed() const { return !features; }
};

/// A hash of everything that a run's result depends on: the words of the script and of all files it
/// uses (without blanks and comments), overrides, the contents of the files that it reads, the
/// picture, the size of the tiles, and Cascade's version. 16 hexadecimal digits. The script must be
/// free of errors.
std::string key_of_run(const Script& script, const PictureRequest& picture, int tile_side);

/// Writes KEY.npy (planes of the tile, stacked vertically) and then KEY.json into `folder`, so that
/// an incomplete result is not read.
Result<void> write_result(const std::filesystem::path& folder, const std::string& key,
                          const SweepResult& result);

/// Nothing if there is no result of that key, or it is damaged.
std::optional<SweepResult> read_result(const std::filesystem::path& folder, const std::string& key);

/// An image, as a canvas of its colours that shrink() makes smaller.
Canvas canvas_of(const Image& image);

/// Every plane of a canvas, averaged over squares of cells so that no side is longer than `side`.
Canvas shrink(const Canvas& canvas, int side);

}  // namespace cascade
