// Both formats consist of nested boxes, each with a name and a length. MP4 is defined by ISO/IEC
// 14496-12, and WebM by RFC 8794 (EBML) and RFC 9559 (Matroska).
#include "film/frames_in_film.h"

#include <array>
#include <bit>
#include <cstdio>
#include <memory>
#include <span>

namespace cascade {
namespace {

struct CloseFilm {
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// The content of a box, as a range of bytes in the file.
struct Box {
    std::uint64_t name = 0;
    std::int64_t begin = 0, end = 0;
};

class BoxReader {
public:
    explicit BoxReader(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "rb")) {}

    /// The whole file as a box. Empty if the file cannot be read.
    Box whole() {
        if (!file_ || ::fseeko(file_.get(), 0, SEEK_END) != 0) return {};
        return {0, 0, ::ftello(file_.get())};
    }
    bool go_to(std::int64_t place) { return ::fseeko(file_.get(), place, SEEK_SET) == 0; }
    std::int64_t place() { return ::ftello(file_.get()); }
    /// Reads a number of `bytes` bytes, the most significant first.
    std::optional<std::uint64_t> number(int bytes) {
        std::uint64_t value = 0;
        for (int k = 0; k < bytes; ++k) {
            const int byte = std::fgetc(file_.get());
            if (byte == EOF) return std::nullopt;
            value = value << 8 | static_cast<unsigned>(byte);
        }
        return value;
    }
    /// Reads a number of EBML. The number of leading zero bits in its first byte is the number of
    /// bytes that follow. Names include the 1 bit after these zeros, and lengths do not.
    std::optional<std::uint64_t> marked_number(bool keeps_mark) {
        const auto first = number(1);
        if (!first || *first == 0) return std::nullopt;
        const int more = std::countl_zero(static_cast<std::uint8_t>(*first));
        const auto rest = number(more);
        if (!rest) return std::nullopt;
        const std::uint64_t mark = keeps_mark ? 0 : std::uint64_t{0x80} >> more;
        return (*first & ~mark) << (8 * more) | *rest;
    }

private:
    std::unique_ptr<std::FILE, CloseFilm> file_;
};

std::optional<Box> box_of_mp4(BoxReader& reader, std::int64_t place) {
    auto length = reader.number(4);
    const auto name = reader.number(4);
    if (length && *length == 1) length = reader.number(8);
    if (!length || !name || *length > INT64_MAX / 2) return std::nullopt;
    return Box{*name, reader.place(), place + static_cast<std::int64_t>(*length)};
}

std::optional<Box> box_of_webm(BoxReader& reader, std::int64_t) {
    const auto name = reader.marked_number(true);
    const auto length = name ? reader.marked_number(false) : std::nullopt;
    if (!length || *length > INT64_MAX / 2) return std::nullopt;
    return Box{*name, reader.place(), reader.place() + static_cast<std::int64_t>(*length)};
}

/// Calls visit(box) for each box inside `outer`. Returns false if the boxes do not fill `outer`
/// exactly.
template <typename Read, typename Visit>
bool for_each_box(BoxReader& reader, const Box& outer, const Read& read, const Visit& visit) {
    std::int64_t place = outer.begin;
    while (place < outer.end) {
        if (!reader.go_to(place)) return false;
        const std::optional<Box> box = read(reader, place);
        if (!box || box->end <= place || box->end > outer.end || box->begin > box->end ||
            !visit(*box)) {
            return false;
        }
        place = box->end;
    }
    return true;
}

/// The name of a box as a number. A name consists of four letters.
constexpr std::uint64_t name_of_box(const char (&letters)[5]) {
    std::uint64_t name = 0;
    for (int k = 0; k < 4; ++k) name = name << 8 | static_cast<unsigned char>(letters[k]);
    return name;
}

/// Counts samples, each of which is a frame. The box moov/trak/mdia/minf/stbl/stsz lists their
/// sizes.
bool count_in_mp4(BoxReader& reader, const Box& outer, std::size_t depth, std::int64_t& count) {
    constexpr std::array path{name_of_box("moov"), name_of_box("trak"), name_of_box("mdia"),
                              name_of_box("minf"), name_of_box("stbl"), name_of_box("stsz")};
    return for_each_box(reader, outer, box_of_mp4, [&](const Box& box) {
        if (box.name != path[depth]) return true;
        if (depth + 1 < path.size()) return count_in_mp4(reader, box, depth + 1, count);
        // Skips version, flags and the size that all samples share (or 0). Reads the number of
        // samples.
        const auto samples = reader.number(8) ? reader.number(4) : std::nullopt;
        count += static_cast<std::int64_t>(samples.value_or(0));
        return samples.has_value();
    });
}

/// Counts blocks, each of which is a frame. Blocks are in the clusters of the segment, and blocks
/// with alpha are in groups there.
bool count_in_webm(BoxReader& reader, const Box& outer, std::int64_t& count) {
    constexpr std::uint64_t segment = 0x18538067, cluster = 0x1f43b675, group = 0xa0, simple = 0xa3;
    return for_each_box(reader, outer, box_of_webm, [&](const Box& box) {
        if (box.name == segment || box.name == cluster) return count_in_webm(reader, box, count);
        if (box.name == group || box.name == simple) ++count;
        return true;
    });
}

}  // namespace

std::optional<std::int64_t> frames_in_film(const std::filesystem::path& path, bool is_webm) {
    BoxReader reader(path);
    const Box whole = reader.whole();
    std::int64_t count = 0;
    const bool is_whole = whole.end > 0 && (is_webm ? count_in_webm(reader, whole, count)
                                                    : count_in_mp4(reader, whole, 0, count));
    if (!is_whole || count == 0) return std::nullopt;
    return count;
}

}  // namespace cascade
