// Binds the plans of a stage in the same way as a run does, although no planes exist. Then writes
// each bound pass as C statements.
#include "run/emit_c/c_stage.h"

#include "core/overloaded.h"
#include "lang/lower/lower.h"
#include "run/emit_c/c_tables.h"
#include "run/stage/bound_kernel.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

using SpeciesPlane = StepProblem::SpeciesPlane;

/// Writes a C literal for a number. Reading the literal gives exactly the same number.
std::string c_number(double value) {
    const std::string text = fmt::format("{:.17g}", value);
    return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string list(const std::vector<std::string>& values) {
    return fmt::format("{}", fmt::join(values, ", "));
}

std::string_view c_kind(ReductionKind kind) {
    switch (kind) {
        case ReductionKind::sum: return "sum";
        case ReductionKind::mean: return "mean";
        case ReductionKind::least: return "least";
        case ReductionKind::largest: return "largest";
    }
    return "";
}

/// All operands of a pass, as C expressions.
struct PassText {
    std::string kernel;
    std::vector<std::string> fields, masks, uniforms, results;
    std::vector<std::string> before;  ///< Statements before the call of the kernel.
    std::vector<std::string> after;   ///< Statements after the call of the kernel.
};

class Describer {
public:
    explicit Describer(const CStageRequest& request)
        : request_(request),
          program_(request.program),
          k_(request.stage),
          stage_(program_.stages[k_]),
          system_(program_.system_of(k_)),
          tables_(request, result_) {
        for (std::uint32_t k = 0; k <= k_; ++k)
            states_.push_back(empty_state(program_.system_of(k)));
    }

    Result<CStage> describe() {
        result_.name = request_.name;
        describe_step();
        describe_start();
        describe_sides();
        note_settings();
        if (!error_.empty()) return failure(error_);
        return std::move(result_);
    }

private:
    std::string register_text(SpeciesPlane plane) const {
        const std::size_t species = plane.species.index();
        if (plane.in_register == old_register) return fmt::format("s->species[{}]", species);
        if (plane.in_register == new_register) return fmt::format("s->next[{}]", species);
        return fmt::format("s->scratch[{}]",
                           (plane.in_register.index() - first_scratch_register.index()) *
                                   system_.species_count() +
                               species);
    }
    /// Returns the rules at the sides of a plane that is read at neighbours. The plane must not be
    /// a species of this step, whose rules species_rules() returns.
    std::string rules_of(const PlaneSource& source) {
        const auto* const item = std::get_if<StageItem>(&source);
        if (item != nullptr && item->stage != k_ &&
            program_.system_of(item->stage).is_species(item->item) &&
            !program_.stages[item->stage].sides.empty()) {
            error_ = fmt::format(
                "stage '{}' reads {} in neighbouring cells, but the sides of that stage cannot "
                "be compiled with this one",
                stage_.name, tables_.item_path(*item));
        }
        return request_.name + "_boundary";
    }
    std::string species_rules(std::size_t species) const {
        if (stage_.sides.empty()) return request_.name + "_boundary";
        return fmt::format("s->sides[{}]", species);
    }
    std::string fill(const std::string& plane, const std::string& rules) const {
        return fmt::format("{}_fill_halo({}, {});", request_.name, plane, rules);
    }
    std::string reduction(std::uint32_t aggregate, ReductionKind kind, const std::string& plane) {
        result_.reduces = true;
        return fmt::format("aggregates[{}] = {}_reduce(s, {}_{}, {});", aggregate, request_.name,
                           request_.name, c_kind(kind), plane);
    }

    std::string write(const PassText& pass) const {
        std::string text = "    {\n";
        const auto line = [&](const std::string& statement) {
            text += "        " + statement + "\n";
        };
        for (const std::string& statement : pass.before) line(statement);
        const auto array = [&](std::string_view type, std::string_view name,
                               const std::vector<std::string>& values) {
            if (!values.empty()) line(fmt::format("{} {}[] = {{{}}};", type, name, list(values)));
            return std::string(values.empty() ? "NULL" : name);
        };
        const std::string fields = array("const float *const", "fields", pass.fields);
        const std::string masks = array("const unsigned char *const", "masks", pass.masks);
        const std::string uniforms = array("const float", "uniforms", pass.uniforms);
        const std::string results = array("float *const", "results", pass.results);
        line(fmt::format("{}_compute({}, {}, {}, {}, {});", request_.name, pass.kernel, fields,
                         masks, uniforms, results));
        for (const std::string& statement : pass.after) line(statement);
        return text + "    }\n";
    }

    /// Writes the statements of a plan that is not part of a step. `result(k)` returns the plane of
    /// result k.
    template <typename ResultPlane>
    std::string plan_text(const StepPlan& plan, const ResultPlane& result) {
        const StepProblem problem = bind_plan(plan, {}, context());
        std::string text;
        if (plan.aggregates > 0)
            text += fmt::format("    float aggregates[{}];\n", plan.aggregates);
        for (std::size_t number = 0; number < plan.passes.size(); ++number) {
            text += pass_text(problem, number, plan.passes[number], true,
                              [&](SpeciesPlane of) { return result(of.species.index()); });
        }
        return plan.aggregates > 0 ? "    {\n" + text + "    }\n" : text;
    }

    /// Returns the sources of the values that plans read, as in a run. The stages have no planes
    /// here.
    BindingContext context() const {
        return {states_, request_.files, 0, program_.domain.grid, Precision::single,
                0,       request_.metric};
    }

    void describe_start() {
        const StepPlan plan = plan_start(program_, k_);
        std::vector<std::string> taken;
        result_.start += plan_text(plan, [&](std::uint32_t number) {
            const ItemId item = plan.results[number];
            const StageItem source{k_, item};
            if (!stage_.uniform[item]) return tables_.plane(source);
            // The item is uniform, so the value of the first cell is its value.
            const std::string plane = tables_.temporary(plan.temporaries + taken.size());
            taken.push_back(fmt::format("    {} = {}[0];\n", tables_.number(source), plane));
            return plane;
        });
        for (const std::string& line : taken) result_.start += line;
        for (const StageItem mask : std::vector(tables_.masks())) {
            if (mask.stage != k_) continue;
            result_.start += fmt::format("    {}_make_mask({}, {});\n", request_.name,
                                         tables_.plane(mask), tables_.mask(mask));
        }
    }

    /// Must be called after all starting values have been described, because the values of sides
    /// may read them.
    void describe_sides() {
        for (const SpeciesId species : stage_.sides.ids()) {
            for (std::size_t side = 0; side < side_count; ++side) {
                const SideSetting& setting = stage_.sides[species][side];
                if (!takes_value(setting.kind)) continue;
                const StepPlan plan = plan_view(program_, setting.value, k_);
                const std::string rule = fmt::format("s->sides[{}][{}]", species.index(), side);
                std::string plane;
                const std::string text = plan_text(plan, [&](std::uint32_t) {
                    plane = plan.is_uniform
                                ? tables_.temporary(plan.temporaries)
                                : fmt::format("s->side_planes[{}]", result_.side_planes++);
                    return plane;
                });
                result_.start += text;
                result_.start += fmt::format("    {}.value = {}[0];\n", rule, plane);
                if (plan.is_uniform) continue;
                result_.start += fmt::format("    {}\n    {}.values = {};\n",
                                             fill(plane, request_.name + "_boundary"), rule, plane);
            }
        }
    }

    // The following functions write a step, which consists of the sweeps of its scheme, bound as in
    // a run.

    void describe_step() {
        std::vector<StepPlan> plans;
        for (const SweepForm& form : request_.scheme.forms) {
            plans.push_back(plan_sweep(program_, k_, form));
        }
        std::vector<const Pass*> passes;
        for (const Sweep& sweep : request_.scheme.sweeps) {
            for (const Pass& pass : plans[sweep.form].passes) passes.push_back(&pass);
        }
        const StepProblem problem =
            bind_scheme(request_.scheme, plans, {}, {}, context(), system_, k_);
        result_.scratch_registers = problem.registers - first_scratch_register.index();
        result_.step_aggregates = problem.aggregates;
        for (std::size_t species = 0; species < system_.species_count(); ++species) {
            if (!problem.species_needs_halo[species]) continue;
            result_.step += fmt::format("    {}\n", fill(fmt::format("s->species[{}]", species),
                                                         species_rules(species)));
        }
        for (std::size_t number = 0; number < passes.size(); ++number) {
            result_.step += pass_text(problem, number, *passes[number], false,
                                      [&](SpeciesPlane of) { return register_text(of); });
        }
    }

    /// Writes a pass of a bound plan. `written` returns the plane for each result that is not
    /// stored in a temporary plane.
    template <typename Written>
    std::string pass_text(const StepProblem& problem, std::size_t number, const Pass& pass,
                          bool starts, const Written& written) {
        const StepProblem::Pass& bound = problem.passes[number];
        PassText lines;
        lines.kernel = tables_.kernel(*bound.source);
        const auto plane = [&](const StepProblem::PlaneRef& ref, const PlaneSource& source) {
            const auto* const own = std::get_if<SpeciesPlane>(&ref);
            return own != nullptr ? register_text(*own) : tables_.plane(source);
        };
        for (std::size_t k = 0; k < bound.reductions.size(); ++k) {
            lines.before.push_back(
                reduction(bound.reductions[k].aggregate.index(), bound.reductions[k].kind,
                          plane(bound.reductions[k].operand, pass.reductions[k].operand)));
        }
        for (const StepProblem::Result& result : bound.results) {
            if (const auto* const temporary = std::get_if<TemporaryId>(&result.plane)) {
                lines.results.push_back(tables_.temporary(temporary->index()));
                if (result.needs_halo) {
                    lines.after.push_back(fill(lines.results.back(), request_.name + "_boundary"));
                }
                continue;
            }
            const auto own = std::get<SpeciesPlane>(result.plane);
            lines.results.push_back(written(own));
            if (result.needs_halo && is_read_at_neighbours_later(problem, number, own)) {
                lines.after.push_back(
                    fill(lines.results.back(), species_rules(own.species.index())));
            }
        }
        for (const FieldSlot slot : pass.bound.fields.ids()) {
            const PlaneSource& source = pass.bound.fields[slot];
            const StepProblem::PlaneRef& ref = bound.fields[slot.index()];
            lines.fields.push_back(plane(ref, source));
            if (std::holds_alternative<const Field*>(ref) && bound.source->reads_neighbours(slot)) {
                lines.before.push_back(fill(lines.fields.back(), rules_of(source)));
            }
        }
        for (const StageItem item : pass.bound.masks) lines.masks.push_back(tables_.mask(item));
        for (const UniformSlot slot : pass.bound.uniforms.ids()) {
            lines.uniforms.push_back(uniform(bound, slot, pass.bound.uniforms[slot], starts));
        }
        return write(lines);
    }

    /// Whether a later sweep of the same step reads the plane at neighbours. If only the next step
    /// does, the halo need not be filled now, because each step fills the halos of old values.
    bool is_read_at_neighbours_later(const StepProblem& problem, std::size_t number,
                                     SpeciesPlane plane) const {
        for (std::size_t later = number + 1; later < problem.passes.size(); ++later) {
            const auto& fields = problem.passes[later].fields;
            if (std::ranges::find(fields, StepProblem::PlaneRef(plane)) != fields.end())
                return true;
        }
        return false;
    }

    std::string uniform(const StepProblem::Pass& bound, UniformSlot slot,
                        const UniformSource& source, bool starts) {
        const Overloaded text{
            [](StepProblem::CompleteSteps) -> std::string { return "(float)s->steps"; },
            [&](StepProblem::StepDraw) { return fmt::format("{}_draw(s->steps)", request_.name); },
            [](AggregateId id) { return fmt::format("aggregates[{}]", id.index()); },
            [&](StepProblem::MomentAt at) -> std::string {
                if (at.part == 0) return "(float)t";
                return fmt::format("(float)(t + {}_rounded({} * length))", request_.name,
                                   c_number(at.part));
            },
            [](Sweep::Coefficient by) {
                const std::string value = c_number(by.value);
                return by.times_step ? fmt::format("(float)({} * length)", value)
                                     : fmt::format("(float){}", value);
            },
        };
        for (const StepProblem::ChangingUniform& changing : bound.changing) {
            if (changing.slot != slot) continue;
            // The number of steps and the time are 0 at the start of a stage.
            const bool is_aggregate = std::holds_alternative<AggregateId>(changing.value);
            return starts && !is_aggregate ? "0" : std::visit(text, changing.value);
        }
        return tables_.number(std::get<StageItem>(source));
    }

    /// Records where `speed` and `frozen` are in the table of numbers. The code around the
    /// statements uses them.
    void note_settings() {
        if (stage_.uniform[system_.speed_item()]) {
            result_.speed = tables_.number_place({k_, system_.speed_item()});
        }
        const ItemId frozen = system_.frozen_item();
        if (stage_.uniform[frozen] && request_.numbers[k_][frozen] != 0.0F) {
            result_.frozen = tables_.number_place({k_, frozen});
        }
    }

    const CStageRequest& request_;
    const Program& program_;
    std::uint32_t k_;
    const Stage& stage_;
    const System& system_;
    std::vector<StageState> states_;
    CStage result_;
    CTables tables_;
    std::string error_;
};

}  // namespace

Result<CStage> describe_c_stage(const CStageRequest& request) {
    return Describer(request).describe();
}

}  // namespace cascade
