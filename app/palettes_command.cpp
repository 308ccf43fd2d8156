// The command `cascade palettes` shows palettes as bars of colour in a terminal, as lines in a
// pipe, or as a sheet.
#include "app/commands.h"

#include "app/exit_status.h"
#include "core/file.h"
#include "core/near_name.h"
#include "core/palette.h"
#include "picture/drawing.h"
#include "picture/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

namespace cascade {

namespace {

constexpr int columns_of_bar = 32, width_of_name = 12;

/// Draws a bar in 24-bit colour. Each character shows two colours: a half block on the left, and
/// the background on the right.
std::string bar_in_terminal(const Palette& palette) {
    const auto channels = [&](int place) {
        const Colour colour = colour_at(palette, (place + 0.5) / (2 * columns_of_bar));
        const auto level = [&](std::size_t k) { return std::lround(255 * colour[k]); };
        return fmt::format("{};{};{}", level(0), level(1), level(2));
    };
    std::string bar;
    for (int k = 0; k < columns_of_bar; ++k) {
        bar += fmt::format("\x1b[38;2;{}m\x1b[48;2;{}m▌", channels(2 * k), channels(2 * k + 1));
    }
    return bar + "\x1b[0m";
}

/// Returns the name and description of a palette. If the user has given a list of colours, returns
/// only the list.
std::string words_of(const Palette& palette) {
    if (palette.name.starts_with('#')) return std::string(palette.name);
    return fmt::format("{:<{}}{}", palette.name, width_of_name, palette.description);
}

Drawing sheet_of(const std::vector<const Palette*>& palettes) {
    constexpr double row = 24, bar_width = 256, margin = 12;
    Drawing sheet;
    sheet.width = 2 * margin + bar_width + 440;
    sheet.height = 2 * margin + row * static_cast<double>(palettes.size());
    sheet.add(DrawnArea{{0, 0}, sheet.width, sheet.height, {1, 1, 1}});
    for (std::size_t n = 0; n < palettes.size(); ++n) {
        const double top = margin + row * static_cast<double>(n);
        Image bar(static_cast<std::int64_t>(bar_width), 1);
        for (std::int64_t k = 0; k < bar.width; ++k) {
            bar.at(k, 0) = colour_at(*palettes[n], (static_cast<double>(k) + 0.5) / bar_width);
        }
        sheet.add(DrawnImage{{margin, top + 3}, bar_width, row - 6, std::move(bar)});
        const bool is_own = palettes[n]->name.starts_with('#');
        const double text = margin + bar_width + 12;
        sheet.add(DrawnText{{text, top + row / 2}, std::string(palettes[n]->name)});
        if (!is_own) {
            sheet.add(DrawnText{{text + 84, top + row / 2}, std::string(palettes[n]->description)});
        }
    }
    return sheet;
}

}  // namespace

int palettes_command(const Options& options, Console& console) {
    std::vector<const Palette*> shown;
    for (const std::string& word : options.words) {
        const Palette* const palette = find_palette(word);
        if (palette != nullptr) {
            shown.push_back(palette);
            continue;
        }
        std::vector<std::string> names;
        for (const Palette& each : palettes()) names.emplace_back(each.name);
        const std::string near = nearest_name(word, names);
        console.fail({fmt::format("there is no palette '{}'", word),
                      near.empty() ? "your own colours are 2 to 64 such as \"#1b2a49 #fff\""
                                   : fmt::format("did you mean '{}'?", near)});
        return exit_status::wrong_use;
    }
    if (options.words.empty()) {
        for (const Palette& each : palettes()) shown.push_back(&each);
    }
    if (!options.sheet.empty()) {
        if (auto done = write_drawing(options.sheet, sheet_of(shown)); !done) {
            console.fail(done.error());
            return exit_status::failed_run;
        }
        console.print(fmt::format("wrote {}\n", options.sheet.string()));
        return exit_status::success;
    }
    for (const Palette* const palette : shown) {
        if (console.out().colour) console.draw(bar_in_terminal(*palette) + "  ");
        console.print(words_of(*palette) + "\n");
    }
    return exit_status::success;
}

}  // namespace cascade
