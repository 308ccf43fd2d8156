// tinygltf without its support for images, and access to the parts that a file names by number.
#pragma once

#define TINYGLTF_NO_STB_IMAGE  // Textures are not needed.
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wall"
#include <tiny_gltf.h>
#pragma GCC diagnostic pop

#include <vector>

namespace cascade {

/// Part `number` of a list; null if the number is out of range.
template <typename Part>
const Part* part_of(const std::vector<Part>& list, int number) {
    const auto place = static_cast<std::size_t>(number);
    return number < 0 || place >= list.size() ? nullptr : &list[place];
}

}  // namespace cascade
