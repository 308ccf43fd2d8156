// Reads the options of a simulation of VisualPDE: from a link, in which JSON with short keys is
// compressed by lz-string, or from JSON.
#include "import/lz_string.h"
#include "import/visual_pde.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade::importing {

namespace {

constexpr std::size_t largest_visual_pde = std::size_t{1} << 22;

struct OptionOfVisualPde {
    std::string_view key;
    std::string_view short_key;  ///< In links. Empty if links have the whole key.
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
        return refuse("the link has no 'options=', which contain the simulation");
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

}  // namespace

std::optional<VisualPdeOptions> VisualPdeOptions::read(Import& import) {
    const auto refuse = [&](const std::string& why, const std::string& hint = "") {
        import.diagnostics.error({import.source, 0, 0}, why, hint);
        return std::nullopt;
    };
    const bool is_link = import.bytes().starts_with("http");
    const auto text = is_link ? json_of_link(import) : std::string(import.bytes());
    if (!text) return std::nullopt;
    if (text->size() > largest_visual_pde) return refuse("this JSON has more than 4 MiB");
    const auto json = nlohmann::json::parse(*text, nullptr, false);
    if (json.is_discarded() || !json.is_object())
        return refuse("this is not the JSON of a simulation");
    const bool has_short_keys = json.contains("p");
    VisualPdeOptions options;
    bool is_known = false;
    for (const auto& [key, short_key, value] : all_options()) {
        options.values_[key] = value;
        const bool is_short = has_short_keys && !short_key.empty();
        const auto found = json.find(is_short ? short_key : key);
        if (found == json.end() || found->is_structured()) continue;
        options.values_[key] = text_of_value(*found);
        is_known = true;
    }
    if (!is_known) return refuse("this JSON has no option of VisualPDE");
    const std::string parent = plain_line(options.text("parent"));
    if (!parent.empty() && parent != "default") {
        return refuse(fmt::format("this preset changes another preset, '{}', that is not here",
                                  parent),
                      "open it in VisualPDE and import the link that 'Share' gives");
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
