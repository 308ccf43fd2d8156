// Looks for a format whose ending is the last two parts of a file's name, such as ".cells.vtp",
// before one whose ending is the last part alone.
#include "core/file_format.h"

#include <vector>

namespace cascade {

namespace {

const FormatRow* format_of_ending(std::string_view ending) {
    const auto found = std::find_if(file_formats.begin(), file_formats.end(),
                                    [&](const FormatRow& row) { return row.ending == ending; });
    return found == file_formats.end() ? nullptr : &*found;
}

template <typename Wanted>
std::string listed(std::string_view joint, Wanted is_wanted) {
    std::vector<std::string_view> endings;
    for (const FormatRow& row : file_formats) {
        if (is_wanted(row)) endings.push_back(row.ending);
    }
    std::string text;
    for (const std::string_view& ending : endings) {
        const bool is_last = &ending == &endings.back() && !joint.empty();
        if (!text.empty()) text += is_last ? " " + std::string(joint) + " " : ", ";
        text += ending;
    }
    return text;
}

}  // namespace

std::string lower_ending(const std::filesystem::path& path) {
    std::string ending = path.extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    return ending;
}

const FormatRow* find_format(const std::filesystem::path& path) {
    const std::string last = lower_ending(path);
    const FormatRow* const whole = format_of_ending(lower_ending(path.stem()) + last);
    return whole ? whole : format_of_ending(last);
}

bool is_of_format(const std::filesystem::path& path, FileFormat format) {
    const FormatRow* const row = find_format(path);
    return row && row->format == format;
}

bool is_of_kind(const std::filesystem::path& path, FormatKind kind) {
    const FormatRow* const row = find_format(path);
    return row && row->kind == kind;
}

bool can_hold(const std::filesystem::path& path, FormatTrait trait) {
    const FormatRow* const row = find_format(path);
    return row && row->has(trait);
}

std::optional<FormatKind> output_kind(const std::filesystem::path& path) {
    const FormatRow* const row = find_format(path);
    if (!row || row->kind > FormatKind::cells) return std::nullopt;
    return row->kind;
}

std::string endings_of(FormatKind kind, std::string_view joint) {
    return listed(joint, [&](const FormatRow& row) { return row.kind == kind; });
}

std::string endings_of(FormatTrait trait, std::string_view joint) {
    return listed(joint, [&](const FormatRow& row) { return row.has(trait); });
}

}  // namespace cascade
