// Reads positions, texture coordinates, colours of points and polygons of OBJ files (Wavefront
// Technologies, "Advanced Visualizer Manual", appendix B1: Object Files). Ignores other lines.
#include "mesh/model_file.h"
#include "mesh/text_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace cascade {

namespace {

constexpr std::int64_t most_points = std::numeric_limits<std::int32_t>::max();

/// The indices in a corner of a face, from 0.
struct FaceCorner {
    std::uint32_t point = 0;
    std::optional<std::uint32_t> texture;
};

/// Joins each line that ends in a backslash with the next line. Blanks replace the backslash and
/// the line end, to preserve offsets.
std::string joined_lines(std::string_view bytes) {
    std::string text(bytes);
    for (std::size_t at = text.find('\\'); at != std::string::npos; at = text.find('\\', at + 1)) {
        const std::size_t end = text.find_first_not_of('\r', at + 1);
        if (end == std::string::npos) break;
        const std::size_t after = text[end] == '\n' ? end + 1 : end;
        if (after > at + 1) text.replace(at, after - at, after - at, ' ');
    }
    return text;
}

class ObjReader {
public:
    explicit ObjReader(std::string_view text) : lines_(text) {}

    Result<PolygonSoup> read() {
        for (;;) {
            const Words& words = lines_.next();
            if (words.empty()) break;
            if (words[0] == "surf") has_curved_parts_ = true;
            if (words[0] == "v" && !read_point(words)) {
                return wrong_line("the position of a point", hint_of_point(words));
            }
            if (words[0] == "vt" && !read_texture_place(words)) {
                return wrong_line("a position in a texture");
            }
            if (words[0] == "f" && !read_face(words)) {
                const bool has_zero = std::ranges::any_of(words, [](std::string_view word) {
                    return word == "0" || word.starts_with("0/");
                });
                return wrong_line("a face of points", has_zero ? "points are counted from 1" : "");
            }
        }
        return finished();
    }

private:
    using Words = std::vector<std::string_view>;

    tl::unexpected<Failure> wrong_line(std::string_view what, std::string hint = "") const {
        return failure(fmt::format("line {} of the OBJ file is not {}", lines_.number(), what),
                       std::move(hint));
    }

    static std::string hint_of_point(const Words& words) {
        const bool has_comma = std::ranges::any_of(words, [](std::string_view word) {
            return word.find(',') != std::string_view::npos;
        });
        if (has_comma) return "write numbers with a point, not with a comma";
        return words.size() < 4 ? "write three coordinates for each point" : "";
    }

    /// Reads three coordinates, optionally followed by a colour.
    bool read_point(const Words& words) {
        std::array<double, 6> numbers{};
        const std::size_t count = std::min<std::size_t>(words.size() - 1, 6);
        for (std::size_t k = 0; k < count; ++k) {
            const auto number = number_in(words[k + 1]);
            if (!number) return false;
            numbers[k] = *number;
        }
        if (count < 3 || std::ssize(soup_.points) >= most_points) return false;
        soup_.points.push_back({numbers[0], numbers[1], numbers[2]});
        all_have_colours_ = all_have_colours_ && count == 6;
        if (!all_have_colours_) return true;
        for (std::size_t c = 0; c < 3; ++c) {
            soup_.attributes[c].values.push_back(static_cast<float>(numbers[3 + c]));
        }
        return true;
    }

    bool read_texture_place(const Words& words) {
        if (words.size() < 2 || std::ssize(texture_) >= most_points) return false;
        const auto u = number_in(words[1]);
        const auto v = words.size() > 2 ? number_in(words[2]) : 0;
        if (!u || !v) return false;
        texture_.push_back({static_cast<float>(*u), static_cast<float>(*v)});
        return true;
    }

    bool read_face(const Words& words) {
        for (std::size_t k = 1; k < words.size(); ++k) {
            const std::optional<FaceCorner> corner = corner_in(words[k]);
            if (!corner) return false;
            soup_.corners.push_back(corner->point);
            all_have_texture_ = all_have_texture_ && corner->texture;
            if (all_have_texture_) corner_texture_.push_back(*corner->texture);
        }
        soup_.ends.push_back(soup_.corners.size());
        return true;
    }

    /// Parses a corner written as "point", "point/texture", "point//normal" or
    /// "point/texture/normal".
    std::optional<FaceCorner> corner_in(std::string_view word) const {
        const std::size_t slash = std::min(word.find('/'), word.size());
        const auto point = number_of(word.substr(0, slash), std::ssize(soup_.points));
        if (!point) return std::nullopt;
        FaceCorner corner{*point, std::nullopt};
        const std::string_view rest = word.substr(std::min(slash + 1, word.size()));
        const std::string_view texture = rest.substr(0, rest.find('/'));
        if (texture.empty()) return corner;
        corner.texture = number_of(texture, std::ssize(texture_));
        if (!corner.texture) return std::nullopt;
        return corner;
    }

    /// Reads an index. A positive index counts from 1. A negative index counts backwards from the
    /// latest entry.
    static std::optional<std::uint32_t> number_of(std::string_view word, std::int64_t so_far) {
        const auto number = whole_number_in<std::int64_t>(word);
        if (!number || *number > most_points || *number < -so_far || *number == 0)
            return std::nullopt;
        return static_cast<std::uint32_t>(*number > 0 ? *number - 1 : so_far + *number);
    }

    Result<PolygonSoup> finished() {
        if (soup_.points.empty()) return failure("the OBJ file has no points");
        if (soup_.ends.empty() && has_curved_parts_) {
            return failure("the OBJ file contains only curved surfaces, which Cascade cannot read",
                           "export it as triangles");
        }
        for (std::size_t face = 0; face < soup_.polygon_count(); ++face) {
            for (std::size_t c = soup_.first_corner(face); c < soup_.ends[face]; ++c) {
                if (soup_.corners[c] >= soup_.points.size()) {
                    return failure(fmt::format(
                        "face {} of the OBJ file names a point that does not exist", face + 1));
                }
                if (!all_have_texture_) continue;
                if (corner_texture_[c] >= texture_.size()) {
                    return failure(fmt::format(
                        "face {} of the OBJ file names a texture coordinate that does not exist",
                        face + 1));
                }
                soup_.texture.push_back(texture_[corner_texture_[c]]);
            }
        }
        if (!all_have_colours_) soup_.attributes.clear();
        return std::move(soup_);
    }

    LineReader lines_;
    PolygonSoup soup_{{},
                      {},
                      {},
                      {},
                      {PointAttribute{"red", {}}, PointAttribute{"green", {}},
                       PointAttribute{"blue", {}}}};
    std::vector<TexturePlace> texture_;
    /// For each corner, the index of its texture coordinates. Filled as long as every corner has
    /// some.
    std::vector<std::uint32_t> corner_texture_;
    bool all_have_texture_ = true, all_have_colours_ = true;
    /// Whether the file has free-form surfaces, which are ignored.
    bool has_curved_parts_ = false;
};

}  // namespace

Result<PolygonSoup> read_obj(std::string_view bytes) {
    if (bytes.find('\\') == std::string_view::npos) return ObjReader(bytes).read();
    const std::string text = joined_lines(bytes);
    return ObjReader(text).read();
}

}  // namespace cascade
