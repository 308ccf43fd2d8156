// Reads files of presets of VisualPDE, and completes presets by their parents.
#include "import/visual_pde_presets.h"

#include "core/near_name.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>

namespace cascade::importing {

namespace {

using nlohmann::json;

constexpr std::size_t most_parents = 20;

bool is_name_letter(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_' || letter == '$';
}

/// Rewrites an object literal of JavaScript as JSON. Keys may be names, texts may have single
/// quotes, and commas may follow the last member. The parser of JSON refuses all other deviations
/// from JSON.
class ObjectLiteral {
public:
    ObjectLiteral(std::string_view text, std::size_t begin) : text_(text), at_(begin) {}

    /// Empty if the object has no end.
    std::optional<std::string> as_json() {
        int depth = 0;
        do {
            if (at_ >= text_.size()) return std::nullopt;
            const char letter = text_[at_];
            if (letter == '"' || letter == '\'') {
                if (!add_text(letter)) return std::nullopt;
            } else if (is_comment()) {
                skip_comment();
            } else if (is_name_letter(letter) || letter == '.') {
                add_word();
            } else {
                depth += letter == '{' || letter == '[';
                depth -= letter == '}' || letter == ']';
                const bool closes = letter == '}' || letter == ']';
                if (closes && json_.ends_with(',')) json_.pop_back();
                if (static_cast<unsigned char>(letter) > ' ') json_ += letter;
                ++at_;
            }
        } while (depth > 0);
        return std::move(json_);
    }
    std::size_t end() const { return at_; }

private:
    bool is_comment() const {
        const std::string_view next = text_.substr(at_, 2);
        return next == "//" || next == "/*";
    }
    void skip_comment() {
        const bool is_line = text_[at_ + 1] == '/';
        const std::size_t end = text_.find(is_line ? "\n" : "*/", at_ + 2);
        at_ = end == std::string_view::npos ? text_.size() : end + (is_line ? 1 : 2);
    }
    /// Returns false if the text has no end.
    bool add_text(char quote) {
        json_ += '"';
        for (++at_; at_ < text_.size() && text_[at_] != quote; ++at_) {
            const char letter = text_[at_];
            if (letter == '\\' && at_ + 1 < text_.size()) {
                const char next = text_[++at_];
                if (next == '\n') continue;
                if (std::string_view("\"\\/bfnrtu").find(next) != std::string_view::npos) {
                    json_ += '\\';
                }
                json_ += next;
            } else {
                if (letter == '"') json_ += '\\';
                json_ += letter;
            }
        }
        json_ += '"';
        return at_++ < text_.size();
    }
    /// Adds a number, or a name. A name before a colon is a key.
    void add_word() {
        const std::size_t begin = at_;
        while (at_ < text_.size() && (is_name_letter(text_[at_]) || text_[at_] == '.')) ++at_;
        const std::string_view word = text_.substr(begin, at_ - begin);
        std::size_t next = at_;
        while (next < text_.size() && static_cast<unsigned char>(text_[next]) <= ' ') ++next;
        const bool is_key = next < text_.size() && text_[next] == ':';
        if (is_key) {
            json_ += fmt::format("\"{}\"", word);
        } else if (word.starts_with("0x")) {
            json_ += std::to_string(std::strtoull(std::string(word).c_str(), nullptr, 16));
        } else {
            json_ += word.starts_with('.') ? "0" : "";
            json_ += word;
        }
    }

    std::string_view text_;
    std::size_t at_;
    std::string json_;
};

json parsed(const std::string& text) { return json::parse(text, nullptr, false); }

/// The statements presets["NAME"] = {…} of a text.
std::optional<std::vector<VisualPdePreset>> statements_of(std::string_view text,
                                                          std::size_t& wrong) {
    constexpr std::string_view begins = "presets[";
    std::vector<VisualPdePreset> all;
    std::size_t at = 0;
    while ((at = text.find(begins, at)) != std::string_view::npos) {
        at += begins.size();
        const char quote = at < text.size() ? text[at] : ' ';
        const std::size_t end = text.find(quote, std::min(at + 1, text.size()));
        if ((quote != '"' && quote != '\'') || end == std::string_view::npos) continue;
        std::size_t next = end + 1;
        for (const char sign : {']', '='}) {
            if (next < text.size() && text[next] == sign) ++next;
            while (next < text.size() && static_cast<unsigned char>(text[next]) <= ' ') ++next;
        }
        if (next >= text.size() || text[next] != '{') continue;
        ObjectLiteral literal(text, next);
        const auto written = literal.as_json();
        json options = written ? parsed(*written) : json(json::value_t::discarded);
        if (!options.is_object()) {
            wrong = at - begins.size();
            return std::nullopt;
        }
        all.push_back({std::string(text.substr(at + 1, end - at - 1)), std::move(options)});
        at = literal.end();
    }
    return all.empty() ? std::nullopt : std::optional(std::move(all));
}

/// The present key of an option whose key VisualPDE has changed, such as diffusionStr_1_2 for
/// diffusionStrUV. Empty for other keys.
std::string key_of_old_option(std::string_view key) {
    constexpr std::pair<std::string_view, std::string_view> old_keys[] = {
        {"boundaryConditions", "boundaryConditions"},
        {"clearValue", "initCond"},
        {"comboStr", "comboStr"},
        {"diffusionStr", "diffusionStr"},
        {"dirichletStr", "dirichletStr"},
        {"neumannStr", "neumannStr"},
        {"reactionStr", "reactionStr"},
        {"robinStr", "robinStr"},
    };
    if (key == "fixRandSeed") return "setSeed";
    for (const auto& [old, now] : old_keys) {
        const std::size_t letters = old == "diffusionStr" ? 2 : 1;
        if (!key.starts_with(old) || key.size() != old.size() + letters) continue;
        std::string made(now);
        for (const char letter : key.substr(old.size())) {
            const std::size_t number = std::string_view("UVWQ").find(letter);
            if (number == std::string_view::npos) return "";
            made += fmt::format("_{}", number + 1);
        }
        return made;
    }
    return "";
}

/// Moves options with old keys to their present keys, unless the preset has both.
json with_present_keys(const json& options) {
    json made = options;
    for (const auto& [key, value] : options.items()) {
        const std::string now = key_of_old_option(key);
        if (now.empty()) continue;
        if (!options.contains(now)) made[now] = value;
        made.erase(key);
    }
    return made;
}

}  // namespace

std::optional<std::vector<VisualPdePreset>> visual_pde_presets(std::string_view text,
                                                               std::size_t& wrong) {
    wrong = 0;
    if (auto statements = statements_of(text, wrong)) return statements;
    json whole = parsed(std::string(text));
    if (!whole.is_object()) return std::nullopt;
    const bool has_many =
        !whole.empty() &&
        std::all_of(whole.begin(), whole.end(), [](const json& each) { return each.is_object(); });
    if (!has_many) {
        const auto name = whole.find("preset");
        const bool is_named = name != whole.end() && name->is_string();
        return {{{is_named ? name->get<std::string>() : "", std::move(whole)}}};
    }
    std::vector<VisualPdePreset> all;
    for (const auto& [name, options] : whole.items()) all.push_back({name, options});
    return all;
}

const VisualPdePreset* preset_named(const std::vector<VisualPdePreset>& presets,
                                    std::string_view name) {
    const auto found = std::find_if(presets.begin(), presets.end(), [&](const auto& each) {
        return std::equal(each.name.begin(), each.name.end(), name.begin(), name.end(),
                          [](unsigned char a, unsigned char b) {
                              return std::tolower(a) == std::tolower(b);
                          });
    });
    return found == presets.end() ? nullptr : &*found;
}

std::string names_like(const std::vector<VisualPdePreset>& presets, const std::string& name) {
    std::vector<std::string> names;
    for (const auto& each : presets) names.push_back(plain_line(each.name));
    const std::string near = nearest_name(name, names);
    if (!near.empty()) return fmt::format("did you mean '{}'?", near);
    constexpr std::size_t most_shown = 8;
    std::string list;
    for (std::size_t k = 0; k < std::min(names.size(), most_shown); ++k) {
        list += (k == 0 ? "" : ", ") + names[k];
    }
    return "its presets are " + list + (names.size() > most_shown ? ", …" : "");
}

std::optional<json> with_parents(Import& import, const VisualPdePreset& preset,
                                 const std::vector<VisualPdePreset>& known) {
    json options = with_present_keys(preset.options);
    const VisualPdePreset* child = &preset;
    for (std::size_t depth = 0;; ++depth) {
        const auto parent = child->options.find("parent");
        const bool has_parent = parent != child->options.end() && parent->is_string() &&
                                *parent != "" && *parent != "default";
        if (!has_parent) return options;
        const std::string name = plain_line(parent->get<std::string>());
        child = preset_named(known, name);
        if (child == nullptr) {
            import.diagnostics.error(
                {import.source, 0, 0},
                fmt::format("this preset changes another preset, '{}', which is missing", name),
                "give VisualPDE's file of presets, as in --presets presets.js, or import the link "
                "that 'Share' gives");
            return std::nullopt;
        }
        if (depth == most_parents) {
            import.diagnostics.error({import.source, 0, 0},
                                     fmt::format("the preset '{}' is based on too many other "
                                                 "presets, or on itself",
                                                 name));
            return std::nullopt;
        }
        const json inherited = with_present_keys(child->options);
        for (const auto& [key, value] : inherited.items()) {
            if (!options.contains(key)) options[key] = value;
        }
    }
}

}  // namespace cascade::importing
