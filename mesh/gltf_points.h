// The points of a glTF primitive, by default weights and joints.
#pragma once

#include "core/result.h"
#include "mesh/gltf_matrix.h"
#include "mesh/gltf_model.h"
#include "mesh/gltf_numbers.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace cascade {

/// Where a mesh is placed, and in which shape and light.
struct GltfPlacing {
    const GltfMatrix& matrix;               ///< Of its node; skinned points ignore it.
    const std::vector<GltfMatrix>* joints;  ///< Of its skin; null if there is none.
    std::span<const double> weights;        ///< Of its morph targets; others have none.
    /// Multiplies the colours of a copy.
    std::optional<std::array<double, 3>> light = {};
};

/// An attribute of a primitive with its morph targets.
class MorphedAttribute {
public:
    /// Nothing if the primitive has no such attribute of at least `least` components, or beyond
    /// the data. Targets that lack it leave it as it is. Fails on targets for fewer points, and
    /// beyond the data.
    static Result<std::optional<MorphedAttribute>> of(const tinygltf::Model& model,
                                                      const tinygltf::Primitive& primitive,
                                                      const std::string& name, std::size_t least,
                                                      std::span<const double> weights);

    std::size_t count() const { return base_.count(); }
    std::size_t components() const { return base_.components(); }
    /// The number of arrays that a value is the sum of.
    std::size_t parts() const { return 1 + targets_.size(); }
    double at(std::size_t element, std::size_t component) const {
        double sum = base_.at(element, component);
        for (const Target& target : targets_) {
            if (component < target.shift.components())
                sum += target.weight * target.shift.at(element, component);
        }
        return sum;
    }

private:
    struct Target {
        double weight;
        GltfNumbers shift;
    };
    explicit MorphedAttribute(const GltfNumbers& base) : base_(base) {}
    GltfNumbers base_;
    std::vector<Target> targets_;  ///< Those whose weight is not 0.
};

}  // namespace cascade
