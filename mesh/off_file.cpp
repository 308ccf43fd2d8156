// Reads OFF files in text format.
#include "mesh/model_file.h"
#include "mesh/text_words.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

namespace cascade {

namespace {

/// The fewest bytes of a line, with its end.
constexpr std::size_t least_point = 6, least_face = 2;

/// The data of points besides positions, as declared by the first word.
struct Extras {
    bool texture = false, colour = false, normal = false;
};

std::optional<Extras> extras_of(std::string_view word) {
    Extras extras;
    if (word.starts_with("ST")) {
        extras.texture = true;
        word.remove_prefix(2);
    }
    if (word.starts_with('C')) {
        extras.colour = true;
        word.remove_prefix(1);
    }
    if (word.starts_with('N')) {
        extras.normal = true;
        word.remove_prefix(1);
    }
    if (word != "OFF") return std::nullopt;
    return extras;
}

class OffReader {
public:
    explicit OffReader(std::string_view bytes) : size_(bytes.size()), lines_(bytes) {}

    Result<PolygonSoup> read() {
        if (!read_head()) {
            return failure("this is not an OFF file in text form",
                           "files with OFF BINARY, 4OFF or nOFF at their beginning are not read");
        }
        if (points_ > size_ / least_point || faces_ > size_ / least_face) {
            return failure(fmt::format("the OFF file is too short for {} points and {} faces",
                                       points_, faces_),
                           "it may be truncated");
        }
        for (std::uint64_t k = 0; k < points_; ++k) {
            if (!read_point(lines_.next())) return wrong_line("the position of a point");
        }
        for (std::uint64_t k = 0; k < faces_; ++k) {
            if (!read_face(lines_.next())) return wrong_line("a face of these points");
        }
        if (soup_.points.empty()) return failure("the OFF file has no points");
        if (!extras_.colour) soup_.attributes.clear();
        return std::move(soup_);
    }

private:
    using Words = std::vector<std::string_view>;

    tl::unexpected<Failure> wrong_line(std::string_view what) const {
        return failure(fmt::format("line {} of the OFF file is not {}", lines_.number(), what));
    }

    /// Reads the word OFF, which may be missing, and the counts, which may be on the same line.
    bool read_head() {
        Words words = lines_.next();
        if (words.empty()) return false;
        const std::size_t end = words.front().find("OFF");
        const std::size_t size = end == std::string_view::npos ? words.front().size() : end + 3;
        if (const auto extras = extras_of(words.front().substr(0, size))) {
            extras_ = *extras;
            // The first count may follow the word without a blank.
            words.front().remove_prefix(size);
            if (words.front().empty()) words.erase(words.begin());
            if (words.empty()) words = lines_.next();
        }
        if (words.size() < 2) return false;
        const auto points = whole_number_in<std::uint32_t>(words[0]);
        const auto faces = whole_number_in<std::uint32_t>(words[1]);
        if (!points || !faces) return false;
        points_ = *points;
        faces_ = *faces;
        return true;
    }

    bool read_point(const Words& words) {
        numbers_.clear();
        for (const std::string_view word : words) {
            const auto number = number_in(word);
            if (!number) return false;
            numbers_.push_back(*number);
        }
        if (numbers_.size() < 3) return false;
        soup_.points.push_back({numbers_[0], numbers_[1], numbers_[2]});
        const std::size_t first = extras_.normal ? 6 : 3;
        if (!extras_.colour) return true;
        if (numbers_.size() < first + 3) return false;
        // Colours are integers of at most 255, or fractions.
        const bool is_fraction = words[first].find('.') != std::string_view::npos;
        for (std::size_t k = 0; k < 3; ++k) {
            soup_.attributes[k].values.push_back(
                static_cast<float>(numbers_[first + k] / (is_fraction ? 1 : 255)));
        }
        return true;
    }

    /// Reads the corners of a face. A colour may follow them.
    bool read_face(const Words& words) {
        if (words.empty()) return false;
        const auto count = whole_number_in<std::uint32_t>(words[0]);
        if (!count || *count > words.size() - 1) return false;
        for (std::size_t k = 1; k <= *count; ++k) {
            const auto corner = whole_number_in<std::uint32_t>(words[k]);
            if (!corner || *corner >= soup_.points.size()) return false;
            soup_.corners.push_back(*corner);
        }
        soup_.ends.push_back(soup_.corners.size());
        return true;
    }

    std::size_t size_;
    LineReader lines_;
    Extras extras_;
    std::uint64_t points_ = 0, faces_ = 0;
    std::vector<double> numbers_;
    PolygonSoup soup_{{},
                      {},
                      {},
                      {},
                      {PointAttribute{"red", {}}, PointAttribute{"green", {}},
                       PointAttribute{"blue", {}}}};
};

}  // namespace

Result<PolygonSoup> read_off(std::string_view bytes) { return OffReader(bytes).read(); }

}  // namespace cascade
