// Positions in a picture or an array for the cells of a domain, and the numbers there.
#pragma once

#include "core/grid.h"
#include "core/plane.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "picture/grey_picture.h"
#include "picture/npy.h"
#include "run/domain/model_cells.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace cascade {

/// A position in a file, 0 … 1 from the left, from the top and from the first slice.
using FilePlace = std::array<double, 3>;

/// The number at a position of an array of slices of rows of columns, interpolated linearly between
/// the middles of elements. Beyond 0 … 1 as at the side. `sides` counts columns, rows and slices.
double number_at_place(const std::vector<double>& values, std::array<std::int64_t, 3> sides,
                       const FilePlace& place);

/// The change of a position in a picture along the surface or the grid: by a step to the right and
/// by one downwards (surface/cell_frames.h). The unit of steps does not matter.
struct FileSlopes {
    FilePlace right{}, down{};
};

/// The file positions of all cells of a domain: for a grid row by row through all slices, for a
/// model, which must outlive them, in the cells' own order.
class FilePlaces {
public:
    /// Computed by formulas of the cell's position. Beyond 0 … 1 the file continues as at its side.
    /// `model` is null on grids.
    static FilePlaces by_formulas(std::vector<Formula> place, const Grid& grid,
                                  const ModelCells* model, bool with_slopes);
    /// A grid cell's position, where each side of the grid is a side of the file.
    static FilePlaces of_grid(const Grid& grid);
    /// The texture coordinates of a model, beyond which the picture repeats. If the model has none,
    /// fails and says how to make some.
    static Result<FilePlaces> of_texture(const ModelCells& model, const ModelSettings& settings,
                                         bool with_slopes);

    /// Interpolated linearly between the centres of pixels.
    std::vector<double> numbers(const GreyPicture& picture) const;
    /// The same between the elements of an array, which has one slice if positions have none.
    std::vector<double> numbers(const NpyArray& array) const;
    /// The angles, from the right downwards on the surface or grid, of directions painted in two
    /// channels of a picture: 0 … 1 means −1 … 1 to the right and upwards in the picture. 0 where
    /// both are nearly ½ or where the positions do not change. There must be slopes.
    std::vector<double> angles(const GreyPicture& red, const GreyPicture& green) const;

private:
    using Visit = std::function<void(const FilePlace& place, const FileSlopes& slopes)>;
    using ForEach = std::function<void(const Visit& visit)>;
    FilePlaces(ForEach each, bool repeats) : each_(std::move(each)), repeats_(repeats) {}
    template <typename Number>
    std::vector<double> numbers_of(const std::vector<Number>& values,
                                   std::array<std::int64_t, 3> sides) const;

    ForEach each_;  ///< Computes positions, which would take more memory than planes.
    bool repeats_;
};

/// The numbers of cells as a plane. `model` is null on grids.
Field plane_of(std::span<const double> numbers, const Grid& grid, const ModelCells* model,
               Precision precision);

}  // namespace cascade
