// The settings of the picture block for a surface, besides its colour: roughness, metalness,
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

/// The values of these settings in all cells (in a volume, of all slices), in the run's precision.
/// The fields of a missing setting are empty.
struct MaterialFields {
    OfParts<Field> parts;  ///< Not clamped. Emission has three fields or none.
    Field height;          ///< The height above the surface, in script units.
};

/// Evaluates a formula in all cells. Returns one field, or three for a colour.
using EvaluateFormula = std::function<std::vector<Field>(const Formula&)>;

/// The values of a setting of the picture block in a stage. Empty if the setting is missing or
/// reads a stage after `last_stage`.
std::vector<Field> setting_values(const Script& script, std::string_view setting,
                                  const EvaluateFormula& evaluate, std::uint32_t stage,
                                  std::uint32_t last_stage);

/// Evaluates all settings of a material in a stage of fields. A setting that reads a stage after
/// `last_stage` counts as missing.
MaterialFields material_fields(const Script& script, const EvaluateFormula& evaluate,
                               std::uint32_t stage, std::uint32_t last_stage);

/// The values of a material in each cell, in the order in which files list the cells.
struct Material {
    OfParts<std::vector<float>> parts;  ///< 0 … 1.
    std::vector<float> heights;         ///< May contain values that are not finite.
    std::vector<std::string> doubts;  ///< A sentence for each setting with values outside of 0 … 1.

    Material() = default;
    /// `in_order` returns the values of all cells of a field. For `inside`, see FlatCells. Values
    /// are clamped to 0 … 1. NaN is replaced by the default of the setting.
    Material(const MaterialFields& fields,
             const std::function<std::vector<double>(const Field&)>& in_order,
             std::span<const std::uint8_t> inside = {});

    MaterialCells cells() const;
};

/// The names of the material's settings in the picture block, in quotes and joined: "'height' and
/// 'opacity'". Empty if it has none.
std::string material_said(const Script& script);

/// The maps of a baked picture of fields: one for each setting in the script, and the occlusion by
/// bumps.
MapSet maps_said(const Script& script, bool has_bumps);

}  // namespace cascade
