// Evaluates together all expressions that have a meaning in a stage.
#include "run/commands/series_fields.h"

#include "core/file_format.h"
#include "lang/check/check_dimensions.h"
#include "picture/hdf5.h"
#include "run/commands/named_expression.h"
#include "run/commands/run_option.h"
#include "run/commands/stage_formulas.h"
#include "run/pictures/measured.h"
#include "run/script/embedded_script.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace cascade {

namespace {

/// Returns the number that pictures show, as the only field.
SeriesFields shown_field(Script& script, const RunRequest& request, Painter& painter) {
    std::string name = name_of_number(script, script.final_stage(), request.picture);
    if (name.empty()) name = "shown";
    SeriesFields fields;
    fields.names = fields.expressions = {std::move(name)};
    fields.values = [&painter](const Simulation& simulation) {
        std::vector<Field> shown;
        shown.push_back(shown_number(painter, simulation));
        return shown;
    };
    return fields;
}

/// Returns the species of all stages that run, in the order of the stages.
std::vector<std::string> all_species(const Script& script) {
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        const System& system = script.program->system_of(k);
        for (const ItemId item : system.species()) {
            std::string name(system.item_name(item));
            if (std::find(names.begin(), names.end(), name) == names.end())
                names.push_back(std::move(name));
        }
    }
    return names;
}

/// Returns whether the fields have different names and, for an HDF5 file, names that datasets can
/// have. Adds an error to `script.diagnostics` if this is not so.
bool check_names(Script& script, const SeriesFields& fields, bool is_hdf5) {
    const std::string option = flag_of(RunOption::field);
    const auto refuse = [&](const std::string& name, std::string message, std::string hint) {
        script.diagnostics.error(option_span(script.sources, option, name), std::move(message),
                                 std::move(hint));
        return false;
    };
    const auto& names = fields.names;
    for (auto name = names.begin(); name != names.end(); ++name) {
        if (std::find(names.begin(), name, *name) != name)
            return refuse(*name, fmt::format("two fields are called '{}'", *name), "");
        if (!is_hdf5 || is_hdf5_name(*name)) continue;
        return refuse(
            *name, fmt::format("'{}' cannot be the name of a dataset in a .h5 file", *name),
            fmt::format("{} 'value={}' gives the field another name", option,
                        fields.expressions[static_cast<std::size_t>(name - names.begin())]));
    }
    return true;
}

/// Adds the units that fields have in the last of their stages, and the units of lengths and times.
void add_units(const Script& script, const StageFormulas& formulas, SeriesFields& fields) {
    const ProgramUnits units = units_of_program(script.tree, *script.program);
    fields.unit_of_length = units.name_of(BaseQuantity::length);
    fields.unit_of_time = units.name_of(BaseQuantity::time);
    for (std::size_t k = 0; k < formulas.count(); ++k) {
        std::string& unit = fields.units.emplace_back();
        for (std::uint32_t stage = 0; stage < script.stage_count(); ++stage) {
            if (const Formula* const formula = formulas.at(k, stage))
                unit = unit_of_formula(script.tree, *script.program, stage, *formula);
        }
    }
}

}  // namespace

Result<SeriesFields> series_fields(Script& script, const RunRequest& request, Painter& painter) {
    const bool is_hdf5 = is_of_format(request.series, FileFormat::h5);
    const std::vector<std::string> wanted =
        request.fields.empty() && is_hdf5 ? all_species(script) : request.fields;
    if (wanted.empty()) return shown_field(script, request, painter);
    SeriesFields fields;
    for (const std::string& text : wanted) {
        auto [name, expression] = named_expression(text);
        fields.names.push_back(std::move(name));
        fields.expressions.push_back(std::move(expression));
    }
    if (!check_names(script, fields, is_hdf5)) return failure("the fields have wrong names");
    auto formulas =
        StageFormulas::create(script, "--field", fields.expressions, FormulaKind::for_a_cell);
    if (!formulas) return tl::unexpected(formulas.error());
    fields.texts = {{"script", script.text}, {"overrides", overrides_to_json(script.overrides)}};
    add_units(script, *formulas, fields);
    fields.values = [formulas = *std::move(formulas)](const Simulation& simulation) {
        const std::uint32_t stage = shown_stage(simulation);
        std::vector<Field> known = simulation.evaluate(formulas.known_in(stage), stage);
        auto next = known.begin();
        std::vector<Field> all;
        for (std::size_t k = 0; k < formulas.count(); ++k) {
            all.push_back(formulas.at(k, stage) != nullptr ? std::move(*next++) : Field());
        }
        return all;
    };
    return fields;
}

}  // namespace cascade
