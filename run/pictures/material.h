// What the picture block says of a surface besides its colour: roughness, metalness, opacity,
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

/// Values of all cells, also of a volume, in the run's precision; empty for what is not said.
struct MaterialFields {
    OfParts<Field> parts;  ///< As the formulas give them; of emission all three or none.
    Field height;          ///< Above the surface, in the unit of length of scripts.
};

/// Gives a formula's values in all cells: one field, or three of a colour.
using EvaluateFormula = std::function<std::vector<Field>(const Formula&)>;

/// The values of a setting of the picture block in a stage; empty if it is not said, or if it names
/// a stage after `last_stage`.
std::vector<Field> setting_values(const Script& script, std::string_view setting,
                                  const EvaluateFormula& evaluate, std::uint32_t stage,
                                  std::uint32_t last_stage);

/// Evaluates the settings in a stage of fields. A setting that names a stage after `last_stage`
/// counts as not said.
MaterialFields material_fields(const Script& script, const EvaluateFormula& evaluate,
                               std::uint32_t stage, std::uint32_t last_stage);

/// The same by cell, in the order of files.
struct Material {
    OfParts<std::vector<float>> parts;  ///< 0 … 1.
    std::vector<float> heights;         ///< Perhaps not finite.
    std::vector<std::string> doubts;    ///< About values that are not from 0 to 1, a sentence each.

    Material() = default;
    /// `in_order` gives the values of all cells of a field; `inside` is as in FlatCells. Values are
    /// clamped to 0 … 1; NaN becomes what a surface has where nothing is said.
    Material(const MaterialFields& fields,
             const std::function<std::vector<double>(const Field&)>& in_order,
             std::span<const std::uint8_t> inside = {});

    MaterialCells cells() const;
};

/// The maps that a baked picture of fields will have: those it says, and the occlusion of heights.
MapSet maps_said(const Script& script, bool has_bumps);

}  // namespace cascade
