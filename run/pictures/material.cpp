// Evaluates each setting as a separate formula, in the same way as the colour.
#include "run/pictures/material.h"

#include "lang/check/check.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

namespace cascade {

namespace {

/// A setting with a single number.
struct NumberSetting {
    std::string_view name;
    MaterialPart part;
    float usual;  ///< The default of the setting.
};
constexpr std::array<NumberSetting, 3> number_settings = {{
    {"roughness", MaterialPart::roughness, 0.6F},
    {"metalness", MaterialPart::metalness, 0.0F},
    {"opacity", MaterialPart::opacity, 1.0F},
}};
constexpr std::array<MaterialPart, 3> emission_parts = {MaterialPart::red, MaterialPart::green,
                                                        MaterialPart::blue};

/// Clamps the numbers of all cells to 0 … 1, and replaces NaN by `usual`. Adds to `changed` the
/// number of cells inside the domain whose numbers have changed.
std::vector<float> clamped(const std::vector<double>& values, float usual,
                           std::span<const std::uint8_t> inside, std::size_t& changed) {
    std::vector<float> result;
    result.reserve(values.size());
    for (std::size_t k = 0; k < values.size(); ++k) {
        const auto value = static_cast<float>(values[k]);
        result.push_back(std::isnan(value) ? usual : std::clamp(value, 0.0F, 1.0F));
        if (result.back() != value && (inside.empty() || inside[k] != 0)) ++changed;
    }
    return result;
}

}  // namespace

std::vector<Field> setting_values(const Script& script, std::string_view setting,
                                  const EvaluateFormula& evaluate, std::uint32_t stage,
                                  std::uint32_t last_stage) {
    const auto expression = picture_expression(script.tree, setting);
    if (!expression) return {};
    // Other errors than a name without a value yet were reported when the script was loaded, so the
    // diagnostics are ignored.
    Diagnostics unspoken;
    const auto formula = check_view(script.tree, *expression, stage, last_stage, *script.program,
                                    script.sources, unspoken);
    return formula ? evaluate(*formula) : std::vector<Field>();
}

MaterialFields material_fields(const Script& script, const EvaluateFormula& evaluate,
                               std::uint32_t stage, std::uint32_t last_stage) {
    const auto values_of = [&](std::string_view setting) {
        return setting_values(script, setting, evaluate, stage, last_stage);
    };
    MaterialFields fields;
    for (const NumberSetting& setting : number_settings) {
        auto values = values_of(setting.name);
        if (values.size() == 1) fields.parts[setting.part] = std::move(values[0]);
    }
    auto emission = values_of("emission");
    if (emission.size() == emission_parts.size()) {
        for (std::size_t k = 0; k < emission_parts.size(); ++k) {
            fields.parts[emission_parts[k]] = std::move(emission[k]);
        }
    }
    auto height = values_of("height");
    if (height.size() == 1) fields.height = std::move(height[0]);
    return fields;
}

Material::Material(const MaterialFields& fields,
                   const std::function<std::vector<double>(const Field&)>& in_order,
                   std::span<const std::uint8_t> inside) {
    for (const NumberSetting& setting : number_settings) {
        const Field& field = fields.parts[setting.part];
        if (field.empty()) continue;
        std::size_t changed = 0;
        parts[setting.part] = clamped(in_order(field), setting.usual, inside, changed);
        if (changed == 0) continue;
        const auto all = inside.empty() ? static_cast<std::ptrdiff_t>(parts[setting.part].size())
                                        : std::count(inside.begin(), inside.end(), 1);
        doubts.push_back(fmt::format(
            "the {} is not from 0 to 1 in {:.3g} % of the cells, and is clamped there",
            setting.name, 100 * static_cast<double>(changed) / static_cast<double>(all)));
    }
    for (const MaterialPart part : emission_parts) {
        const Field& field = fields.parts[part];
        // This count is not used, because colours are clamped without a message.
        std::size_t unspoken = 0;
        if (!field.empty()) parts[part] = clamped(in_order(field), 0, inside, unspoken);
    }
    if (fields.height.empty()) return;
    for (const double height : in_order(fields.height)) {
        heights.push_back(static_cast<float>(height));
    }
}

MaterialCells Material::cells() const {
    MaterialCells cells;
    for (std::size_t k = 0; k < material_parts; ++k) cells[k] = parts[k];
    return cells;
}

std::string material_said(const Script& script) {
    std::vector<std::string> names;
    for (const char* const name : {"roughness", "metalness", "opacity", "emission", "height"}) {
        if (picture_expression(script.tree, name)) names.push_back(fmt::format("'{}'", name));
    }
    return fmt::format("{}", fmt::join(names, names.size() == 2 ? " and " : ", "));
}

MapSet maps_said(const Script& script, bool has_bumps) {
    const auto says = [&](std::string_view setting) {
        return picture_expression(script.tree, setting).has_value();
    };
    MapSet maps;
    maps.heights = maps.normals = maps.occlusion = has_bumps || says("height");
    maps.roughness = says("roughness");
    maps.metalness = says("metalness");
    maps.emission = says("emission");
    maps.opacity = says("opacity") || script.program->domain.mask;
    return maps;
}

}  // namespace cascade
