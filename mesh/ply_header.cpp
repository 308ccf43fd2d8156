// Reads the header line by line. Each number type has two names: the original name and a name that
// contains the type's size.
#include "mesh/ply_header.h"

#include "mesh/text_words.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <optional>

namespace cascade {

namespace {

struct TypeName {
    std::string_view name;
    PlyNumber type;
};
constexpr std::array type_names = {
    TypeName{"char", PlyNumber::int8},      TypeName{"int8", PlyNumber::int8},
    TypeName{"uchar", PlyNumber::uint8},    TypeName{"uint8", PlyNumber::uint8},
    TypeName{"short", PlyNumber::int16},    TypeName{"int16", PlyNumber::int16},
    TypeName{"ushort", PlyNumber::uint16},  TypeName{"uint16", PlyNumber::uint16},
    TypeName{"int", PlyNumber::int32},      TypeName{"int32", PlyNumber::int32},
    TypeName{"uint", PlyNumber::uint32},    TypeName{"uint32", PlyNumber::uint32},
    TypeName{"float", PlyNumber::float32},  TypeName{"float32", PlyNumber::float32},
    TypeName{"double", PlyNumber::float64}, TypeName{"float64", PlyNumber::float64},
};

std::optional<PlyNumber> type_called(std::string_view name) {
    for (const TypeName& row : type_names) {
        if (row.name == name) return row.type;
    }
    return std::nullopt;
}

using Words = std::vector<std::string_view>;

class HeaderReader {
public:
    explicit HeaderReader(std::string_view bytes) : bytes_(bytes) {}

    Result<PlyHeader> read() {
        const std::size_t end = bytes_.find_first_of("\r\n");
        line_end_ = bytes_.substr(std::min(end, bytes_.size())).starts_with("\r") &&
                            !bytes_.substr(end).starts_with("\r\n")
                        ? '\r'
                        : '\n';
        if (next_line() != "ply")
            return failure("this is not a PLY file: it does not begin with 'ply'");
        bool has_format = false;
        for (;;) {
            if (at_ >= bytes_.size()) return failure("the PLY file ends before 'end_header'");
            const Words words = words_of(next_line());
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header") break;
            if (words[0] == "format") has_format = true;
            if (!read_line(words)) {
                return failure(
                    fmt::format("line {} of the PLY file's header is not understood", line_));
            }
        }
        if (!has_format) return failure("the PLY file's header names no format");
        header_.size = at_;
        return header_;
    }

private:
    std::string_view next_line() {
        const std::size_t end = std::min(bytes_.find(line_end_, at_), bytes_.size());
        std::string_view line = bytes_.substr(at_, end - at_);
        if (line.ends_with('\r')) line.remove_suffix(1);
        at_ = std::min(end + 1, bytes_.size());
        ++line_;
        return line;
    }

    bool read_line(const Words& words) {
        if (words[0] == "format") return read_format(words);
        if (words[0] == "element") return read_element(words);
        if (words[0] == "property") return read_property(words);
        return false;
    }

    bool read_format(const Words& words) {
        if (words.size() < 2) return false;
        if (words[1] == "ascii") header_.format = PlyHeader::Format::text;
        else if (words[1] == "binary_little_endian")
            header_.format = PlyHeader::Format::little_endian;
        else if (words[1] == "binary_big_endian") header_.format = PlyHeader::Format::big_endian;
        else return false;
        return true;
    }

    bool read_element(const Words& words) {
        if (words.size() != 3) return false;
        PlyElement element{std::string(words[1]), 0, {}};
        const char* end = words[2].data() + words[2].size();
        const auto [stop, fault] = std::from_chars(words[2].data(), end, element.count);
        if (fault != std::errc() || stop != end) return false;
        header_.elements.push_back(std::move(element));
        return true;
    }

    bool read_property(const Words& words) {
        if (header_.elements.empty() || words.size() < 3) return false;
        PlyProperty property;
        property.is_list = words[1] == "list";
        if (words.size() != (property.is_list ? 5u : 3u)) return false;
        const std::optional<PlyNumber> type = type_called(words[property.is_list ? 3 : 1]);
        if (!type) return false;
        property.type = *type;
        property.name = std::string(words.back());
        if (property.is_list) {
            const std::optional<PlyNumber> count = type_called(words[2]);
            if (!count || *count == PlyNumber::float32 || *count == PlyNumber::float64)
                return false;
            property.count_type = *count;
        }
        header_.elements.back().properties.push_back(std::move(property));
        return true;
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    std::size_t line_ = 0;
    char line_end_ = '\n';  ///< It is '\r' in files of old Macintosh programs.
    PlyHeader header_;
};

}  // namespace

std::size_t size_of(PlyNumber type) {
    switch (type) {
        case PlyNumber::int8:
        case PlyNumber::uint8: return 1;
        case PlyNumber::int16:
        case PlyNumber::uint16: return 2;
        case PlyNumber::int32:
        case PlyNumber::uint32:
        case PlyNumber::float32: return 4;
        case PlyNumber::float64: return 8;
    }
    return 1;
}

std::size_t PlyElement::least_bytes(bool is_text) const {
    if (is_text) return 2 * properties.size();  // At least a digit and a blank for each property.
    std::size_t bytes = 0;
    for (const PlyProperty& property : properties) {
        bytes += size_of(property.is_list ? property.count_type : property.type);
    }
    return bytes;
}

Result<PlyHeader> read_ply_header(std::string_view bytes) {
    Result<PlyHeader> header = HeaderReader(bytes).read();
    if (!header) return header;
    const bool is_text = header->format == PlyHeader::Format::text;
    std::size_t left = bytes.size() - header->size + 1;  // The file may end without the last blank.
    for (const PlyElement& element : header->elements) {
        const std::size_t least = element.least_bytes(is_text);
        if (least == 0) {
            if (element.count == 0) continue;
            return failure(
                fmt::format("the PLY file has elements '{}' without properties", element.name));
        }
        if (element.count > left / least) {
            return failure(fmt::format("the PLY file is too short for {} elements '{}'",
                                       element.count, element.name),
                           "it may be truncated");
        }
        left -= element.count * least;
    }
    return header;
}

}  // namespace cascade
