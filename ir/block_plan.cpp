// Plans blocks: counts the readers of each value, then assigns locations in the order in which the
// kernel's loops compute the values.
#include "ir/block_plan.h"

#include "core/check.h"
#include "ir/loop_levels.h"

#include <utility>

namespace cascade::interpreting {
namespace {

/// Assigns a location to every value.
template <typename Number>
class Planner {
public:
    explicit Planner(const CellKernel& kernel)
        : kernel_(kernel),
          varies_(varying(kernel)),
          levels_(loop_levels_of(kernel)),
          schedule_(cell_schedule_of(kernel, levels_)),
          locations_(kernel.code.size()),
          readers_(kernel.code.size()) {}

    Plan<Number> plan() && {
        count_readers();
        for (const ValueId id : kernel_.code.ids()) {
            if (levels_[id] < LoopLevel::cell) locate(id);
        }
        for (const LinkLoop& loop : schedule_.loops) locate_loop(loop);
        for (const ValueId id : schedule_.after) locate(id);
        for (const ValueId id : kernel_.results) plan_.results.push_back(locations_[id]);
        return std::move(plan_);
    }

private:
    std::size_t arity(ValueId id) const {
        return static_cast<std::size_t>(info(kernel_.code[id].op).arity);
    }

    void count_reads(const std::vector<ValueId>& values) {
        for (const ValueId id : values) {
            for (std::size_t k = 0; k < arity(id); ++k) ++readers_[kernel_.code[id].operands[k]];
        }
    }

    void count_readers() {
        for (const ValueId id : kernel_.code.ids()) {
            if (levels_[id] < LoopLevel::cell) count_reads({id});
        }
        for (const LinkLoop& loop : schedule_.loops) {
            count_reads(loop.before);
            count_reads(loop.values);
            count_reads(loop.reductions);
        }
        count_reads(schedule_.after);
        // Results are read at the end of the block, so their registers are never released.
        for (const ValueId id : kernel_.results) ++readers_[id];
    }

    void locate(ValueId id) {
        if (!varies_[id]) {
            locate_scalar(id);
        } else if (kernel_.code[id].op == Op::field) {
            locations_[id] = {Location::Kind::field, kernel_.code[id].slot()};
        } else if (kernel_.code[id].op == Op::neighbour) {
            locations_[id] = {Location::Kind::beside, kernel_.code[id].slot()};
        } else {
            locate_vector(id);
        }
    }

    /// Values of cells that the loop reads are released after the loop and not within it, because
    /// the loop reads these values again for each link.
    void locate_loop(const LinkLoop& loop) {
        for (const ValueId id : loop.before) locate(id);
        for (const ValueId id : loop.reductions) {
            locations_[id] = {Location::Kind::vector, take_register()};
        }
        plan_.sections.emplace_back();
        is_in_loop_ = true;
        for (const ValueId id : loop.values) locate(id);
        for (const ValueId id : loop.reductions) {
            const ValueId operand = kernel_.code[id].operands[0];
            plan_.sections.back().reductions.push_back(
                {kernel_.code[id].op, locations_[id].index, locations_[operand]});
            release(operand);
        }
        is_in_loop_ = false;
        for (const ValueId id : std::exchange(read_in_loop_, {})) release(id);
        plan_.sections.emplace_back();
    }

    void locate_scalar(ValueId id) {
        const Instruction& instruction = kernel_.code[id];
        ScalarStep step{instruction.op, instruction.payload, {}};
        for (std::size_t k = 0; k < arity(id); ++k) {
            step.operands[k] = locations_[instruction.operands[k]].index;
        }
        const auto index = static_cast<std::uint32_t>(plan_.scalar_steps.size());
        locations_[id] = {Location::Kind::scalar, index};
        plan_.scalar_steps.push_back(step);
    }

    void locate_vector(ValueId id) {
        const Instruction& instruction = kernel_.code[id];
        BlockStep<Number> step;
        step.op = instruction.op;
        step.payload = instruction.payload;
        unsigned scalars = 0;
        for (std::size_t k = 0; k < arity(id); ++k) {
            step.operands[k] = locations_[instruction.operands[k]];
            if (step.operands[k].kind == Location::Kind::scalar) scalars |= 1u << k;
        }
        if (is_function_of_operands(step.op)) step.loop = block_loop<Number>(step.op, scalars);
        // The result's register is taken before the operands' registers are released, because the
        // output of a loop must not overlap an operand.
        step.target = take_register();
        for (std::size_t k = 0; k < arity(id); ++k) release(instruction.operands[k]);
        locations_[id] = {Location::Kind::vector, step.target};
        if (readers_[id] == 0) free_.push_back(step.target);
        plan_.sections.back().steps.push_back(step);
    }

    std::uint32_t take_register() {
        if (free_.empty()) return plan_.register_count++;
        const std::uint32_t taken = free_.back();
        free_.pop_back();
        return taken;
    }

    void release(ValueId id) {
        if (is_in_loop_ && levels_[id] < LoopLevel::link) {
            read_in_loop_.push_back(id);
            return;
        }
        if (--readers_[id] != 0 || locations_[id].kind != Location::Kind::vector) return;
        free_.push_back(locations_[id].index);
    }

    const CellKernel& kernel_;
    const IdVector<ValueId, bool> varies_;
    const IdVector<ValueId, LoopLevel> levels_;
    const CellSchedule schedule_;
    IdVector<ValueId, Location> locations_;
    /// The number of instructions that have yet to read each value.
    IdVector<ValueId, std::uint32_t> readers_;
    bool is_in_loop_ = false;
    std::vector<ValueId> read_in_loop_;
    std::vector<std::uint32_t> free_;
    Plan<Number> plan_;
};

}  // namespace

template <typename Number>
Plan<Number> plan_blocks(const CellKernel& kernel) {
    return Planner<Number>(kernel).plan();
}

template Plan<float> plan_blocks(const CellKernel& kernel);
template Plan<double> plan_blocks(const CellKernel& kernel);

}  // namespace cascade::interpreting
