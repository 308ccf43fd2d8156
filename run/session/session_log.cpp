// Each change is one line. If a script has several lines, they follow a line that gives their
// number.
#include "run/session/session_log.h"

#include "core/base64.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <utility>

namespace cascade {
namespace {

constexpr std::string_view first_line = "cascade session 1";

/// Replaces the line breaks of an expression with blanks.
std::string in_one_line(std::string text) {
    std::replace(text.begin(), text.end(), '\n', ' ');
    std::replace(text.begin(), text.end(), '\r', ' ');
    return text;
}

std::string counted_lines(const std::string& text) {
    const auto breaks = std::count(text.begin(), text.end(), '\n');
    return fmt::format("{}\n{}\n", breaks + 1, text);
}

/// Encodes the bytes of numbers, the least significant byte first, in base64.
template <typename Number>
std::string in_base64(const std::vector<double>& values) {
    static_assert(std::endian::native == std::endian::little);
    std::string bytes(values.size() * sizeof(Number), '\0');
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto number = static_cast<Number>(values[k]);
        std::memcpy(bytes.data() + k * sizeof number, &number, sizeof number);
    }
    return base64(bytes);
}
template <typename Number>
std::optional<std::vector<double>> out_of_base64(std::string_view text) {
    const auto bytes = from_base64(text);
    if (!bytes || bytes->size() % sizeof(Number) != 0) return std::nullopt;
    std::vector<double> values(bytes->size() / sizeof(Number));
    for (std::size_t k = 0; k < values.size(); ++k) {
        Number number;
        std::memcpy(&number, bytes->data() + k * sizeof number, sizeof number);
        values[k] = number;
    }
    return values;
}

constexpr std::string_view binary32 = "f32 ", binary64 = "f64 ";

/// Writes numbers in binary32 if this loses nothing, and otherwise in binary64.
std::string print_values(const std::vector<double>& values) {
    const bool is_single = std::all_of(values.begin(), values.end(), [](double value) {
        return static_cast<double>(static_cast<float>(value)) == value || value != value;
    });
    return is_single ? std::string(binary32).append(in_base64<float>(values))
                     : std::string(binary64).append(in_base64<double>(values));
}
std::optional<std::vector<double>> read_values(std::string_view text) {
    if (text.starts_with(binary32)) return out_of_base64<float>(text.substr(binary32.size()));
    if (text.starts_with(binary64)) return out_of_base64<double>(text.substr(binary64.size()));
    return std::nullopt;
}

std::string print(const Change& change) {
    if (const auto* text = std::get_if<SetText>(&change)) {
        return "text " + counted_lines(text->text);
    }
    if (const auto* number = std::get_if<SetNumber>(&change)) {
        return fmt::format("set {}={}\n", number->name, in_one_line(number->expression));
    }
    if (const auto* paint = std::get_if<Paint>(&change)) {
        return fmt::format("paint {}={}\n", paint->item, in_one_line(paint->expression));
    }
    if (const auto* set = std::get_if<SetValues>(&change)) {
        return fmt::format("values {}={}\n", set->item, print_values(set->values));
    }
    return "next\n";
}

/// Reads the lines of a log one by one.
class LogReader {
public:
    explicit LogReader(std::string_view text) : rest_(text) {}

    bool at_end() const { return rest_.empty(); }

    /// Drops the last line if it has no line break.
    void leave_out_cut_line() { rest_ = rest_.substr(0, rest_.rfind('\n') + 1); }

    std::string_view line() {
        ++number_;
        const std::size_t end = std::min(rest_.find('\n'), rest_.size());
        const std::string_view line = rest_.substr(0, end);
        rest_.remove_prefix(std::min(end + 1, rest_.size()));
        return line;
    }

    /// Reads `count` lines, and returns them without the last line break.
    std::optional<std::string> lines(std::string_view count) {
        const auto wanted = whole(count);
        if (!wanted || *wanted < 1) return std::nullopt;
        std::string text;
        for (std::int64_t k = 0; k < *wanted; ++k) {
            if (at_end()) return std::nullopt;
            if (k > 0) text += '\n';
            text += line();
        }
        return text;
    }

    static std::optional<std::int64_t> whole(std::string_view word) {
        std::int64_t number = 0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), number);
        if (read.ec != std::errc() || read.ptr != word.data() + word.size()) return std::nullopt;
        return number < 0 ? std::nullopt : std::optional(number);
    }

    /// Reads a moment, "1 250": the number of the stage, counted from 1, and the number of steps.
    static std::optional<RunPlace> place(std::string_view words) {
        const std::size_t blank = words.find(' ');
        if (blank == std::string_view::npos) return std::nullopt;
        const auto stage = whole(words.substr(0, blank));
        const auto steps = whole(words.substr(blank + 1));
        if (!stage || !steps || *stage < 1 || *stage > UINT32_MAX) return std::nullopt;
        return RunPlace{static_cast<std::uint32_t>(*stage - 1), *steps};
    }

    auto wrong(std::string_view why) const {
        return failure(fmt::format("line {} of the session: {}", number_, why),
                       "sessions are written by ':save NAME.session', not by hand");
    }

private:
    std::string_view rest_;
    int number_ = 0;
};

/// Splits a line into the word before the first blank and the text after it.
std::pair<std::string_view, std::string_view> split(std::string_view line) {
    const std::size_t blank = line.find(' ');
    if (blank == std::string_view::npos) return {line, {}};
    return {line.substr(0, blank), line.substr(blank + 1)};
}

/// Splits "NAME=EXPRESSION" at the first "=".
std::optional<std::pair<std::string, std::string>> assignment(std::string_view words) {
    const std::size_t equals = words.find('=');
    if (equals == std::string_view::npos || equals == 0) return std::nullopt;
    return std::pair(std::string(words.substr(0, equals)), std::string(words.substr(equals + 1)));
}

/// Reads the change in a line. Returns an empty optional if the line contains no change.
std::optional<Change> read_change(std::string_view word, std::string_view rest, LogReader& reader) {
    if (word == "next" && rest.empty()) return NextStage{};
    if (word == "text") {
        auto text = reader.lines(rest);
        if (!text) return std::nullopt;
        return SetText{std::move(*text)};
    }
    const auto parts = assignment(rest);
    if (parts && word == "set") return SetNumber{parts->first, parts->second};
    if (parts && word == "paint") return Paint{parts->first, parts->second};
    if (parts && word == "values") {
        auto values = read_values(parts->second);
        if (values) return SetValues{parts->first, *std::move(values)};
    }
    return std::nullopt;
}

}  // namespace

bool is_session_log(std::string_view text) {
    return text.starts_with(first_line) && text.substr(first_line.size()).starts_with('\n');
}

std::string print_place(std::string_view word, RunPlace place) {
    return fmt::format("{} {} {}\n", word, place.stage + 1, place.steps);
}

std::string print_session_beginning(const SessionLog& log) {
    return fmt::format("{}\nname {}\noptions {}\nscript {}", first_line, in_one_line(log.name),
                       overrides_to_json(log.overrides), counted_lines(log.text));
}

std::string print_logged_changes(const SessionLog& log, std::size_t first,
                                 std::optional<RunPlace>& at) {
    std::string text;
    for (std::size_t k = first; k < log.changes.size(); ++k) {
        const LoggedChange& logged = *log.changes[k];
        if (at != logged.at) text += print_place("at", logged.at);
        at = logged.at;
        text += print(logged.change);
    }
    return text;
}

std::string print_session_log(const SessionLog& log) {
    std::optional<RunPlace> at;
    return print_session_beginning(log) + print_logged_changes(log, 0, at) +
           print_place("end", log.end);
}

Result<SessionLog> parse_session_log(std::string_view text) {
    LogReader reader(text);
    if (reader.line() != first_line) {
        return reader.wrong(fmt::format("it should be '{}'", first_line));
    }
    SessionLog log;
    const auto header = [&](std::string_view word) -> std::optional<std::string_view> {
        const auto [first, rest] = split(reader.line());
        return first == word ? std::optional(rest) : std::nullopt;
    };
    const auto name = header("name");
    if (!name) return reader.wrong("it should begin with 'name'");
    log.name = *name;
    const auto options = header("options");
    if (!options) return reader.wrong("it should begin with 'options'");
    auto overrides = overrides_from_json(std::string(*options));
    if (!overrides) return reader.wrong(overrides.error().message);
    log.overrides = std::move(*overrides);
    const auto count = header("script");
    auto script = count ? reader.lines(*count) : std::nullopt;
    if (!script) return reader.wrong("it should be 'script' and the number of its lines");
    log.text = std::move(*script);
    RunPlace at;
    bool is_open = false;
    while (!reader.at_end()) {
        const auto [word, rest] = split(reader.line());
        if (word == "open" && rest.empty()) {
            is_open = true;
            reader.leave_out_cut_line();
            continue;
        }
        if (word == "keep" && is_open) {
            const auto kept = LogReader::whole(rest);
            if (!kept || static_cast<std::size_t>(*kept) > log.changes.size())
                return reader.wrong("it undoes more changes than there are above it");
            log.changes.resize(static_cast<std::size_t>(*kept));
            continue;
        }
        if (word == "at" || word == "end") {
            const auto place = LogReader::place(rest);
            if (!place) return reader.wrong("it should name a stage and a step, as in 'at 1 250'");
            at = *place;
            if (word == "at") continue;
            log.end = at;
            if (!reader.at_end()) return reader.wrong("something follows the end");
            return log;
        }
        auto change = read_change(word, rest, reader);
        if (!change && is_open && word == "text" && reader.at_end()) break;
        if (!change) return reader.wrong("it is not a change of a session");
        if (log.changes.size() == most_logged_changes)
            return reader.wrong("there are too many changes");
        log.changes.push_back(
            std::make_shared<const LoggedChange>(LoggedChange{at, std::move(*change)}));
    }
    if (!is_open) return reader.wrong("the session has no end");
    log.end = at;
    return log;
}

}  // namespace cascade
