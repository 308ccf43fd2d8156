// Compares the first bytes with a table.
#include "mesh/other_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace cascade {

namespace {

struct Content {
    std::string_view beginning, name, hint;
};
constexpr std::array contents = {
    Content{"\x1f\x8b", "is compressed by gzip", "unpack it first"},
    Content{"PK\x03\x04", "is a ZIP archive", "unpack it first"},
    Content{"version https://git-lfs", "is a pointer of Git LFS, without the model",
            "'git lfs pull' fetches the model"},
    Content{"<!DOCTYPE", "is a page of HTML", "the download of the model has failed"},
    Content{"<!doctype", "is a page of HTML", "the download of the model has failed"},
    Content{"<html", "is a page of HTML", "the download of the model has failed"},
};

/// The beginnings of formats, and the extensions of these formats. No other format begins in the
/// same way.
struct Beginning {
    std::string_view text, format;
    std::array<std::string_view, 2> endings;
};
constexpr std::array beginnings = {
    Beginning{"ply\n", "PLY", {"ply", "ply"}},
    Beginning{"ply\r", "PLY", {"ply", "ply"}},
    Beginning{"glTF", "GLB", {"glb", "gltf"}},
    Beginning{"OFF\n", "OFF", {"off", "off"}},
};

}  // namespace

std::optional<Failure> other_content(std::string_view bytes, std::string_view ending) {
    if (bytes.empty()) return Failure{"the file is empty", ""};
    for (const Content& each : contents) {
        if (bytes.starts_with(each.beginning)) {
            return Failure{fmt::format("the file {}", each.name), std::string(each.hint)};
        }
    }
    for (const Beginning& each : beginnings) {
        if (!bytes.starts_with(each.text)) continue;
        if (std::ranges::find(each.endings, ending) != each.endings.end()) return std::nullopt;
        return Failure{
            fmt::format("this is a {} file, but its name ends in .{}", each.format, ending),
            fmt::format("rename the file so that its name ends in .{}", each.endings[0])};
    }
    return std::nullopt;
}

}  // namespace cascade
