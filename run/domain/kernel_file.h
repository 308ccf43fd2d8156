// A file with the weights of a convolution's kernel.
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
    /// `place` is the position of a lag's weight in the file: formulas of numbers, distance and
    /// direction (FileReading::place).
    KernelFile(const GreyPicture& picture, std::vector<Formula> place);
    KernelFile(const NpyArray& array, std::vector<Formula> place);

    /// The number at a lag. `distance` is its length in the script's unit, and `direction` a unit
    /// vector. Interpolated as in FilePlaces.
    double at(double distance, const std::array<double, 3>& direction) const;

private:
    std::vector<double> values_;  ///< Slices of rows of columns.
    std::array<std::int64_t, 3> sides_;
    std::vector<Formula> place_;
};

}  // namespace cascade
