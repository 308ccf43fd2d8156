// glTF files that tests make: parts of JSON and one binary buffer.
#pragma once

#include "mesh/model_file.h"
#include "support/small_models.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace cascade::test {

using Json = nlohmann::json;

class BuiltGltf {
public:
    /// A scene whose node 0 shows the triangle (0, 0, 0), (1, 0, 0), (0, 2, 0).
    BuiltGltf() {
        json["asset"]["version"] = "2.0";
        json["scene"] = 0;
        json["scenes"] = Json::array({{{"nodes", {0}}}});
        json["nodes"] = Json::array({{{"mesh", 0}}});
        json["meshes"] = Json::array({{{"primitives", Json::array({Json::object()})}}});
        primitive()["attributes"]["POSITION"] = add<float>("VEC3", {0, 0, 0, 1, 0, 0, 0, 2, 0});
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    Json& node(std::size_t number) { return json["nodes"][number]; }
    Json& accessor(std::size_t number) { return json["accessors"][number]; }

    template <typename Number>
    std::size_t add_view(const std::vector<double>& numbers) {
        data_.append((4 - data_.size() % 4) % 4, '\0');
        const std::size_t begin = data_.size();
        for (const double number : numbers) {
            const auto value = static_cast<Number>(number);
            data_.append(reinterpret_cast<const char*>(&value), sizeof value);
        }
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", begin}, {"byteLength", data_.size() - begin}});
        return json["bufferViews"].size() - 1;
    }

    template <typename Number>
    std::size_t add(const std::string& type, const std::vector<double>& numbers,
                    bool is_normalized = false) {
        const std::size_t each = type == "SCALAR" ? 1
                                 : type == "MAT4" ? 16
                                                  : std::size_t(type.back() - '0');
        Json accessor = {{"bufferView", add_view<Number>(numbers)},
                         {"componentType", code_of<Number>()},
                         {"count", numbers.size() / each},
                         {"type", type}};
        if (is_normalized) accessor["normalized"] = true;
        json["accessors"].push_back(accessor);
        return json["accessors"].size() - 1;
    }

    std::string bytes() {
        json["buffers"] = Json::array({{{"byteLength", data_.size()}}});
        return glb_file(json.dump(), data_);
    }

    Result<PolygonSoup> read() { return read_gltf(bytes()); }
    std::string fault() {
        const auto soup = read();
        return soup ? "read" : soup.error().message;
    }
    /// The points of the file. If it is refused, the test fails and there are none.
    std::vector<Vector3d> points() {
        const auto soup = read();
        EXPECT_TRUE(soup.has_value()) << soup.error().message;
        return soup ? soup->points : std::vector<Vector3d>();
    }

    template <typename Number>
    static int code_of() {
        if (std::is_same_v<Number, std::int8_t>) return 5120;
        if (std::is_same_v<Number, std::uint8_t>) return 5121;
        if (std::is_same_v<Number, std::int16_t>) return 5122;
        if (std::is_same_v<Number, std::uint16_t>) return 5123;
        if (std::is_same_v<Number, std::uint32_t>) return 5125;
        return 5126;
    }

    Json json;

private:
    std::string data_;
};

/// Expects points, up to the rounding of binary32 and of 16-bit fractions.
inline void expect_points(const std::vector<Vector3d>& seen, const std::vector<Vector3d>& wanted,
                          double error = 1e-6) {
    ASSERT_EQ(seen.size(), wanted.size());
    for (std::size_t k = 0; k < seen.size(); ++k) {
        EXPECT_LE(length(seen[k] - wanted[k]), error)
            << "point " << k << ": " << seen[k].x << ", " << seen[k].y << ", " << seen[k].z;
    }
}

}  // namespace cascade::test
