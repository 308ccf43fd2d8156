// Selects the reader by the extension of the name.
#include "mesh/model_file.h"

#include "core/check.h"
#include "core/file.h"
#include "core/printable.h"
#include "mesh/other_content.h"
#include "mesh/text_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
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

struct Format {
    std::string_view ending;
    Result<PolygonSoup> (*read)(std::string_view bytes, const GrantedFiles& files);
};

template <Result<PolygonSoup> (*read)(std::string_view)>
Result<PolygonSoup> read_alone(std::string_view bytes, const GrantedFiles&) {
    return read(bytes);
}

constexpr std::array<Format, 6> formats = {{{"ply", read_alone<read_ply>},
                                            {"obj", read_alone<read_obj>},
                                            {"off", read_alone<read_off>},
                                            {"stl", read_alone<read_stl>},
                                            {"gltf", read_gltf},
                                            {"glb", read_gltf}}};

const Format* format_of(std::string_view ending) {
    const auto found = std::find_if(formats.begin(), formats.end(),
                                    [&](const Format& each) { return each.ending == ending; });
    return found == formats.end() ? nullptr : &*found;
}

/// The extension of a model's name in lower case. Fails for unknown extensions.
Result<std::string> model_ending(const std::string& name) {
    std::string ending = ending_of(name);
    if (format_of(ending) != nullptr) return ending;
    return failure(
        fmt::format("'{}' is not a model: its name ends in none of .ply, .obj, .off, .stl, "
                    ".gltf, .glb",
                    short_name(name)),
        ending == "cascade" ? "'cascade run' draws a script"
        : ending.empty()    ? ""
                            : "export the model as .glb or .obj");
}

Result<PolygonSoup> parse_model(const std::string& name, std::string_view ending,
                                std::string_view bytes, const GrantedFiles& files) {
    Result<PolygonSoup> soup = read_model_bytes(bytes, ending, files);
    if (!soup) {
        return failure(fmt::format("'{}': {}", short_name(name), soup.error().message),
                       soup.error().hint);
    }
    if (soup->points.empty()) return failure(fmt::format("'{}' has no faces", short_name(name)));
    if (soup->ends.empty()) {
        return failure(fmt::format("'{}' has {} points but no faces", short_name(name),
                                   soup->points.size()),
                       "a model must be a surface, not a cloud of points");
    }
    return soup;
}

}  // namespace

Result<PolygonSoup> read_model_bytes(std::string_view bytes, std::string_view ending,
                                     const GrantedFiles& files) {
    const Format* const format = format_of(ending);
    CHECK(format != nullptr, "the ending of a model is checked before its file is read");
    if (auto other = other_content(bytes, ending)) return tl::unexpected(*std::move(other));
    // A binary STL file may begin with any bytes.
    if (ending != "stl" && is_utf16(bytes)) return utf16_failure();
    return format->read(bytes, files);
}

Result<PolygonSoup> read_model(const GrantedFiles& files, const std::string& name) {
    const Result<std::string> ending = model_ending(name);
    if (!ending) return tl::unexpected(ending.error());
    const Result<std::string> bytes = files.read(name, largest_model_file);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_model(name, *ending, *bytes, files.beside(name));
}

Result<PolygonSoup> read_model(const std::filesystem::path& path, const ReadAccess& access) {
    const Result<std::string> ending = model_ending(path.string());
    if (!ending) return tl::unexpected(ending.error());
    const Result<std::string> bytes = read_linked_file(path, largest_model_file);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_model(path.string(), *ending, *bytes,
                       GrantedFiles(path.parent_path(), access, "model"));
}

}  // namespace cascade
