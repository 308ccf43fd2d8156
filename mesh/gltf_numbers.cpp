// Reads numbers from the buffer without copying them, and looks up replaced elements.
#include "mesh/gltf_numbers.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <utility>

namespace cascade {

namespace {

template <typename T>
T value_at(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof(T));
    return value;
}

}  // namespace

std::optional<GltfNumbers> GltfNumbers::of(const tinygltf::Model& model, int number) {
    const tinygltf::Accessor* const accessor = part_of(model.accessors, number);
    if (!accessor) return {};
    const int components =
        tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor->type));
    if (components < 1) return {};
    GltfNumbers numbers;
    numbers.count_ = accessor->count;
    numbers.components_ = static_cast<std::size_t>(components);
    numbers.is_normalized_ = accessor->normalized;
    if (accessor->bufferView >= 0) {
        const auto row = row_of(model, accessor->bufferView, accessor->byteOffset, accessor->count,
                                numbers.components_, accessor->componentType, true);
        if (!row) return {};
        numbers.base_ = *row;
    }
    if (accessor->sparse.isSparse && !numbers.replace(model, *accessor)) return {};
    return numbers;
}

std::optional<GltfNumbers::Row> GltfNumbers::row_of(const tinygltf::Model& model, int view,
                                                    std::size_t offset, std::size_t count,
                                                    std::size_t components, int type,
                                                    bool has_stride) {
    const tinygltf::BufferView* const bytes = part_of(model.bufferViews, view);
    const tinygltf::Buffer* const buffer = bytes ? part_of(model.buffers, bytes->buffer) : nullptr;
    const int component_size = tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type));
    if (!buffer || component_size < 1) return {};
    Row row;
    row.type = type;
    row.component_size = static_cast<std::size_t>(component_size);
    const std::size_t element = components * row.component_size;
    row.stride = has_stride && bytes->byteStride > 0 ? bytes->byteStride : element;
    // Rejects strides that are not multiples of the component size. tinygltf accepts them.
    if (row.stride % row.component_size != 0) return {};
    const std::size_t size = buffer->data.size();
    if (bytes->byteOffset > size || offset > size - bytes->byteOffset) return {};
    const std::size_t begin = bytes->byteOffset + offset;
    if (count > 0 &&
        (element > size - begin || (count - 1) > (size - begin - element) / row.stride)) {
        return {};
    }
    row.data = buffer->data.data() + begin;
    return row;
}

bool GltfNumbers::replace(const tinygltf::Model& model, const tinygltf::Accessor& accessor) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0) {
        return false;
    }
    const auto count = static_cast<std::size_t>(sparse.count);
    const auto places = row_of(model, sparse.indices.bufferView,
                               static_cast<std::size_t>(sparse.indices.byteOffset), count, 1,
                               sparse.indices.componentType, false);
    const auto values =
        row_of(model, sparse.values.bufferView, static_cast<std::size_t>(sparse.values.byteOffset),
               count, components_, accessor.componentType, false);
    if (!places || !values) return false;
    places_ = *places;
    values_ = *values;
    switch (places_.type) {
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: break;
        default: return false;
    }
    const bool fractions = std::exchange(is_normalized_, false);  // Indices are integers.
    double next = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double place = number(places_, k, 0);
        if (place < next || place >= static_cast<double>(count_)) return false;
        next = place + 1;
    }
    is_normalized_ = fractions;
    replaced_count_ = count;
    return true;
}

std::optional<std::size_t> GltfNumbers::replacement_of(std::size_t element) const {
    const auto place = [&](std::size_t k) -> std::size_t {
        const unsigned char* const from = places_.data + k * places_.stride;
        switch (places_.component_size) {
            case 1: return *from;
            case 2: return value_at<std::uint16_t>(from);
            default: return value_at<std::uint32_t>(from);
        }
    };
    std::size_t low = 0, high = replaced_count_;
    while (low < high) {
        const std::size_t middle = low + (high - low) / 2;
        if (place(middle) < element) low = middle + 1;
        else high = middle;
    }
    if (low == replaced_count_ || place(low) != element) return {};
    return low;
}

double GltfNumbers::number(const Row& row, std::size_t element, std::size_t component) const {
    const unsigned char* const from =
        row.data + element * row.stride + component * row.component_size;
    const auto scaled = [&](double value, double one) {
        return is_normalized_ ? std::max(value / one, -1.0) : value;
    };
    switch (row.type) {
        case TINYGLTF_COMPONENT_TYPE_BYTE: return scaled(value_at<std::int8_t>(from), 127);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE: return scaled(*from, 255);
        case TINYGLTF_COMPONENT_TYPE_SHORT: return scaled(value_at<std::int16_t>(from), 32767);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
            return scaled(value_at<std::uint16_t>(from), 65535);
        case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT: return value_at<std::uint32_t>(from);
        case TINYGLTF_COMPONENT_TYPE_FLOAT: return value_at<float>(from);
        case TINYGLTF_COMPONENT_TYPE_DOUBLE: return value_at<double>(from);
        default: return 0;
    }
}

}  // namespace cascade
