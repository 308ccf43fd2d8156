// Reads STL files (3D Systems, "StereoLithography Interface Specification", 1989), text or binary.
// A file is binary if its size matches its number of triangles, or if it is longer and does not
// look like text.
#include "mesh/model_file.h"
#include "mesh/point_table.h"
#include "mesh/text_words.h"

#include <fmt/format.h>

#include <bit>
#include <optional>

namespace cascade {

namespace {

constexpr std::size_t head_size = 84, triangle_size = 50;  ///< Sizes in bytes in a binary file.

/// Collects triangles with separate points, and merges points at the same position.
class MergedSoup {
public:
    MergedSoup() = default;
    MergedSoup(const MergedSoup&) = delete;  // The table refers to the points.
    MergedSoup& operator=(const MergedSoup&) = delete;

    void add_corner(Vector3d p) {
        soup_.points.push_back(p + Vector3d{0, 0, 0});  // −0 becomes 0.
        const auto number = static_cast<std::uint32_t>(soup_.points.size() - 1);
        soup_.corners.push_back(places_.find_or_add(number));
        if (soup_.corners.back() != number) soup_.points.pop_back();
    }
    void end_polygon() { soup_.ends.push_back(soup_.corners.size()); }
    std::size_t corners_of_last() const {
        return soup_.corners.size() - (soup_.ends.empty() ? 0 : soup_.ends.back());
    }
    PolygonSoup take() { return std::move(soup_); }

private:
    PolygonSoup soup_;
    PointTable places_{soup_.points};
};

/// The four bytes at `at`, in little-endian order as in STL files.
std::uint32_t word_at(std::string_view bytes, std::size_t at) {
    std::uint32_t word = 0;
    for (std::size_t k = 4; k-- > 0;) word = word << 8 | static_cast<unsigned char>(bytes[at + k]);
    return word;
}

PolygonSoup read_binary(std::string_view bytes, std::size_t count) {
    MergedSoup soup;
    for (std::size_t t = 0; t < count; ++t) {
        for (std::size_t k = 1; k <= 3; ++k) {  // The normal precedes the corners.
            const std::size_t at = head_size + t * triangle_size + 12 * k;
            const auto number = [&](std::size_t c) {
                return static_cast<double>(std::bit_cast<float>(word_at(bytes, at + 4 * c)));
            };
            soup.add_corner({number(0), number(1), number(2)});
        }
        soup.end_polygon();
    }
    return soup.take();
}

bool is_word(std::string_view word, std::string_view lower_case) {
    return word.size() == lower_case.size() &&
           std::equal(word.begin(), word.end(), lower_case.begin(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a + 32 : a) == b; });
}

Result<PolygonSoup> read_text(std::string_view bytes) {
    LineReader lines(bytes);
    MergedSoup soup;
    bool is_in_loop = false, is_in_solid = false;
    const auto wrong_line = [&](std::string_view why) {
        return failure(fmt::format("line {} of the STL file {}", lines.number(), why));
    };
    for (;;) {
        const std::vector<std::string_view>& words = lines.next();
        if (words.empty()) break;
        // Some programs write several facets in a line. Unknown words and the rest of their line
        // count as remarks.
        for (std::size_t at = 0; at < words.size(); ++at) {
            if (is_word(words[at], "outer")) {
                if (is_in_loop) return wrong_line("begins a loop in a loop");
                is_in_loop = true;
            } else if (is_word(words[at], "vertex")) {
                std::array<std::optional<double>, 3> numbers;
                for (std::optional<double>& number : numbers) {
                    if (++at < words.size()) number = number_in(words[at]);
                }
                if (!is_in_loop || !numbers[0] || !numbers[1] || !numbers[2]) {
                    return wrong_line("is not a corner of a triangle");
                }
                soup.add_corner({*numbers[0], *numbers[1], *numbers[2]});
            } else if (is_word(words[at], "endloop")) {
                if (!is_in_loop || soup.corners_of_last() < 3) {
                    return wrong_line("ends no triangle");
                }
                is_in_loop = false;
                soup.end_polygon();
            } else if (is_word(words[at], "facet")) {
                at += 4;  // normal x y z
            } else if (!is_word(words[at], "loop") && !is_word(words[at], "endfacet")) {
                const bool begins = is_word(words[at], "solid");
                if (!begins && !is_word(words[at], "endsolid")) break;
                is_in_solid = begins;
                // The name of a solid is skipped.
                const auto is_end = [&](std::string_view word) {
                    return begins ? is_word(word, "facet") || is_word(word, "endsolid")
                                  : is_word(word, "solid");
                };
                while (at + 1 < words.size() && !is_end(words[at + 1])) ++at;
            }
        }
    }
    if (is_in_solid || is_in_loop) {
        return failure("the STL file breaks off before 'endsolid'", "it may be truncated");
    }
    return soup.take();
}

}  // namespace

Result<PolygonSoup> read_stl(std::string_view bytes) {
    const bool has_head = bytes.size() >= head_size;
    const std::size_t count = has_head ? word_at(bytes, head_size - 4) : 0;
    const std::size_t wanted = head_size + count * triangle_size;
    // A text contains no zero byte, but the number of triangles in a binary file does.
    const bool has_number = has_head && bytes.substr(head_size - 4, 4).find('\0') != bytes.npos;
    if (has_head && bytes.size() == wanted) return read_binary(bytes, count);
    // Some programs append other data after the triangles. But if the appended data are as long as
    // the triangles, the number of triangles is probably wrong.
    const bool is_longer = bytes.size() > wanted;
    const bool has_more = is_longer && (bytes.size() - wanted) % triangle_size == 0;
    if (has_number && count > 0 && is_longer && !has_more) return read_binary(bytes, count);
    if (is_utf16(bytes)) return utf16_failure();
    const std::size_t first = std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size());
    if (!has_number && is_word(bytes.substr(first, 5), "solid")) return read_text(bytes);
    if (!has_head) return failure("this is not an STL file that can be read");
    return failure(fmt::format("the STL file is {} bytes long, but its {} triangles take {}",
                               bytes.size(), count, wanted),
                   is_longer ? "the number of triangles, in bytes 81 to 84, is too small"
                             : "it may be truncated");
}

}  // namespace cascade
