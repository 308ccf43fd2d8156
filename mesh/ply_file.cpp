// Reads PLY files, including triangle strips and properties of any name.
#include "core/printable.h"
#include "mesh/model_file.h"
#include "mesh/ply_header.h"
#include "mesh/text_words.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>

namespace cascade {

namespace {

constexpr std::uint32_t most_numbered_points = std::numeric_limits<std::int32_t>::max();

/// Reads numbers from the body of the file in sequence.
class NumberReader {
public:
    NumberReader(std::string_view bytes, const PlyHeader& header)
        : bytes_(bytes), at_(header.size), format_(header.format) {}

    /// The next number; nullopt at the end of the file, or if a word is not a number.
    std::optional<double> next(PlyNumber type) {
        return format_ == PlyHeader::Format::text ? next_word() : next_binary(type);
    }
    std::size_t left() const { return bytes_.size() - at_; }
    /// Whether a file of text has more words after the last number that was read.
    bool has_more_words() const {
        if (format_ != PlyHeader::Format::text) return false;
        const std::string_view rest = bytes_.substr(at_);
        return !std::all_of(rest.begin(), rest.end(), is_blank);
    }
    std::size_t least_bytes(PlyNumber type) const {
        return format_ == PlyHeader::Format::text ? 2 : size_of(type);
    }

private:
    std::optional<double> next_word() {
        while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
        const std::size_t begin = at_;
        while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
        return number_in(bytes_.substr(begin, at_ - begin));
    }

    static bool is_blank(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    template <typename T>
    std::optional<double> take() {
        if (left() < sizeof(T)) return std::nullopt;
        std::array<char, sizeof(T)> word;
        std::memcpy(word.data(), bytes_.data() + at_, sizeof(T));
        at_ += sizeof(T);
        if ((format_ == PlyHeader::Format::big_endian) ==
            (std::endian::native == std::endian::little)) {
            std::reverse(word.begin(), word.end());
        }
        return static_cast<double>(std::bit_cast<T>(word));
    }

    std::optional<double> next_binary(PlyNumber type) {
        switch (type) {
            case PlyNumber::int8: return take<std::int8_t>();
            case PlyNumber::uint8: return take<std::uint8_t>();
            case PlyNumber::int16: return take<std::int16_t>();
            case PlyNumber::uint16: return take<std::uint16_t>();
            case PlyNumber::int32: return take<std::int32_t>();
            case PlyNumber::uint32: return take<std::uint32_t>();
            case PlyNumber::float32: return take<float>();
            case PlyNumber::float64: return take<double>();
        }
        return std::nullopt;
    }

    std::string_view bytes_;
    std::size_t at_;
    PlyHeader::Format format_;
};

/// The columns with a point's numbers; −1 for numbers that the file lacks.
struct PointColumns {
    std::array<int, 3> place{-1, -1, -1};
    std::array<int, 2> texture{-1, -1};
};

bool is_one_of(std::string_view name, std::initializer_list<std::string_view> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

/// The value of full light if colours have this type.
float full_value(PlyNumber type) {
    switch (type) {
        case PlyNumber::uint16: return std::numeric_limits<std::uint16_t>::max();
        case PlyNumber::float32:
        case PlyNumber::float64: return 1;
        default: return std::numeric_limits<std::uint8_t>::max();
    }
}

PointColumns columns_of(const PlyElement& element) {
    PointColumns columns;
    for (std::size_t k = 0; k < element.properties.size(); ++k) {
        const std::string& name = element.properties[k].name;
        const int column = static_cast<int>(k);
        if (element.properties[k].is_list) continue;
        if (name == "x") columns.place[0] = column;
        if (name == "y") columns.place[1] = column;
        if (name == "z") columns.place[2] = column;
        if (is_one_of(name, {"s", "u", "texture_u", "texture_s"})) columns.texture[0] = column;
        if (is_one_of(name, {"t", "v", "texture_v", "texture_t"})) columns.texture[1] = column;
    }
    return columns;
}

class PlyReader {
public:
    PlyReader(std::string_view bytes, const PlyHeader& header)
        : header_(header), numbers_(bytes, header) {}

    Result<PolygonSoup> read() {
        if (std::count_if(header_.elements.begin(), header_.elements.end(),
                          [](const PlyElement& e) { return e.name == "vertex"; }) > 1) {
            return failure("the PLY file has several elements 'vertex'");
        }
        for (const PlyElement& element : header_.elements) {
            for (std::uint64_t k = 0; k < element.count; ++k) {
                if (k == 0) begin(element);
                if (!read_row(element)) {
                    return failure(
                        fmt::format("the PLY file ends too early, or a value is not a number, in "
                                    "row {} (counted from 0) of its element '{}'",
                                    k, element.name));
                }
                if (Result<void> used = use_row(element, k); !used) {
                    return tl::unexpected(used.error());
                }
            }
        }
        if (soup_.points.empty()) return failure("the PLY file has no element 'vertex'");
        if (numbers_.has_more_words()) {
            return failure("the PLY file has more numbers than its header says",
                           "the header counts too few elements, or a property is missing there");
        }
        if (soup_.ends.empty()) {
            if (const auto named = other_list(); !named.empty()) {
                return failure("the faces of the PLY file have no list 'vertex_indices'",
                               fmt::format("their list is called '{}'", named));
            }
        }
        for (const std::uint32_t corner : soup_.corners) {
            if (corner >= soup_.points.size()) {
                return failure(fmt::format("a face names point {}, but there are only {}", corner,
                                           soup_.points.size()));
            }
        }
        if (has_point_texture_ || !corners_have_texture_) soup_.texture.clear();
        if (has_point_texture_) {
            for (const std::uint32_t corner : soup_.corners) {
                soup_.texture.push_back(point_texture_[corner]);
            }
        }
        return std::move(soup_);
    }

private:
    /// The name of the faces' only list if it is not a usual name for corners. "" if there is no
    /// such list.
    std::string other_list() const {
        for (const PlyElement& element : header_.elements) {
            if (element.name != "face" || element.count == 0) continue;
            const auto is_list = [](const PlyProperty& each) { return each.is_list; };
            if (std::ranges::count_if(element.properties, is_list) != 1) continue;
            const std::string& name = std::ranges::find_if(element.properties, is_list)->name;
            if (!is_one_of(name, {"vertex_indices", "vertex_index"})) return short_name(name, 40);
        }
        return "";
    }

    void begin(const PlyElement& element) {
        lists_.assign(element.properties.size(), {});
        row_.assign(element.properties.size(), 0);
        if (element.name != "vertex") return;
        columns_ = columns_of(element);
        has_point_texture_ = columns_.texture[0] >= 0 && columns_.texture[1] >= 0;
        soup_.points.reserve(element.count);
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const int column = static_cast<int>(k);
            const auto is = [&](const auto& taken) {
                return std::find(taken.begin(), taken.end(), column) != taken.end();
            };
            if (element.properties[k].is_list || is(columns_.place)) continue;
            if (has_point_texture_ && is(columns_.texture)) continue;
            attribute_columns_.push_back(k);
            soup_.attributes.push_back(
                {element.properties[k].name, {}, full_value(element.properties[k].type)});
            soup_.attributes.back().values.reserve(element.count);
        }
    }

    bool read_row(const PlyElement& element) {
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const PlyProperty& property = element.properties[k];
            const auto first =
                numbers_.next(property.is_list ? property.count_type : property.type);
            if (!first) return false;
            row_[k] = *first;
            if (!property.is_list) continue;
            const double length = *first;
            const double room = static_cast<double>(numbers_.left() + 1) /
                                static_cast<double>(numbers_.least_bytes(property.type));
            if (!(length >= 0 && length <= room)) return false;
            lists_[k].resize(static_cast<std::size_t>(length));
            for (double& value : lists_[k]) {
                const auto next = numbers_.next(property.type);
                if (!next) return false;
                value = *next;
            }
        }
        return true;
    }

    Result<void> use_row(const PlyElement& element, std::uint64_t number) {
        if (element.name == "vertex") return use_point(number);
        for (std::size_t k = 0; k < element.properties.size(); ++k) {
            const std::string& name = element.properties[k].name;
            if (!element.properties[k].is_list) continue;
            if (is_one_of(name, {"vertex_indices", "vertex_index"})) {
                const bool is_strip = element.name == "tristrips";
                if (!(is_strip ? add_strips(lists_[k]) : add_polygon(lists_[k]))) {
                    return failure(fmt::format(
                        "element '{}' {} of the PLY file has a corner that is not the number of a "
                        "point",
                        element.name, number));
                }
            }
            if (name == "texcoord") add_texture(lists_[k]);
        }
        // If a face has more or fewer texture coordinates than corners, the coordinates of all
        // later faces would go to wrong corners.
        corners_have_texture_ =
            corners_have_texture_ && soup_.texture.size() == soup_.corners.size();
        return {};
    }

    Result<void> use_point(std::uint64_t number) {
        if (std::min({columns_.place[0], columns_.place[1], columns_.place[2]}) < 0) {
            return failure("the points of the PLY file lack x, y or z");
        }
        if (number >= most_numbered_points) return failure("the PLY file has too many points");
        const auto at = [&](int column) { return row_[static_cast<std::size_t>(column)]; };
        soup_.points.push_back(
            {at(columns_.place[0]), at(columns_.place[1]), at(columns_.place[2])});
        if (has_point_texture_) {
            point_texture_.push_back({static_cast<float>(at(columns_.texture[0])),
                                      static_cast<float>(at(columns_.texture[1]))});
        }
        for (std::size_t k = 0; k < attribute_columns_.size(); ++k) {
            soup_.attributes[k].values.push_back(static_cast<float>(row_[attribute_columns_[k]]));
        }
        return {};
    }

    bool add_corner(double number) {
        if (!(number >= 0 && number < most_numbered_points) || number != std::floor(number))
            return false;
        soup_.corners.push_back(static_cast<std::uint32_t>(number));
        return true;
    }

    bool add_polygon(const std::vector<double>& corners) {
        for (const double corner : corners) {
            if (!add_corner(corner)) return false;
        }
        soup_.ends.push_back(soup_.corners.size());
        return true;
    }

    /// Adds triangle strips. `strip` lists them one after another, separated by −1. Every second
    /// triangle of a strip is reversed.
    bool add_strips(const std::vector<double>& strip) {
        std::size_t begin = 0;
        for (std::size_t k = 0; k < strip.size(); ++k) {
            if (strip[k] == -1) {
                begin = k + 1;
            } else if (k >= begin + 2) {
                const bool turned = (k - begin) % 2 == 1;
                if (!add_polygon(
                        {strip[turned ? k - 1 : k - 2], strip[turned ? k - 2 : k - 1], strip[k]})) {
                    return false;
                }
            }
        }
        return true;
    }

    /// Adds the texture coordinates of the latest polygon.
    void add_texture(const std::vector<double>& places) {
        for (std::size_t k = 0; k + 1 < places.size(); k += 2) {
            soup_.texture.push_back(
                {static_cast<float>(places[k]), static_cast<float>(places[k + 1])});
        }
    }

    const PlyHeader& header_;
    NumberReader numbers_;
    PolygonSoup soup_;
    PointColumns columns_;
    bool has_point_texture_ = false;
    bool corners_have_texture_ = true;
    std::vector<TexturePlace> point_texture_;
    std::vector<std::size_t> attribute_columns_;
    std::vector<double> row_;                 ///< Scalars of the current element.
    std::vector<std::vector<double>> lists_;  ///< Lists of the current element.
};

}  // namespace

Result<PolygonSoup> read_ply(std::string_view bytes) {
    const Result<PlyHeader> header = read_ply_header(bytes);
    if (!header) return tl::unexpected(header.error());
    return PlyReader(bytes, *header).read();
}

}  // namespace cascade
