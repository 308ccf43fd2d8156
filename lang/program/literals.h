// Objects to which formulas refer by an index: texts, kernels of convolutions, constraints, surface
// values, and readings of files.
#pragma once

#include "core/picture_channel.h"
#include "lang/program/domain.h"

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace cascade {

/// A value of a model's cells that depends on constant positions on the model: distance(…), keys(…)
/// or along(…) with constant arguments.
struct SurfaceValue {
    Function function = Function::distance;
    /// The arguments as the script gives them. For along(…), DirectionSettings::numbers.
    std::vector<double> numbers;
    // Used only by along(…).
    DirectionSettings::Kind direction = DirectionSettings::Kind::axis;
    double smoothing = 0;

    friend bool operator==(const SurfaceValue&, const SurfaceValue&) = default;
};

/// Which part of a file a function reads, and in which way.
struct FileReading {
    PictureChannel channel = PictureChannel::lightness;
    /// Whether the value that is read is the angle of a painted direction.
    bool is_direction = false;
    /// The position in the file at which to read. The coordinates go from 0 to 1 from the left,
    /// from the top and from the first slice, and are formulas of numbers and of the cell's
    /// position. If empty, the position in the file is the cell's position in the domain.
    std::vector<Formula> place = {};
};

/// A constraint `0 = e`, which determines a field.
struct Constraint {
    std::string unknown;  ///< The name of the field.
    Span span;            ///< Where e is in the script.
};

/// The kernel of a convolution. `weight` is a formula of numbers, of uniform parameters, and of
/// `distance` and `direction` (CellValue) from the cell to the cell whose value is weighted.
struct ConvolutionKernel {
    Formula weight;
    Formula reach;  ///< Cells up to this distance are weighted. If empty, all cells are.
};

/// Stores objects that do not fit into a Node. Objects that have been added never change. If a
/// picture's expression is checked after the program, its objects are added at the end. Not
/// thread-safe.
class Literals {
public:
    /// The id of an equal text, or of a new text if there is none.
    TextId id_of(const std::string& text);
    SurfaceValueId id_of(const SurfaceValue& value);
    /// Adds a kernel or a constraint. Returns its index.
    std::uint32_t add(ConvolutionKernel kernel);
    std::uint32_t add(Constraint constraint);
    /// Adds a reading and returns its index. If `place` is empty and an equal reading exists,
    /// returns the index of that reading.
    std::uint32_t add(FileReading reading);

    /// The text with this id: the name of a palette, or a path.
    const std::string& text(TextId id) const { return texts_[id.index()]; }
    const SurfaceValue& surface_value(SurfaceValueId id) const {
        return surface_values_[id.index()];
    }
    const ConvolutionKernel& kernel(std::uint32_t number) const { return kernels_[number]; }
    const Constraint& constraint(std::uint32_t number) const { return constraints_[number]; }
    const FileReading& reading(std::uint32_t number) const { return readings_[number]; }
    std::uint32_t reading_count() const { return static_cast<std::uint32_t>(readings_.size()); }
    auto text_ids() const { return ids_below<TextId>(texts_.size()); }

private:
    std::deque<std::string> texts_;
    std::deque<SurfaceValue> surface_values_;
    std::deque<ConvolutionKernel> kernels_;
    std::deque<Constraint> constraints_;
    std::deque<FileReading> readings_{FileReading{}};
};

/// Calls visit(kernel) for the kernel of each convolution in a formula.
template <typename Visit>
void for_each_kernel(const Formula& formula, const Literals& literals, const Visit& visit) {
    for (const Node& node : formula.nodes) {
        if (node.calls(Function::convolve)) visit(literals.kernel(node.as<Call>()->detail));
    }
}

}  // namespace cascade
