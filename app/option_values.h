// Parsers for values of command-line options. Failures say what the option takes.
#pragma once

#include "core/file_format.h"
#include "core/result.h"
#include "picture/image.h"
#include "picture/slice.h"
#include "run/commands/run.h"
#include "run/domain/describe_model.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// A whole number within [low, high], written with digits only.
Result<std::int64_t> parse_whole(std::string_view text, std::int64_t low, std::int64_t high);

/// "256x128" is 256 columns of 128 rows; "60" is one row of 60 cells.
Result<GridSize> parse_grid(std::string_view text);

/// "600" cells, 1 … 10⁹, spread over a surface; "faces" or "vertices" of a model.
Result<CellOptions> parse_cells(std::string_view text);

/// "z=0.5": a slice across an axis, 0 … 1 along it.
Result<Slice> parse_slice(std::string_view text);

/// "0,8": two different finite numbers. If the first is larger the palette is reversed.
Result<ValueRange> parse_range(std::string_view text);

/// "30,25": degrees around, −360 … 360, and above the horizon, −89 … 89.
Result<View> parse_view(std::string_view text);
/// "1920x1080"; each at least 1.
Result<PictureSize> parse_picture_size(std::string_view text);
Result<PictureCopies> parse_copies(std::string_view text);
/// Degrees, 1 … 120.
Result<float> parse_fov(std::string_view text);
Result<double> parse_texels(std::string_view text);

/// "large:12000": a stage and a number of steps.
Result<StopAt> parse_stop_at(std::string_view text);
/// "4,2": tiles of four steps, two rows or slices a layer; "1,1": no tiling.
Result<Tiling> parse_tiling(std::string_view text);

/// "10": a time of a run, more than 0.
Result<double> parse_time(std::string_view text);
/// "1,2,5,10": times that rise.
Result<std::vector<double>> parse_times(std::string_view text);

/// "90s", "20m", "1.5h", "2d" or "90": seconds, more than 0 and at most ten years.
Result<double> parse_duration(std::string_view text);
/// "0.5", "2s": seconds to measure for, 0.001 … 3600.
Result<double> parse_measuring_time(std::string_view text);
/// "12.5": frames of a film in a second.
Result<double> parse_frame_rate(std::string_view text);
/// "8", "2m": seconds that a film lasts, 0.1 … 3600.
Result<double> parse_film_length(std::string_view text);
/// "2 h", "1.5 min", "90 s".
std::string describe_duration(double seconds);

/// "500MB", "2GB", "1.5GiB", "800KB" or bytes; at least a megabyte.
Result<std::uint64_t> parse_size(std::string_view text);

/// "p,q" as a list; fails if a name is empty.
Result<std::vector<std::string>> parse_names(std::string_view text);

/// One of `choices`; a failure lists them and suggests the nearest one.
Result<std::string> parse_choice(std::string_view text, std::span<const std::string> choices);

/// "0.02": the largest displacement of a surface, as a part of the model's longest side, −1 … 1.
Result<float> parse_bump(std::string_view text);

/// The path of an output of `run -o`; see output_kind() for the endings.
Result<std::string> parse_output_path(std::string_view text);
/// A text that is not empty.
Result<std::string> any_text(std::string_view text);
/// The path of a folder that is written; it must not end as an output of `run -o` does.
Result<std::string> parse_folder(std::string_view text);
/// A folder for frames; a number alone is refused, since it was meant as the number of frames.
Result<std::string> parse_frames_folder(std::string_view text);
/// The path of a file whose name ends as those of its kind do.
Result<std::string> parse_path_of(FormatKind kind, std::string_view text);

}  // namespace cascade
