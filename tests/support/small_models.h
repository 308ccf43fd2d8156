// Small valid model files in every format, with which readers are tested, also after damage.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::test {

/// The bytes of a number in a file.
std::string bytes_of(float value, bool big_endian = false);
std::string bytes_of(double value, bool big_endian = false);
std::string bytes_of(std::uint16_t value, bool big_endian = false);
std::string bytes_of(std::uint32_t value, bool big_endian = false);

/// One triangle, moved by its node and scaled by the parent node. The reference to the indices can
/// be replaced.
std::string gltf_text(std::string_view indices_accessor = R"("indices":1,)");

/// A GLB file made of these two parts.
std::string glb_file(std::string_view json, std::string_view data);

struct SmallModel {
    std::string_view name;
    std::string_view ending;  ///< The format's file name ending, in lower case.
    std::string bytes;
};

/// A tetrahedron or a part of one, in all formats that are read.
std::vector<SmallModel> small_models();

/// A torus of 16 by 8 quadrilaterals as an OBJ file, for which cells are made quickly.
std::string small_torus_obj();

}  // namespace cascade::test
