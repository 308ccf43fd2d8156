// Finds the position of each cell in a picture or an array, and reads the numbers there.
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

/// A position in a file by three fractions from 0 to 1: of the width, counted from the left, of the
/// height, counted from the top, and of the depth, counted from the first slice.
using FilePlace = std::array<double, 3>;

/// Interpolates the number at a position in an array, linearly between the centres of elements.
/// Positions outside of 0 … 1 give the value at the nearest side. `values` are ordered by slices,
/// rows and columns. `sides` contains the numbers of columns, rows and slices.
double number_at_place(const std::vector<double>& values, std::array<std::int64_t, 3> sides,
                       const FilePlace& place);

/// How a position in a picture changes with steps along the surface or grid: with a short step to
/// the right, and with an equally long step downwards (surface/cell_frames.h). Only the ratio of
/// the changes is used, so the length of the steps does not matter.
struct FileSlopes {
    FilePlace right{}, down{};
};

/// Maps each cell of a domain to its position in a file. Cells of a grid are ordered row by row
/// through all slices. Cells of a model are in their own order. The model must outlive this object.
class FilePlaces {
public:
    /// Computes positions by formulas of the cell's position. Beyond 0 … 1 the file continues with
    /// the values at its side. `model` is null on grids.
    static FilePlaces by_formulas(std::vector<Formula> place, const Grid& grid,
                                  const ModelCells* model, bool with_slopes);
    /// Takes positions in a file whose sides coincide with the sides of the grid.
    static FilePlaces of_grid(const Grid& grid);
    /// Takes the texture coordinates of a model as positions. Beyond 0 … 1 the picture repeats.
    /// Fails if the model has no texture coordinates, and says how to make some.
    static Result<FilePlaces> of_texture(const ModelCells& model, const ModelSettings& settings,
                                         bool with_slopes);

    /// Returns the numbers of a picture at all positions, interpolated linearly between the centres
    /// of pixels.
    std::vector<double> numbers(const GreyPicture& picture) const;
    /// Returns the numbers of an array at all positions, interpolated linearly between the centres
    /// of elements. If positions have no slice, the array must have only one slice.
    std::vector<double> numbers(const NpyArray& array) const;
    /// Returns the angles of the directions that are painted in two channels of a picture. Red
    /// values 0 … 1 mean −1 … 1 to the right in the picture, and green values 0 … 1 mean −1 … 1
    /// upwards. Angles are measured on the surface or grid, from the right downwards. They are 0
    /// where both values are nearly ½ or where positions do not change. The positions must have
    /// slopes.
    std::vector<double> angles(const GreyPicture& red, const GreyPicture& green) const;

private:
    using Visit = std::function<void(const FilePlace& place, const FileSlopes& slopes)>;
    using ForEach = std::function<void(const Visit& visit)>;
    FilePlaces(ForEach each, bool repeats) : each_(std::move(each)), repeats_(repeats) {}
    template <typename Number>
    std::vector<double> numbers_of(const std::vector<Number>& values,
                                   std::array<std::int64_t, 3> sides) const;

    /// Computes positions again whenever they are needed, because storing them would take more
    /// memory than planes do.
    ForEach each_;
    bool repeats_;
};

/// Makes a plane from a number for each cell. `model` is null on grids.
Field plane_of(std::span<const double> numbers, const Grid& grid, const ModelCells* model,
               Precision precision);

}  // namespace cascade
