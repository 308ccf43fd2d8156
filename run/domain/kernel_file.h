// A file from which the kernel of a convolution takes its weights.
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
    /// The place in the file where a lag has its weight: formulas of numbers, distance and
    /// direction (FileReading::place).
    KernelFile(const GreyPicture& picture, std::vector<Formula> place);
    KernelFile(const NpyArray& array, std::vector<Formula> place);

    /// The number at a lag, of which `distance` is the length, in the script's unit, and
    /// `direction` a unit vector. Interpolated as FilePlaces does.
    double at(double distance, const std::array<double, 3>& direction) const;

private:
    std::vector<double> values_;  ///< Slices of rows of columns.
    std::array<std::int64_t, 3> sides_;
    std::vector<Formula> place_;
};

}  // namespace cascade
