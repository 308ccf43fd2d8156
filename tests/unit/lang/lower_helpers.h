// Runs lowered kernels with the interpreter: a whole stage, item by item and step by step, without
// the time loop.
#pragma once

#include "check_helpers.h"

#include "core/floating_point.h"
#include "core/plane.h"
#include "ir/draw_of_step.h"
#include "ir/interpreter.h"
#include "lang/lower/lower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace cascade::test {

/// The only pass of a plan with one pass and no aggregates.
inline BoundKernel only_pass(StepPlan plan) {
    EXPECT_EQ(plan.passes.size(), 1u);
    EXPECT_EQ(plan.aggregates, 0u);
    BoundKernel bound = std::move(plan.passes[0].bound);
    bound.results = std::move(plan.results);
    return bound;
}

/// The state of all stages of a program.
class ScriptRun {
public:
    explicit ScriptRun(const Program& program)
        : program_(program), layout_(program.domain.grid), stages_(program.stages.size()) {}

    void start(std::uint32_t stage) {
        State& state = stages_[stage];
        const auto count = program_.system_of(stage).item_count();
        state.numbers.assign(count, 0);
        state.fields.resize(count);
        const PlaneLayout one{Grid{1, 1, Boundary::periodic}};
        const BoundKernel uniform = only_pass(plan_uniform_start(program_, stage));
        const std::vector<Field> numbers = run(uniform, stage, one);
        for (std::size_t k = 0; k < numbers.size(); ++k) {
            state.numbers[uniform.results[k]] = numbers[k].at(0, 0);
        }
        const BoundKernel cells = only_pass(plan_start(program_, stage));
        std::vector<Field> fields = run(cells, stage, layout_);
        for (std::size_t k = 0; k < fields.size(); ++k) {
            state.fields[cells.results[k]] = std::move(fields[k]);
        }
    }

    void step(std::uint32_t stage, int count = 1) {
        const BoundKernel kernel = only_pass(plan_step(program_, stage));
        for (int i = 0; i < count; ++i) {
            std::vector<Field> next = run(kernel, stage, layout_);
            for (std::size_t k = 0; k < next.size(); ++k) {
                stages_[stage].fields[kernel.results[k]] = std::move(next[k]);
            }
            ++stages_[stage].steps;
        }
    }

    std::vector<Field> rates(std::uint32_t stage) {
        return run(only_pass(plan_rates(program_, stage)), stage, layout_);
    }

    std::vector<Field> view(const Formula& formula, std::uint32_t stage) {
        return run(only_pass(plan_view(program_, formula, stage)), stage, layout_);
    }

    Field& field(std::uint32_t stage, const std::string& name) {
        return stages_[stage].fields[item_of(stage, name)];
    }
    float number(std::uint32_t stage, const std::string& name) {
        return stages_[stage].numbers[item_of(stage, name)];
    }
    std::map<std::string, Field> files;  ///< The files that `field("…")` reads.

private:
    struct State {
        IdVector<ItemId, float> numbers;
        IdVector<ItemId, Field> fields;
        int steps = 0;
    };

    ItemId item_of(std::uint32_t stage, const std::string& name) const {
        const System& system = program_.system_of(stage);
        for (const ItemId item : system.items()) {
            if (system.item_name(item) == name) return item;
        }
        ADD_FAILURE() << "no item " << name;
        return {};
    }

    Field& field_of(StageItem item) { return stages_[item.stage].fields[item.item]; }

    float time_value(TimeValue value, std::uint32_t stage) const {
        const State& state = stages_[stage];
        const auto steps = static_cast<float>(state.steps);
        const float length = state.numbers[program_.system_of(stage).speed_item()];
        switch (value) {
            case TimeValue::step: return steps;
            case TimeValue::draw: return draw_uniform<float>(state.steps);
            case TimeValue::time: return steps * length;
            case TimeValue::length: return length;
        }
        return 0;
    }

    std::vector<Field> run(const BoundKernel& bound, std::uint32_t stage,
                           const PlaneLayout& layout) {
        EXPECT_EQ(verify(*bound.kernel), "");
        const FlushDenormals environment;
        std::vector<const float*> fields;
        for (const PlaneSource& source : bound.fields) {
            const auto* const file = std::get_if<NamedPlane>(&source);
            Field& field = file != nullptr ? files.at(program_.literals->text(file->text))
                                           : field_of(std::get<StageItem>(source));
            EXPECT_FALSE(field.empty());
            fill_halo(field.origin(), layout, program_.domain.grid.boundary);
            fields.push_back(field.origin());
        }
        std::vector<Mask> masks;
        std::vector<const std::uint8_t*> mask_origins;
        for (const StageItem item : bound.masks) {
            masks.emplace_back(layout);
            const Field& field = field_of(item);
            for (std::int64_t j = 0; j < layout.height; ++j) {
                for (std::int64_t i = 0; i < layout.width; ++i) {
                    masks.back().at(i, j) = field.at(i, j) != 0;
                }
            }
            mask_origins.push_back(masks.back().origin());
        }
        std::vector<float> uniforms;
        for (const UniformSource& source : bound.uniforms) {
            const auto* const item = std::get_if<StageItem>(&source);
            uniforms.push_back(item != nullptr ? stages_[item->stage].numbers[item->item]
                                               : time_value(std::get<TimeValue>(source), stage));
        }
        std::vector<Field> results;
        std::vector<float*> origins;
        for (std::size_t k = 0; k < bound.kernel->results.size(); ++k) {
            results.emplace_back(layout);
            origins.push_back(results.back().origin());
        }
        const Stencil stencil = Grid{layout.width, layout.height, {}, layout.depth}.stencil();
        const KernelPointer kernel = make_interpreter()->compile(*bound.kernel, stencil).value();
        kernel->run({fields, mask_origins, uniforms, origins, layout}, {0, layout.row_count()});
        return results;
    }

    const Program& program_;
    PlaneLayout layout_;
    std::vector<State> stages_;
};

inline const std::string small_grid = "domain { grid: 8, 4 }\n";

/// A system with a parameter `p` and a species `u` whose rate is `p`.
inline std::string system_with(const std::string& p) {
    return "system s { u: 0; p: " + p + "; u' = p }\nstage one: s {}\n";
}

/// The values of a formula over the cells of a domain.
class FormulaValues {
public:
    FormulaValues(const std::string& domain, const std::string& formula)
        : checked_(check_text(domain + system_with(formula))) {
        EXPECT_TRUE(checked_->program) << ::testing::PrintToString(checked_->faults());
        if (!checked_->program) return;
        run_ = std::make_unique<ScriptRun>(*checked_->program);
        run_->start(0);
        uniform_ = checked_->program->stages[0].uniform[ItemId(1)];
    }
    float at(std::int64_t i, std::int64_t j, std::int64_t k = 0) {
        return uniform_ ? run_->number(0, "p") : run_->field(0, "p").at(i, j, k);
    }
    float number() { return at(0, 0); }
    std::size_t count_ones(std::int64_t width, std::int64_t height) {
        std::size_t count = 0;
        for (std::int64_t j = 0; j < height; ++j) {
            for (std::int64_t i = 0; i < width; ++i) count += at(i, j) == 1.0f;
        }
        return count;
    }

private:
    std::unique_ptr<Checked> checked_;
    std::unique_ptr<ScriptRun> run_;
    bool uniform_ = false;
};

}  // namespace cascade::test
