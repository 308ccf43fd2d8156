// Parsers for the values of command-line options. A failure says which values the option accepts.
#pragma once

#include "core/file_format.h"
#include "core/result.h"
#include "picture/image.h"
#include "picture/slice.h"
#include "run/commands/run.h"
#include "run/commands/sweep.h"
#include "run/domain/describe_model.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade {

/// Parses an integer from `low` to `high`, written with digits only.
Result<std::int64_t> parse_whole(std::string_view text, std::int64_t low, std::int64_t high);

/// Parses a grid. "256x128" has 256 columns and 128 rows, and "60" has one row of 60 cells.
Result<GridSize> parse_grid(std::string_view text);

/// Parses the setting of cells. "600" means 600 cells that are spread over a surface, and any
/// number from 1 to 10⁹ is accepted. "faces" and "vertices" mean a cell on each face or vertex of a
/// model.
Result<CellOptions> parse_cells(std::string_view text);

/// Parses a slice. "z=0.5" is perpendicular to the z axis, at half of its length. Positions are
/// from 0 to 1.
Result<Slice> parse_slice(std::string_view text);

/// Parses two different finite numbers, "0,8". If the first number is larger, the palette is
/// reversed.
Result<ValueRange> parse_range(std::string_view text);

/// Parses a direction of view, "30,25". The first number is an angle around the object, −360 … 360
/// degrees. The second number is the angle above the horizon, −89 … 89 degrees.
Result<View> parse_view(std::string_view text);
/// Parses the size of a picture, "1920x1080". Each number is at least 1.
Result<PictureSize> parse_picture_size(std::string_view text);
Result<PictureCopies> parse_copies(std::string_view text);
/// Parses a field of view in degrees, 1 … 120.
Result<float> parse_fov(std::string_view text);
Result<double> parse_texels(std::string_view text);

/// Parses the choice of a device: "gpu", "cpu", a number, or "list".
Result<std::string> parse_device(std::string_view text);
/// Parses a stage and a number of steps, "large:12000".
Result<StopAt> parse_stop_at(std::string_view text);
/// A path that ends in .h5.
Result<std::string> parse_data_path(std::string_view text);
/// Parses "3/100", the third of a hundred parts of a sweep.
Result<SweepPart> parse_part(std::string_view text);
/// Parses a tiling. "4,2" has tiles of four steps, and layers of two rows or slices. "1,1" has
/// no tiles.
Result<Tiling> parse_tiling(std::string_view text);

/// Parses a time of a run, "10" or "10 min", which must be above 0.
Result<GivenTimes> parse_time(std::string_view text);
/// Parses ascending times, "1,2,5,10" or "1,2,5,10 min".
Result<GivenTimes> parse_times(std::string_view text);

/// Parses a duration in seconds: "90s", "20m", "1.5h", "2d" or "90". It must be above 0 and at most
/// ten years.
Result<double> parse_duration(std::string_view text);
/// Parses seconds for measuring, "0.5" or "2s". They must be from 0.001 to 3600.
Result<double> parse_measuring_time(std::string_view text);
/// Parses the frames per second of a film, "12.5".
Result<double> parse_frame_rate(std::string_view text);
/// Parses the length of a film in seconds, "8" or "2m". It must be from 0.1 to 3600 seconds.
Result<double> parse_film_length(std::string_view text);
/// Prints a duration: "2 h", "1.5 min", "90 s".
std::string describe_duration(double seconds);

/// Parses a number of bytes: "500MB", "2GB", "1.5GiB", "800KB" or a number without a unit. It must
/// be at least a megabyte.
Result<std::uint64_t> parse_size(std::string_view text);

/// Parses a list of names, "p,q". Fails if a name is empty.
Result<std::vector<std::string>> parse_names(std::string_view text);

/// Parses one of `choices`. A failure lists all choices and suggests the nearest one.
Result<std::string> parse_choice(std::string_view text, std::span<const std::string> choices);

/// Parses the largest displacement of a surface, "0.02". It is a fraction of the model's longest
/// side, from −1 to 1.
Result<float> parse_bump(std::string_view text);

/// Parses the path of an output of `run -o`. output_kind() knows the valid endings.
Result<std::string> parse_output_path(std::string_view text);
/// Accepts any text that is not empty.
Result<std::string> any_text(std::string_view text);
/// Whether a path ends like the name of a file, in a format that Cascade writes or in another
/// format that newcomers may try.
bool has_ending_of_file(const std::filesystem::path& path);
/// Parses the path of a folder for output. The path must not end like the name of a file
/// (has_ending_of_file()).
Result<std::string> parse_folder(std::string_view text);
/// Parses the path of a folder for frames. A number is refused, because it was probably meant as
/// the number of frames.
Result<std::string> parse_frames_folder(std::string_view text);
/// Parses the path of a file. Its ending must belong to a format of the given kind.
Result<std::string> parse_path_of(FormatKind kind, std::string_view text);

}  // namespace cascade
