// The table of options.
#include "app/foreign_options.h"

#include <fmt/format.h>

#include <charconv>

namespace cascade {

namespace {

/// `here` is the beginning of the replacement. It is followed by the value that the user has given,
/// or by `example` if there is no value.
struct ForeignOption {
    std::string_view name, here, example;
};
constexpr ForeignOption foreign_options[] = {
    {"colormap", "--palette ", "viridis"},
    {"cmap", "--palette ", "viridis"},
    {"color", "--palette ", "viridis"},
    {"colour", "--palette ", "viridis"},
    {"dt", "--set speed=", "0.1"},
    {"timestep", "--set speed=", "0.1"},
    {"time", "--set duration=", "100"},
    {"tmax", "--set duration=", "100"},
    {"t-end", "--set duration=", "100"},
    {"extent", "--set extent=", "10"},
    {"spacing", "--set spacing=", "0.5"},
    {"resolution", "--grid ", "64x64"},
    {"nx", "--grid ", "64x64"},
    {"param", "--set ", "NAME=…"},
    {"parameter", "--set ", "NAME=…"},
    {"out", "-o ", "out.png"},
    {"outfile", "-o ", "out.png"},
    {"film", "-o ", "film.webp"},
    {"movie", "-o ", "film.webp"},
    {"video", "-o ", "film.webp"},
    {"gif", "-o ", "film.gif"},
    {"gpu", "--device ", "gpu"},
    {"cuda", "--device ", "gpu"},
    {"jobs", "--threads ", "4"},
    {"cores", "--threads ", "4"},
    {"j", "--threads ", "4"},
    {"out", "--html ", "out.html"},
    {"o", "--html ", "out.html"},
};

/// Options that are not needed, and why. The advice applies only to a command that has the option
/// `needs`.
struct NeedlessOption {
    std::string_view name, needs, advice;
};
constexpr NeedlessOption needless_options[] = {
    {"port", "--no-browser", "leave it out: the page uses a free port, which is printed"},
    {"host", "--no-browser", "leave it out: only browsers of this machine can open the page"},
    {"bind", "--no-browser", "leave it out: only browsers of this machine can open the page"},
    {"open", "--no-browser", "leave it out: the browser opens by itself"},
    {"browser", "--no-browser", "leave it out: the browser opens by itself"},
    {"features", "--tile", "leave it out: features.csv has the features of every run"},
    {"dpi", "--size", "write --size 1920x1080 for the pixels of a picture"},
    {"i", "--unicode", "leave it out: the files themselves are changed"},
    {"write", "--unicode", "leave it out: the files themselves are changed"},
    {"in-place", "--unicode", "leave it out: the files themselves are changed"},
    {"inplace", "--unicode", "leave it out: the files themselves are changed"},
};

bool is_number(std::string_view text) {
    double number = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, number);
    return error == std::errc() && stop == end;
}

}  // namespace

std::string advice_about_option(std::string_view option, const std::string& value,
                                const std::function<bool(std::string_view)>& is_option,
                                bool has_near) {
    std::string_view name = option.substr(0, option.find('='));
    name.remove_prefix(std::min(name.find_first_not_of('-'), name.size()));
    for (const NeedlessOption& row : needless_options) {
        if (row.name == name && is_option(row.needs)) return std::string(row.advice);
    }
    for (const ForeignOption& row : foreign_options) {
        if (row.name != name || !is_option(row.here.substr(0, row.here.find(' ')))) continue;
        const bool is_side =
            row.here == "--grid " && value.find_first_not_of("0123456789") == std::string::npos;
        return fmt::format("write {}{}", row.here,
                           value.empty() ? row.example
                           : is_side     ? fmt::format("{0}x{0}", value)
                                         : value);
    }
    const bool is_of_script =
        !has_near && name.size() > 0 && is_option("--set") && is_number(value);
    return is_of_script ? fmt::format("write --set {}={} to set a value of the script", name, value)
                        : "";
}

}  // namespace cascade
