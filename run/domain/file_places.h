// Where in a picture or an array the cells of a domain find their numbers, and what they find.
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

/// A place in a file, 0 … 1 from the left, from the top and from the first slice.
using FilePlace = std::array<double, 3>;

/// The number at a place of an array of slices of rows of columns, interpolated linearly between
/// the middles of elements; beyond 0 … 1 as at the side. `sides` counts columns, rows and slices.
double number_at_place(const std::vector<double>& values, std::array<std::int64_t, 3> sides,
                       const FilePlace& place);

/// How a place in a picture changes along the surface or the grid: by a step to the right and by
/// one downwards (surface/cell_frames.h). The unit of steps does not matter.
struct FileSlopes {
    FilePlace right{}, down{};
};

/// The places of all cells of a domain: of a grid row by row through all slices, of a model, which
/// must outlive them, in their own order.
class FilePlaces {
public:
    /// By formulas of where the cell is. Beyond 0 … 1 the file goes on as at its side. `model` is
    /// null on grids.
    static FilePlaces by_formulas(std::vector<Formula> place, const Grid& grid,
                                  const ModelCells* model, bool with_slopes);
    /// Where a grid's cell is, each side of the grid being a side of the file.
    static FilePlaces of_grid(const Grid& grid);
    /// By the texture coordinates of a model, beyond which the picture repeats. Fails, and says
    /// what makes some, if the model has none.
    static Result<FilePlaces> of_texture(const ModelCells& model, const ModelSettings& settings,
                                         bool with_slopes);

    /// Interpolated linearly between the centres of pixels.
    std::vector<double> numbers(const GreyPicture& picture) const;
    /// The same between the elements of an array, whose slices are one if places have none.
    std::vector<double> numbers(const NpyArray& array) const;
    /// The angles, from the right downwards on the surface or grid, of the directions that two
    /// channels of a picture paint: 0 … 1 are −1 … 1 to the right and upwards in the picture. 0
    /// where both are nearly ½ or where the places do not change. There must be slopes.
    std::vector<double> angles(const GreyPicture& red, const GreyPicture& green) const;

private:
    using Visit = std::function<void(const FilePlace& place, const FileSlopes& slopes)>;
    using ForEach = std::function<void(const Visit& visit)>;
    FilePlaces(ForEach each, bool repeats) : each_(std::move(each)), repeats_(repeats) {}
    template <typename Number>
    std::vector<double> numbers_of(const std::vector<Number>& values,
                                   std::array<std::int64_t, 3> sides) const;

    ForEach each_;  ///< Places are not kept: they take more memory than planes.
    bool repeats_;
};

/// The numbers of cells as a plane; `model` is null on grids.
Field plane_of(std::span<const double> numbers, const Grid& grid, const ModelCells* model,
               Precision precision);

}  // namespace cascade
