// Places are computed in binary64, like those in files that cells read.
#include "run/domain/kernel_file.h"

#include "core/check.h"
#include "core/overloaded.h"
#include "lang/program/fold.h"
#include "run/domain/file_places.h"

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// The value of a formula of numbers, of a distance, and of components of a direction.
double value_at(const Formula& formula, double distance, const std::array<double, 3>& direction) {
    IdVector<NodeId, double> values;
    values.reserve(formula.nodes.size());
    for (const Node& node : formula.nodes) {
        const Overloaded value{
            [](double number) { return number; },
            [&](CellValue known) { return known == CellValue::distance ? distance : 0; },
            [&](Call) {
                std::array<double, most_operands> operands{};
                std::ranges::transform(node.reads(), operands.begin(),
                                       [&](NodeId operand) { return values[operand]; });
                // Only the direction is a vector here; the second operand is the axis.
                if (node.function == Function::component)
                    return direction[static_cast<std::size_t>(operands[1])];
                const auto folded = fold(node.function, operands);
                CHECK(folded, "a place in a kernel is made of functions of numbers");
                return *folded;
            },
            [](auto) -> double { CHECK(false, "a place in a kernel is one of a lag"); },
        };
        values.push_back(std::visit(value, node.kind));
    }
    return values.back();
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
