// Reads the options of a simulation of VisualPDE: from a link, in which JSON with short keys is
// compressed by lz-string, or from JSON.
#include "import/lz_string.h"
#include "import/visual_pde.h"
#include "import/visual_pde_presets.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::importing {

namespace {

struct OptionOfVisualPde {
    std::string_view key;
    std::string_view short_key;  ///< The key in links. Empty if links have the whole key.
    std::string_view value;      ///< VisualPDE's default.
};
constexpr OptionOfVisualPde options_of_visual_pde[] = {
    {"numSpecies", "n", "2"},
    {"numAlgebraicSpecies", "na", "0"},
    {"speciesNames", "sn", "u v w q"},
    {"kineticParams", "k", ""},
    {"crossDiffusion", "cD", "false"},
    {"dimension", "di", "2"},
    {"oneDimensional", "o", "false"},
    {"domainScale", "ds", "100"},
    {"spatialStep", "sp", "0.5"},
    {"domainViaIndicatorFun", "dv", "false"},
    {"domainIndicatorFun", "d", "(L_min/2)^2 - ((x-L_x/2)^2 + (y-L_y/2)^2)"},
    {"minX", "", "0"},
    {"minY", "", "0"},
    {"squareCanvas", "sq", "false"},
    {"dt", "dt", "0.1"},
    {"timesteppingScheme", "ts", "Euler"},
    {"timescales", "", "false"},
    {"globalIntegralFun", "", "0"},
    {"setSeed", "", "false"},
    {"fixRandSeed", "f", "false"},
    {"randSeed", "rs", "0"},
    {"whatToPlot", "wp", "v"},
    {"imagePathOne", "io", "./images/Sofya.webp"},
    {"imagePathTwo", "it", "./images/Alan.webp"},
    {"initialState", "iS", ""},
    {"automataMode", "", "false"},
    {"simTitle", "", ""},
    {"preset", "p", ""},
    {"parent", "pa", ""},
};

/// Options of each of the four species. The short key is followed by U, V, W or Q.
constexpr OptionOfVisualPde options_by_species[] = {
    {"boundaryConditions_", "b", "periodic"},
    {"initCond_", "c", "0"},
    {"comboStr_", "cs", ""},
    {"dirichletStr_", "d", "0"},
    {"neumannStr_", "n", "0"},
    {"reactionStr_", "r", "0"},
    {"robinStr_", "ro", "0"},
    {"timescale_", "", "1"},
};
constexpr std::pair<std::string_view, std::string_view> defaults_by_species[] = {
    {"initCond_1", "1.0"},
    {"diffusionStr_1_1", "0.04"},
    {"diffusionStr_2_2", "0.02"},
    {"diffusionStr_3_3", "0.02"},
    {"reactionStr_1", "-u*v^2 + 0.037*(1.0 - u)"},
    {"reactionStr_2", "u*v^2 - (0.037+0.06)*v"},
    {"reactionStr_3", "u*v^2 - (0.037+0.06)*v"},
};
constexpr std::string_view letters_of_species = "UVWQ";

/// All options with their short keys and defaults.
std::vector<std::tuple<std::string, std::string, std::string>> all_options() {
    std::vector<std::tuple<std::string, std::string, std::string>> all;
    for (const auto& each : options_of_visual_pde) {
        all.emplace_back(each.key, each.short_key, each.value);
    }
    for (std::size_t k = 0; k < 4; ++k) {
        for (const auto& each : options_by_species) {
            const std::string short_key =
                each.short_key.empty() ? "" : std::string(each.short_key) + letters_of_species[k];
            all.emplace_back(fmt::format("{}{}", each.key, k + 1), short_key, each.value);
        }
        for (std::size_t other = 0; other < 4; ++other) {
            all.emplace_back(fmt::format("diffusionStr_{}_{}", k + 1, other + 1),
                             fmt::format("d{}{}", letters_of_species[k], letters_of_species[other]),
                             "0");
        }
    }
    for (auto& [key, short_key, value] : all) {
        for (const auto& [changed, other] : defaults_by_species) {
            if (key == changed) value = other;
        }
    }
    return all;
}

/// The JSON of a link. Empty after an error.
std::optional<std::string> json_of_link(Import& import) {
    const auto refuse = [&](const std::string& why) {
        import.diagnostics.error({import.source, 0, 0}, why);
        return std::nullopt;
    };
    const std::string_view link = import.bytes();
    const std::size_t mark = link.find("options=");
    if (mark == std::string_view::npos) {
        return refuse("the link lacks 'options=…', which describes the simulation");
    }
    std::string letters(link.substr(mark + 8));
    letters.resize(std::min(letters.find_first_of("&# \r\n"), letters.size()));
    for (const auto& [code, letter] : {std::pair("%2B", "+"), std::pair("%24", "$")}) {
        for (std::size_t at = letters.find(code); at != std::string::npos;
             at = letters.find(code)) {
            letters.replace(at, 3, letter);
        }
    }
    auto text = from_lz_string(letters, largest_visual_pde);
    if (!text) return refuse("the options of the link are damaged or incomplete");
    return text;
}

std::string text_of_value(const nlohmann::json& value) {
    if (value.is_string()) return value.get<std::string>();
    return value.is_null() ? "" : value.dump();
}

/// Replaces the short keys of links by whole keys.
nlohmann::json with_whole_keys(const nlohmann::json& json) {
    if (!json.contains("p")) return json;
    nlohmann::json made = json;
    for (const auto& [key, short_key, value] : all_options()) {
        const auto found = short_key.empty() ? json.end() : json.find(short_key);
        if (found != json.end()) made[key] = *found;
    }
    return made;
}

/// Gives `whatToPlot` the value of the view that VisualPDE opens.
void open_view(nlohmann::json& options) {
    const auto views = options.find("views");
    if (views == options.end() || !views->is_array() || views->empty()) return;
    const auto wanted = options.find("activeViewInd");
    const bool is_number = wanted != options.end() && wanted->is_number_unsigned();
    const std::size_t index = is_number ? wanted->get<std::size_t>() : 0;
    const nlohmann::json& view = (*views)[std::min(index, views->size() - 1)];
    if (!view.is_object() || !view.contains("whatToPlot")) return;
    options["whatToPlot"] = view["whatToPlot"];
}

/// Old presets have a flag for each algebraic species instead of the number of these species.
/// Counts the flags.
void count_algebraic_species(nlohmann::json& options) {
    const auto given = options.find("numAlgebraicSpecies");
    if (given != options.end() && *given != 0 && *given != "0") return;
    int count = 0;
    for (const char* const flag : {"algebraicV", "algebraicW", "algebraicQ"}) {
        count += options.contains(flag);
    }
    if (count > 0) options["numAlgebraicSpecies"] = count;
}

/// The preset that a link without options names. Empty if the link names none.
std::string preset_in_link(std::string_view link) {
    const std::size_t mark = link.find("preset=");
    const bool has_options = link.find("options=") != std::string_view::npos;
    if (has_options || mark == std::string_view::npos) return "";
    const std::string_view rest = link.substr(mark + 7);
    return std::string(rest.substr(0, rest.find_first_of("&# \r\n")));
}

/// The preset to import: the preset of a link, the only preset of a file, or the preset that the
/// user names. `known` gets all presets that can be parents. Null after an error.
std::optional<VisualPdePreset> chosen_preset(Import& import, std::vector<VisualPdePreset>& known) {
    const auto refuse = [&](const std::string& why, const std::string& hint = "") {
        import.diagnostics.error({import.source, 0, 0}, why, hint);
        return std::nullopt;
    };
    std::string name = import.preset;
    const std::string_view link = import.bytes();
    const bool is_link = link.starts_with("http");
    if (const std::string named = is_link ? preset_in_link(link) : ""; !named.empty()) {
        name = named;
        if (!import.presets) {
            return refuse(fmt::format("the link names the preset '{}', but does not contain its "
                                      "options",
                                      plain_line(name)),
                          "give VisualPDE's file of presets, as in --presets presets.js, or the "
                          "link that 'Share' gives");
        }
    }
    const auto text = !is_link                          ? std::optional(std::string(link))
                      : name.empty() || !import.presets ? json_of_link(import)
                                                        : std::string("{}");
    if (!text) return std::nullopt;
    if (text->size() > largest_visual_pde) return refuse("this JSON has more than 4 MiB");
    std::size_t wrong = 0;
    const auto place = [&](SourceId source) {
        const auto at = static_cast<std::uint32_t>(is_link ? 0 : wrong);
        return Span{source, at, at};
    };
    auto own = visual_pde_presets(*text, wrong);
    if (!own) {
        import.diagnostics.error(place(import.source), wrong == 0
                                                           ? "this is not the JSON of a simulation"
                                                           : "this preset cannot be read");
        return std::nullopt;
    }
    known = is_link ? std::vector<VisualPdePreset>() : *own;
    if (import.presets) {
        auto more = visual_pde_presets(import.sources[*import.presets].text(), wrong);
        if (!more) {
            const auto at = static_cast<std::uint32_t>(wrong);
            import.diagnostics.error({*import.presets, at, at},
                                     wrong == 0 ? "this file has no presets of VisualPDE"
                                                : "this preset cannot be read");
            return std::nullopt;
        }
        known.insert(known.end(), more->begin(), more->end());
    }
    if (name.empty() && own->size() == 1) return own->front();
    if (name.empty()) {
        return refuse(fmt::format("the file has {} presets", own->size()),
                      "choose one with --preset NAME; " + names_like(*own, ""));
    }
    const VisualPdePreset* const found = preset_named(known, name);
    if (found == nullptr) {
        return refuse(fmt::format("there is no preset '{}'", plain_line(name)),
                      names_like(known, name));
    }
    return *found;
}

}  // namespace

std::optional<VisualPdeOptions> VisualPdeOptions::read(Import& import) {
    std::vector<VisualPdePreset> known;
    auto chosen = chosen_preset(import, known);
    if (!chosen) return std::nullopt;
    chosen->options = with_whole_keys(chosen->options);
    auto json = with_parents(import, *chosen, known);
    if (!json) return std::nullopt;
    open_view(*json);
    count_algebraic_species(*json);
    VisualPdeOptions options;
    bool is_known = false;
    for (const auto& [key, short_key, value] : all_options()) {
        options.values_[key] = value;
        const auto found = json->find(key);
        if (found == json->end() || found->is_structured()) continue;
        options.values_[key] = text_of_value(*found);
        is_known = true;
    }
    if (!is_known) {
        import.diagnostics.error({import.source, 0, 0}, "this JSON has no option of VisualPDE");
        return std::nullopt;
    }
    return options;
}

std::string VisualPdeOptions::text(const std::string& key) const {
    const auto found = values_.find(key);
    return found == values_.end() ? "" : found->second;
}

std::string VisualPdeOptions::text(std::string_view key, std::size_t species) const {
    return text(fmt::format("{}_{}", key, species + 1));
}

Span VisualPdeOptions::source(Import& import, const std::string& key) const {
    const std::string content = text(key);
    const SourceId source = import.sources.add(fmt::format("{}: {}", import.name, key), content);
    return {source, 0, static_cast<std::uint32_t>(content.size())};
}

}  // namespace cascade::importing
