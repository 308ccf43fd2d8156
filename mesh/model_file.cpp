#include "mesh/model_file.h"

#include "core/file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace cascade {

namespace {

std::string ending_of(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

}  // namespace

Result<PolygonSoup> read_model_bytes(std::string_view bytes, std::string_view ending,
                                     const std::filesystem::path& folder) {
    if (ending == "ply") return read_ply(bytes);
    if (ending == "off") return read_off(bytes);
    if (ending == "gltf" || ending == "glb") return read_gltf(bytes, folder);
    if (ending == "stl") return read_stl(bytes);
    return read_obj(bytes);
}

Result<PolygonSoup> read_model(const std::filesystem::path& path) {
    constexpr std::array<std::string_view, 6> endings = {"ply", "obj", "off", "stl", "gltf", "glb"};
    const std::string ending = ending_of(path);
    if (std::find(endings.begin(), endings.end(), ending) == endings.end()) {
        return failure(fmt::format("'{}' is no model: its name ends in none of .ply, .obj, .off, "
                                   ".stl, .gltf, .glb",
                                   path.string()));
    }
    // A pipe that nobody writes to would be waited for without end, a device has no end.
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!error && std::filesystem::is_other(status)) {
        return failure(fmt::format("cannot read '{}': it is a pipe or a device, not a file", path.string()));
    }
    const Result<std::string> bytes = read_file(path, largest_model_file);
    if (!bytes) return tl::unexpected(bytes.error());
    Result<PolygonSoup> soup = read_model_bytes(*bytes, ending, path.parent_path());
    if (!soup) {
        return failure(fmt::format("'{}': {}", path.string(), soup.error().message),
                       soup.error().hint);
    }
    if (soup->ends.empty()) {
        return failure(fmt::format("'{}' has {} points but no faces", path.string(),
                                   soup->points.size()),
                       "a surface is wanted, not a cloud of points");
    }
    return soup;
}

}  // namespace cascade
