// What formulas name by a number: texts, kernels of convolutions, constraints, values of surfaces,
// and what is read of files.
#pragma once

#include "core/picture_channel.h"
#include "lang/program/domain.h"

#include <cstdint>
#include <deque>
#include <string>
#include <vector>

namespace cascade {

/// Values of a model's cells that come from places on it: distance(…), keys(…) and along(…) with
/// constant arguments.
struct SurfaceValue {
    Function function = Function::distance;
    std::vector<double> numbers;  ///< As written; of along(…) those of DirectionSettings.
    // Of along(…):
    DirectionSettings::Kind direction = DirectionSettings::Kind::axis;
    double smoothing = 0;

    friend bool operator==(const SurfaceValue&, const SurfaceValue&) = default;
};

/// What a function of a file reads of it.
struct FileReading {
    PictureChannel channel = PictureChannel::lightness;
    bool is_direction = false;  ///< The angle of the direction that a picture has painted.
    /// Where in the file, 0 … 1 from the left, from the top and from the first slice: formulas of
    /// numbers and of where the cell is. Empty: where the domain has it.
    std::vector<Formula> place = {};
};

/// A constraint `0 = e`, which determines a field.
struct Constraint {
    std::string unknown;  ///< The name of the field.
    Span span;            ///< Of e.
};

/// The kernel of a convolution: a formula of numbers, uniform parameters, and `distance` and
/// `direction` from the cell to the one that is weighted (CellValue).
struct ConvolutionKernel {
    Formula weight;
    Formula reach;  ///< Cells up to this distance count; empty: all cells of the domain.
};

/// What formulas name by its number, as it does not fit into a Node. Entries never change; a view
/// of a checked program that names something new adds it at the end. From one thread at a time.
class Literals {
public:
    /// The id of an equal one, or of a new one.
    TextId id_of(const std::string& text);
    SurfaceValueId id_of(const SurfaceValue& value);
    /// The number of a new kernel, or of a new constraint.
    std::uint32_t add(ConvolutionKernel kernel);
    std::uint32_t add(Constraint constraint);
    /// The number of a new one; of an equal one, if it has no place.
    std::uint32_t add(FileReading reading);

    /// In quotes: the name of a palette, a path.
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

/// Calls visit(kernel) for the kernels of the convolutions in a formula.
template <typename Visit>
void for_each_kernel(const Formula& formula, const Literals& literals, const Visit& visit) {
    for (const Node& node : formula.nodes) {
        if (node.calls(Function::convolve)) visit(literals.kernel(node.as<Call>()->detail));
    }
}

}  // namespace cascade
