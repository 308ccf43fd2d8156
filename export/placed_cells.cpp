// Writes the same arrays in both formats.
#include "export/placed_cells.h"

#include "core/check.h"
#include "core/write_encoded.h"
#include "export/cell_writer.h"
#include "export/npz_arrays.h"
#include "export/vtp.h"

#include <array>

namespace cascade {

namespace {

void check(const PlacedCells& cells) {
    const std::size_t count = cells.places.size();
    CHECK(cells.frames.size() == count && cells.radii.size() == count,
          "each cell has a frame and a radius");
    CHECK(cells.colours.empty() || cells.colours.size() == count,
          "there is a colour for each cell");
    for (const Channel& channel : cells.channels) {
        CHECK(channel.values.size() == count, "a channel has a number for each cell");
    }
}

}  // namespace

Result<std::string> encode_npz(const PlacedCells& cells) {
    check(cells);
    const std::size_t count = cells.places.size();
    NpzArrays arrays;
    arrays.add_vectors("points", cells.places);
    arrays.add<double>("frames", "<f8", count, 4, [&](std::size_t row, std::size_t column) {
        const Quaternion& q = cells.frames[row];
        return std::array{q.w, q.x, q.y, q.z}[column];
    });
    arrays.add<double>("radii", "<f8", count, 1,
                       [&](std::size_t row, std::size_t) { return cells.radii[row]; });
    if (!cells.colours.empty()) arrays.add_colours("colors", cells.colours);
    arrays.add_channels(cells.channels, {"points", "frames", "radii", "colors"});
    return encode_zip(arrays.entries());
}

std::string encode_vtp(const PlacedCells& cells) {
    check(cells);
    std::vector<Vector3d> normals;
    for (const Quaternion& frame : cells.frames) normals.push_back(turned(frame, {0, 1, 0}));
    VtpPoints points;
    points.places = cells.places;
    points.normals = normals;
    points.colours = cells.colours;
    points.radii = cells.radii;
    points.frames = cells.frames;
    points.channels = cells.channels;
    return encode_vtp(points);
}

Result<void> write_cells(const std::filesystem::path& path, const PlacedCells& cells) {
    return write_encoded(path, [&] { return encode_cells(path, cells); });
}

}  // namespace cascade
