// Reads the weights of a convolution's kernel from a file.
#pragma once

#include "lang/program/program.h"
#include "picture/grey_picture.h"
#include "picture/npy.h"

#include <array>
#include <cstdint>
#include <vector>

namespace cascade {

class KernelFile {
public:
    /// `place` contains formulas for a position in the file. They map a lag, which is a
    /// displacement between two cells, to the position of its weight. The formulas contain numbers,
    /// and the distance and direction of the lag (FileReading::place).
    KernelFile(const GreyPicture& picture, std::vector<Formula> place);
    KernelFile(const NpyArray& array, std::vector<Formula> place);

    /// Returns the weight of a lag, interpolated as in FilePlaces. `distance` is the length of the
    /// lag in the script's unit, and `direction` is its unit vector.
    double at(double distance, const std::array<double, 3>& direction) const;

private:
    std::vector<double> values_;  ///< Ordered by slices, rows and columns.
    std::array<std::int64_t, 3> sides_;
    std::vector<Formula> place_;
};

}  // namespace cascade
