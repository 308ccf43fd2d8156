// The presets of VisualPDE in a file (internal to the reader of its options).
#pragma once

#include "import/importer.h"

#include <nlohmann/json.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::importing {

/// The options of a simulation by VisualPDE's keys.
struct VisualPdePreset {
    std::string name;  ///< Empty if the file does not give it.
    nlohmann::json options;
};

inline constexpr std::size_t largest_visual_pde = std::size_t{1} << 22;

/// The presets in a text. The text is the JSON of one preset, a JSON object of presets by name, or
/// statements of JavaScript such as presets["NAME"] = {…}, as VisualPDE's file presets.js contains
/// them and VisualPDE copies them. Empty for any other text. Then `wrong` is the position of the
/// first statement whose value cannot be read, or 0.
std::optional<std::vector<VisualPdePreset>> visual_pde_presets(std::string_view text,
                                                               std::size_t& wrong);

/// The options of the preset. Options that it lacks come from its parent, the parent of its parent,
/// and so on. Reports an error at the beginning of the import if a parent is missing from `known`
/// or if parents form a ring.
std::optional<nlohmann::json> with_parents(Import& import, const VisualPdePreset& preset,
                                           const std::vector<VisualPdePreset>& known);

/// The preset of this name, ignoring case; null if there is none.
const VisualPdePreset* preset_named(const std::vector<VisualPdePreset>& presets,
                                    std::string_view name);

/// A hint with a preset's name that is similar to `name` or, if there is none, with the first
/// names.
std::string names_like(const std::vector<VisualPdePreset>& presets, const std::string& name);

}  // namespace cascade::importing
