// The settings of the picture block for a surface other than its colour: roughness, metalness,
// opacity, emission and height.
#pragma once

#include "core/palette.h"
#include "core/plane.h"
#include "export/material.h"
#include "run/script/script.h"

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The values of the settings of a material in all cells, in the run's precision. In a volume,
/// these are the cells of all slices. The fields of a missing setting are empty.
struct MaterialFields {
    OfParts<Field> parts;  ///< Values that are not clamped. Emission has three fields or none.
    Field height;          ///< The height above the surface, in script units.
};

/// Evaluates a formula in all cells. Returns one field, or three for a colour.
using EvaluateFormula = std::function<std::vector<Field>(const Formula&)>;

/// Evaluates a setting of the picture block in a stage. Returns no fields if the setting is missing
/// or reads a stage after `last_stage`.
std::vector<Field> setting_values(const Script& script, std::string_view setting,
                                  const EvaluateFormula& evaluate, std::uint32_t stage,
                                  std::uint32_t last_stage);

/// Evaluates all settings of a material in a stage of fields. A setting that reads a stage after
/// `last_stage` counts as missing.
MaterialFields material_fields(const Script& script, const EvaluateFormula& evaluate,
                               std::uint32_t stage, std::uint32_t last_stage);

/// The values of a material in each cell, in the order in which files list the cells.
struct Material {
    OfParts<std::vector<float>> parts;  ///< Values from 0 to 1.
    std::vector<float> heights;         ///< May contain values that are not finite.
    /// For each setting with values outside of 0 … 1, a sentence about this.
    std::vector<std::string> doubts;

    Material() = default;
    /// `in_order` returns the values of all cells of a field. `inside` is explained in FlatCells.
    /// Values are clamped to 0 … 1. NaN is replaced by the default of the setting.
    Material(const MaterialFields& fields,
             const std::function<std::vector<double>(const Field&)>& in_order,
             std::span<const std::uint8_t> inside = {});

    MaterialCells cells() const;
};

/// Lists the names of the material's settings in the picture block, in quotes: "'height' and
/// 'opacity'". Returns an empty string if the picture block has no such settings.
std::string material_said(const Script& script);

/// Returns the maps of a baked picture of fields: a map for each setting in the script, and a map
/// of the occlusion by bumps if `has_bumps` is true.
MapSet maps_said(const Script& script, bool has_bumps);

}  // namespace cascade
