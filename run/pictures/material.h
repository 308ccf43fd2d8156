// The picture block's settings for a surface besides its colour: roughness, metalness, opacity,
// emission and height.
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

/// Values of all cells, also of a volume, in the run's precision. Empty for unset ones.
struct MaterialFields {
    OfParts<Field> parts;  ///< As in the formulas. Emission has all three or none.
    Field height;          ///< Above the surface, in script units.
};

/// Evaluates a formula in all cells: one field, or three for a colour.
using EvaluateFormula = std::function<std::vector<Field>(const Formula&)>;

/// The values of a setting of the picture block in a stage. Empty if it is not set, or if it names
/// a stage after `last_stage`.
std::vector<Field> setting_values(const Script& script, std::string_view setting,
                                  const EvaluateFormula& evaluate, std::uint32_t stage,
                                  std::uint32_t last_stage);

/// Evaluates the settings in a stage of fields. A setting that names a stage after `last_stage`
/// counts as not set.
MaterialFields material_fields(const Script& script, const EvaluateFormula& evaluate,
                               std::uint32_t stage, std::uint32_t last_stage);

/// The same by cell, in the order of files.
struct Material {
    OfParts<std::vector<float>> parts;  ///< 0 … 1.
    std::vector<float> heights;         ///< Possibly not finite.
    std::vector<std::string> doubts;    ///< On values outside of 0 … 1, a sentence each.

    Material() = default;
    /// `in_order` gives the values of all cells of a field. `inside` is as in FlatCells. Values are
    /// clamped to 0 … 1. NaN becomes the default of the surface.
    Material(const MaterialFields& fields,
             const std::function<std::vector<double>(const Field&)>& in_order,
             std::span<const std::uint8_t> inside = {});

    MaterialCells cells() const;
};

/// The maps of a baked picture of fields: those set, and the occlusion of heights.
MapSet maps_said(const Script& script, bool has_bumps);

}  // namespace cascade
