// Computes positions in the file in binary64, in the same way as run/domain/file_places.cpp
// computes the positions of cells.
#include "run/domain/kernel_file.h"

#include "lang/program/evaluate.h"
#include "run/domain/file_places.h"

#include <array>
#include <span>
#include <utility>

namespace cascade {

namespace {

/// Evaluates a formula of numbers, a distance, and components of a direction.
double value_at(const Formula& formula, double distance, const std::array<double, 3>& direction) {
    double value = 0;
    const KnownValues known = [&](const Node& node, const OperandColumns& operands,
                                  std::span<double> values) {
        if (const auto* const lag = node.as<CellValue>()) {
            values[0] = *lag == CellValue::distance ? distance : 0;
            return true;
        }
        // The only vector in the formula is the direction. The second operand of component() is the
        // number of the axis.
        if (!node.calls(Function::component)) return false;
        values[0] = direction[static_cast<std::size_t>(operands[1][0])];
        return true;
    };
    evaluate(formula, known, {&value, 1});
    return value;
}

}  // namespace

KernelFile::KernelFile(const GreyPicture& picture, std::vector<Formula> place)
    : values_(picture.values.begin(), picture.values.end()),
      sides_{picture.width, picture.height, 1},
      place_(std::move(place)) {}

KernelFile::KernelFile(const NpyArray& array, std::vector<Formula> place)
    : values_(array.values),
      sides_{array.columns, array.rows, array.slices},
      place_(std::move(place)) {}

double KernelFile::at(double distance, const std::array<double, 3>& direction) const {
    FilePlace place{};
    for (std::size_t k = 0; k < place_.size(); ++k)
        place[k] = value_at(place_[k], distance, direction);
    return number_at_place(values_, sides_, place);
}

}  // namespace cascade
