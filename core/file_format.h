// The formats that Cascade writes, and how a file's name selects one (core/file_formats.def).
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

enum class FileFormat : std::uint8_t {
#define CASCADE_FORMAT(id, ending, kind, name, traits) id,
#include "core/file_formats.def"
};

/// The content of files of a format. `run -o` writes the kinds from `picture` to `cells`, both
/// included.
enum class FormatKind : std::uint8_t {
    picture,
    figure,
    film,
    model,
    cells,
    volume,
    series,
    report
};

enum class FormatTrait : std::uint16_t {
    none = 0,
    drawing = 1 << 0,       ///< Can hold a diagram.
    transparency = 1 << 1,  ///< Can hold transparent films.
    colours = 1 << 2,       ///< Can hold colours of a model's points.
    numbers = 1 << 3,
    texture = 1 << 4,  ///< Can hold texture coordinates of a model's points.
    copies = 1 << 5,   ///< Can hold copies of shapes placed on a model.
    maps = 1 << 6,     ///< Can hold textures.
    growth = 1 << 7,   ///< Can hold the changes of a model over time.
    levels = 1 << 8,   ///< Can hold all levels of detail of a model in one file.
    planes = 1 << 9,   ///< Can hold a grid of a single slice, too.
};

constexpr FormatTrait operator|(FormatTrait a, FormatTrait b) {
    return static_cast<FormatTrait>(static_cast<std::uint16_t>(a) | static_cast<std::uint16_t>(b));
}

struct FormatRow {
    FileFormat format;
    std::string_view ending;
    FormatKind kind;
    std::string_view name;
    FormatTrait traits;

    constexpr bool has(FormatTrait trait) const {
        return (static_cast<std::uint16_t>(traits) & static_cast<std::uint16_t>(trait)) != 0;
    }
};

/// All formats, in the order of the table.
consteval auto all_formats() {
    using enum FormatTrait;
    return std::array{
#define CASCADE_FORMAT(id, ending, kind, name, traits) \
    FormatRow{FileFormat::id, ending, FormatKind::kind, name, traits},
#include "core/file_formats.def"
    };
}
inline constexpr auto file_formats = all_formats();

/// The format whose ending the file's name has, ignoring case; null if there is none.
const FormatRow* find_format(const std::filesystem::path& path);
bool is_of_format(const std::filesystem::path& path, FileFormat format);
bool is_of_kind(const std::filesystem::path& path, FormatKind kind);
bool can_hold(const std::filesystem::path& path, FormatTrait trait);
inline bool is_film(const std::filesystem::path& path) {
    return is_of_kind(path, FormatKind::film);
}
/// The kind of file that `run -o` writes under this name, if any.
std::optional<FormatKind> output_kind(const std::filesystem::path& path);

/// The file-name endings of all formats of a kind, or of all formats with a trait, in table order:
/// ".svg or .pdf" with the joint "or", ".svg, .pdf" without a joint.
std::string endings_of(FormatKind kind, std::string_view joint = "");
std::string endings_of(FormatTrait trait, std::string_view joint = "");
/// The option that writes the formats of a kind or with a trait, for hints: "-o NAME.svg or .pdf".
template <typename Which>
std::string output_of(Which which) {
    return "-o NAME" + endings_of(which, "or");
}

/// The extension of a file's name with its letters A to Z in lower case, such as ".glb".
std::string lower_ending(const std::filesystem::path& path);

/// The row for a format in a table whose rows have a member `format`.
template <typename Table>
constexpr const auto* row_of(const Table& table, FileFormat format) {
    const auto found = std::find_if(table.begin(), table.end(),
                                    [&](const auto& row) { return row.format == format; });
    return found == table.end() ? nullptr : &*found;
}

/// Whether a table of writers covers every format of a kind.
template <typename Table>
constexpr bool has_all_of(const Table& table, FormatKind kind) {
    return std::all_of(file_formats.begin(), file_formats.end(), [&](const FormatRow& row) {
        return row.kind != kind || row_of(table, row.format) != nullptr;
    });
}

}  // namespace cascade
