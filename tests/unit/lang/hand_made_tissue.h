// Cells that crawl, with planes and links made by a test. The plans of a stage run on them without
// the time loop.
#pragma once

#include "check_helpers.h"

#include "core/floating_point.h"
#include "core/links.h"
#include "core/plane.h"
#include "core/vector3.h"
#include "ir/interpreter.h"
#include "ir/reduction.h"
#include "lang/lower/lower.h"
#include "lang/program/models.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::test {

/// The cells of the last stage of a script in double precision. Each cell has links to all others.
class HandMadeTissue {
public:
    using Values = std::vector<double>;  ///< A value for each cell.

    /// `script` must have no errors and have `precision: double`. Radii are 0.1, frames are not
    /// rotated, and all other values are 0.
    HandMadeTissue(const std::string& script, const std::vector<Vector3d>& places)
        : checked_(check_text(script)), count_(places.size()) {
        for (const std::string& fault : checked_->faults()) ADD_FAILURE() << fault;
        stage_ = static_cast<std::uint32_t>(program().stages.size() - 1);
        layout_ = PlaneLayout(rows_of_cells(static_cast<std::int64_t>(count_)));
        values("r").assign(count_, 0.1);
        values("frame.w").assign(count_, 1);
        for (std::size_t cell = 0; cell < count_; ++cell) {
            values("p.x")[cell] = places[cell].x;
            values("p.y")[cell] = places[cell].y;
            values("p.z")[cell] = places[cell].z;
        }
        sensed(ModelPlane::nz).assign(count_, 1);
        sensed(ModelPlane::area).assign(count_, 1);
        LinkList list;
        for (std::uint32_t cell = 0; cell < count_; ++cell) {
            for (std::uint32_t other = 0; other < count_; ++other) {
                if (other != cell) list.neighbours.push_back(other);
            }
            list.ends.push_back(list.neighbours.size());
        }
        list.weights.assign(list.neighbours.size(), 1);
        links_ = Links(list, layout_, Precision::binary64);
    }

    const Program& program() const { return *checked_->program; }
    std::uint32_t stage() const { return stage_; }
    std::size_t size() const { return count_; }
    Values& values(const std::string& item) { return of(items_[item]); }
    Values& sensed(ModelPlane plane) { return of(sensed_[plane]); }
    Vector3d vector(const std::string& name, std::size_t cell) {
        return {values(name + ".x")[cell], values(name + ".y")[cell], values(name + ".z")[cell]};
    }

    /// The rate of a species in each cell.
    Values rate(std::string_view species) {
        const StepPlan plan = plan_rates(program(), stage_);
        const std::vector<Values> results = run(plan);
        const System& system = program().system_of(stage_);
        for (std::size_t k = 0; k < plan.results.size(); ++k) {
            if (system.item_name(plan.results[k]) == species) return results[k];
        }
        ADD_FAILURE() << "no species " << species;
        return Values(count_);
    }

    std::vector<Values> run(const StepPlan& plan) {
        const FlushDenormals environment;
        std::vector<Values> results(plan.result_count);
        temporaries_.assign(plan.temporaries, {});
        aggregates_.assign(plan.aggregates, 0);
        for (const Pass& pass : plan.passes) {
            for (const Reduction& reduction : pass.reductions) reduce(reduction);
            const std::vector<Values> made = run(pass.bound);
            for (std::size_t k = 0; k < pass.targets.size(); ++k) {
                const auto& target = pass.targets[k].id;
                const auto* const temporary = std::get_if<TemporaryId>(&target);
                if (temporary != nullptr) temporaries_[temporary->index()] = made[k];
                else results[std::get<ResultId>(target).index()] = made[k];
            }
        }
        return results;
    }

private:
    Values& of(Values& values) const {
        values.resize(count_, 0);
        return values;
    }

    Values& source(const PlaneSource& source) {
        if (const auto* id = std::get_if<TemporaryId>(&source)) return temporaries_[id->index()];
        if (const auto* plane = std::get_if<ModelPlane>(&source)) return sensed(*plane);
        const StageItem item = std::get<StageItem>(source);
        EXPECT_EQ(item.stage, stage_);
        return values(std::string(program().system_of(stage_).item_name(item.item)));
    }

    double uniform(const UniformSource& source) {
        if (const auto* id = std::get_if<AggregateId>(&source)) return aggregates_[id->index()];
        if (std::holds_alternative<TimeValue>(source)) return 0;
        const StageItem item = std::get<StageItem>(source);
        return values(std::string(program().system_of(stage_).item_name(item.item)))[0];
    }

    std::size_t place(std::size_t cell) const {
        const auto number = static_cast<std::int64_t>(cell);
        return static_cast<std::size_t>(layout_.row_start(number / layout_.width) +
                                        number % layout_.width);
    }

    /// The padding of the last row repeats the last cell, except in sums.
    Plane<double> plane_of(const Values& values, bool is_summed = false) const {
        Plane<double> plane(layout_);
        const auto cells = static_cast<std::size_t>(layout_.width * layout_.height);
        for (std::size_t cell = 0; cell < cells; ++cell) {
            const bool is_padding = cell >= count_;
            plane.origin()[place(cell)] =
                is_padding && is_summed ? 0 : values[is_padding ? count_ - 1 : cell];
        }
        return plane;
    }

    std::vector<Values> run(const BoundKernel& bound) {
        EXPECT_EQ(verify(*bound.kernel), "");
        std::vector<Plane<double>> planes, results;
        std::vector<const double*> fields;
        std::vector<double*> targets;
        std::vector<double> uniforms;
        for (const PlaneSource& each : bound.fields) {
            fields.push_back(planes.emplace_back(plane_of(source(each))).origin());
        }
        for (const UniformSource& each : bound.uniforms) uniforms.push_back(uniform(each));
        for (std::size_t k = 0; k < bound.kernel->results.size(); ++k) {
            targets.push_back(results.emplace_back(layout_).origin());
        }
        const KernelPointer kernel =
            make_interpreter()->compile(*bound.kernel, Stencil::linked).value();
        kernel->run({fields, {}, uniforms, targets, layout_, links_.table<double>()},
                    {0, layout_.height});
        std::vector<Values> values(results.size(), Values(count_));
        for (std::size_t k = 0; k < results.size(); ++k) {
            for (std::size_t cell = 0; cell < count_; ++cell) {
                values[k][cell] = results[k].origin()[place(cell)];
            }
        }
        return values;
    }

    void reduce(const Reduction& reduction) {
        const bool is_sum = reduction.kind == ReductionKind::sum;
        const Plane<double> plane = plane_of(source(reduction.operand), is_sum);
        std::vector<double> rows;
        for (std::int64_t row = 0; row < layout_.height; ++row) {
            rows.push_back(reduce_row(reduction.kind, plane.row(row), layout_.width));
        }
        aggregates_[reduction.aggregate.index()] =
            reduce_rows(reduction.kind, rows, static_cast<std::int64_t>(count_));
    }

    std::unique_ptr<Checked> checked_;
    std::size_t count_;
    std::uint32_t stage_ = 0;
    PlaneLayout layout_;
    Links links_;
    std::map<std::string, Values> items_;
    std::map<ModelPlane, Values> sensed_;
    std::vector<Values> temporaries_;
    std::vector<double> aggregates_;
};

}  // namespace cascade::test
