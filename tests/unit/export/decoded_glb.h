// Decodes GLB files for tests.
#pragma once

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace cascade::test {

/// A GLB file, decoded by the specification of the format.
class Decoded {
public:
    explicit Decoded(const std::string& glb) {
        std::uint32_t size = 0;
        std::memcpy(&size, glb.data() + 12, 4);
        json = nlohmann::json::parse(glb.substr(20, size));
        buffer_ = glb.substr(28 + size);
    }

    /// The components of all elements of an accessor.
    std::vector<double> numbers(const nlohmann::json& number) const {
        const nlohmann::json& accessor = json["accessors"][number.get<std::size_t>()];
        if (!accessor.contains("bufferView")) {
            return std::vector<double>(3 * accessor["count"].get<std::size_t>());
        }
        const nlohmann::json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        const std::string type = accessor["type"];
        const std::size_t components = type == "SCALAR" ? 1 : type.back() - std::size_t{'0'};
        const std::size_t count = accessor["count"].get<std::size_t>() * components;
        const char* from = buffer_.data() + view["byteOffset"].get<std::size_t>();
        std::vector<double> result;
        for (std::size_t k = 0; k < count; ++k) {
            switch (accessor["componentType"].get<int>()) {
                case 5126: result.push_back(at<float>(from, k)); break;
                case 5122: result.push_back(at<std::int16_t>(from, k) / 32767.0); break;
                case 5123: result.push_back(at<std::uint16_t>(from, k)); break;
                default: ADD_FAILURE() << "another type";
            }
        }
        return result;
    }

    nlohmann::json json;

private:
    template <typename Number>
    static Number at(const char* from, std::size_t k) {
        Number number;
        std::memcpy(&number, from + k * sizeof number, sizeof number);
        return number;
    }
    std::string buffer_;
};

}  // namespace cascade::test
