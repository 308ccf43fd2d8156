// What is kept of one run of a sweep: a small file of features, and the picture's values.
#pragma once

#include "core/plane.h"
#include "core/result.h"
#include "measure/features.h"
#include "run/pictures/painter.h"
#include "run/script/script.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace cascade {

struct SweepResult {
    std::optional<measure::Features> features;  ///< Empty where the run failed.
    Canvas tile;             ///< What the picture shows, made small; no fields where it failed.
    std::int64_t steps = 0;  ///< Of all stages.
    std::string remark;      ///< Why it failed, or what it warned of; one line, mostly empty.

    bool failed() const { return !features; }
};

/// A key of all that a run's result depends on: the words of the script and of all it uses (not
/// its blanks and comments), the changes from outside, the contents of the files that it reads,
/// what is shown, the size of the tiles, Cascade's version. 16 hexadecimal digits. The script must
/// be right.
std::string key_of_run(const Script& script, const PictureRequest& picture, int tile_side);

/// Writes KEY.npy (planes of the tile below each other) and KEY.json into `folder`; the latter
/// last, so that half a result is none.
Result<void> write_result(const std::filesystem::path& folder, const std::string& key,
                          const SweepResult& result);

/// Nothing where there is no result of that key, or it is damaged.
std::optional<SweepResult> read_result(const std::filesystem::path& folder, const std::string& key);

/// Every plane of a canvas, its cells averaged by squares so that no side is above `side`.
Canvas shrink(const Canvas& canvas, int side);

}  // namespace cascade
