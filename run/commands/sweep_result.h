// Stores the result of one run of a sweep: a small file of features, and the picture's values.
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
#include <string_view>

namespace cascade {

struct SweepResult {
    std::optional<measure::Features> features;  ///< Empty if the run failed.
    /// The picture's values, averaged over squares of cells. The tile has no fields if the run
    /// failed.
    Canvas tile;
    /// The numbers of cells, if the shown stage has crawling cells.
    std::optional<CellCounts> cells;
    std::int64_t steps = 0;  ///< The sum over all stages.
    std::string log;         ///< The table of RunLog, also if the run failed. Empty without --log.
    std::string remark;      ///< The error or the warnings of the run, in one line. Usually empty.

    bool failed() const { return !features; }
};

/// A hash of everything that determines a run's result, as 16 hexadecimal digits. This includes the
/// words of the script and of all files that it uses (without blanks and comments), the overrides,
/// the contents of the files that it reads, the request for the picture, the size of the tiles,
/// what is logged, and Cascade's version. The script must have no errors.
std::string key_of_run(const Script& script, const PictureRequest& picture, int tile_side,
                       const std::string& logged = "");

/// Writes KEY.npy, which contains the planes of the tile one below the other, and then KEY.json. A
/// result without KEY.json is incomplete and is not read.
Result<void> write_result(const std::filesystem::path& folder, const std::string& key,
                          const SweepResult& result);

/// Reads the result with this key. Returns an empty optional if there is no result, or if it is
/// damaged.
std::optional<SweepResult> read_result(const std::filesystem::path& folder, const std::string& key);

/// Packs a result into bytes for another process of the same build.
std::string pack_result(const SweepResult& result);
/// Unpacks a result that pack_result() has packed. Returns an empty optional if the bytes are
/// damaged.
std::optional<SweepResult> unpack_result(std::string_view bytes);

/// Makes a canvas of the colours of an image, so that shrink() can reduce it.
Canvas canvas_of(const Image& image);

/// Averages every plane of a canvas over squares of cells. The squares are as large as needed so
/// that no side of the result is longer than `side`.
Canvas shrink(const Canvas& canvas, int side);

}  // namespace cascade
