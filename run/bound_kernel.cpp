#include "run/bound_kernel.h"

#include "core/check.h"
#include "core/floating_point.h"

#include <cmath>

namespace cascade {

namespace {

const float* field_origin(const SlotSource& source, const BindingContext& context) {
    if (source.kind == SlotSource::Kind::file) return context.files.plane(source.item).origin();
    return context.states[source.stage].field(source.item).origin();
}

float uniform_value(const SlotSource& source, const BindingContext& context) {
    if (source.kind == SlotSource::Kind::step) return static_cast<float>(context.steps);
    return context.states[source.stage].numbers[source.item];
}

std::vector<const std::uint8_t*> mask_origins(const BoundKernel& bound,
                                              const BindingContext& context) {
    std::vector<const std::uint8_t*> masks;
    for (const SlotSource& source : bound.masks) {
        masks.push_back(context.states[source.stage].frozen.origin());
    }
    return masks;
}

std::vector<float> uniform_values(const BoundKernel& bound, const BindingContext& context) {
    std::vector<float> uniforms;
    for (const SlotSource& source : bound.uniforms) {
        uniforms.push_back(uniform_value(source, context));
    }
    return uniforms;
}

}  // namespace

std::vector<Field> run_once(const Kernel& kernel, const BoundKernel& bound,
                            const BindingContext& context, const Grid& on, Team& team) {
    const PlaneLayout layout(on);
    std::vector<const float*> fields;
    for (const SlotSource& source : bound.fields) fields.push_back(field_origin(source, context));
    const auto masks = mask_origins(bound, context);
    const auto uniforms = uniform_values(bound, context);
    std::vector<Field> results;
    std::vector<float*> outputs;
    for (std::size_t r = 0; r < bound.kernel.results.size(); ++r) {
        outputs.push_back(results.emplace_back(layout).origin());
    }
    const KernelArguments arguments{fields, masks, uniforms, outputs, layout};
    team.run([&](int index) {
        const RowRange rows = split_rows(layout.row_count(), index, team.size());
        const FlushDenormals environment;
        if (!rows.empty()) kernel.run(arguments, rows);
    });
    return results;
}

StepProblem bind_step(const BoundKernel& bound, KernelPointer kernel,
                      const BindingContext& context, const System& system, std::uint32_t stage) {
    StepProblem problem;
    problem.step = std::move(kernel);
    problem.grid = context.grid;
    const StageState& state = context.states[stage];
    problem.species_needs_halo.assign(state.species.size(), false);
    for (std::size_t slot = 0; slot < bound.fields.size(); ++slot) {
        const SlotSource& source = bound.fields[slot];
        StepProblem::FieldSlot field;
        if (source.kind == SlotSource::Kind::item && system.is_species(source.item)) {
            field.species = state.species_of_item[source.item];
            if (bound.kernel.reads_neighbours(static_cast<std::uint32_t>(slot))) {
                problem.species_needs_halo[static_cast<std::size_t>(field.species)] = true;
            }
        } else {
            field.fixed = field_origin(source, context);
        }
        problem.fields.push_back(field);
    }
    problem.masks = mask_origins(bound, context);
    problem.uniforms = uniform_values(bound, context);
    for (std::size_t slot = 0; slot < bound.uniforms.size(); ++slot) {
        if (bound.uniforms[slot].kind == SlotSource::Kind::step) {
            problem.step_uniform = static_cast<int>(slot);
        }
    }
    return problem;
}

Mask to_mask(const Field& field) {
    const PlaneLayout& layout = field.layout();
    Mask mask(layout);
    const FlushDenormals environment;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) mask.row(row)[i] = field.row(row)[i] != 0.0F;
    }
    return mask;
}

float smallest(const Field& field) {
    const PlaneLayout& layout = field.layout();
    float least = INFINITY;
    for (std::int64_t row = 0; row < layout.row_count(); ++row) {
        for (std::int64_t i = 0; i < layout.width; ++i) {
            const float value = field.row(row)[i];
            if (std::isnan(value)) return value;
            least = value < least ? value : least;
        }
    }
    return least;
}

std::string species_name(const System& system, std::size_t species) {
    std::size_t number = 0;
    for (const Quantity& quantity : system.quantities) {
        if (quantity.is_species && number++ == species) return quantity.name;
    }
    CHECK(false, "the species exists");
}

}  // namespace cascade
