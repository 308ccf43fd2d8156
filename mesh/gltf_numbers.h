// The numbers of glTF's accessors: elements with a few components in a buffer. A sparse accessor
// may replace some elements.
#pragma once

#include "mesh/gltf_model.h"

#include <cstddef>
#include <optional>

namespace cascade {

class GltfNumbers {
public:
    /// The numbers of an accessor, read from the model's buffers. nullopt if there is no such
    /// accessor, if its numbers lie beyond the data, or if the replaced elements are not in
    /// ascending order.
    static std::optional<GltfNumbers> of(const tinygltf::Model& model, int accessor);

    std::size_t count() const { return count_; }
    std::size_t components() const { return components_; }
    /// Whether the file has data for the elements. Without data, all elements are 0 except for
    /// replaced elements.
    bool has_bytes() const { return base_.data != nullptr; }

    /// A component of an element. If the accessor is normalized, integers are divided by their
    /// type's largest value.
    double at(std::size_t element, std::size_t component) const {
        if (replaced_count_ > 0) {
            if (const auto k = replacement_of(element)) return number(values_, *k, component);
        }
        return base_.data ? number(base_, element, component) : 0;
    }

private:
    /// Elements at equal distances in a buffer.
    struct Row {
        const unsigned char* data = nullptr;
        std::size_t stride = 0, component_size = 0;
        int type = 0;
    };
    static std::optional<Row> row_of(const tinygltf::Model& model, int view, std::size_t offset,
                                     std::size_t count, std::size_t components, int type,
                                     bool has_stride);
    bool replace(const tinygltf::Model& model, const tinygltf::Accessor& accessor);
    std::optional<std::size_t> replacement_of(std::size_t element) const;
    double number(const Row& row, std::size_t element, std::size_t component) const;

    std::size_t count_ = 0, components_ = 1;
    bool is_normalized_ = false;
    Row base_;
    std::size_t replaced_count_ = 0;
    Row places_, values_;  ///< The replaced elements in ascending order, and their values.
};

}  // namespace cascade
