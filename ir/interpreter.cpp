// Plans and runs kernels block by block.
//
// What is the same in all cells (constants, uniforms and what is computed from them) is kept as
// single words, computed once a run. Everything else lives in registers of 256 words, which are
// used again as soon as no later instruction reads them: a chain of a million operations needs two.
// Fields are read where they lie.
#include "ir/interpreter.h"

#include "core/check.h"
#include "ir/block_loops.h"
#include "ir/word_operations.h"

#include <algorithm>
#include <cstring>
#include <vector>

namespace cascade {
namespace {

constexpr std::int64_t block_cells = 256;

/// Where the value of an instruction is found while a block is computed.
struct Place {
    enum class Kind : std::uint8_t {
        nowhere,   ///< Of operands that an operation does not have.
        scalar,    ///< The same in all cells: `index` counts scalars.
        field,     ///< In memory: `index` is a field slot.
        beside,    ///< In memory: `index` is the payload of a neighbour.
        vector,    ///< In a register: `index` counts registers.
    };
    Kind kind = Kind::nowhere;
    std::uint32_t index = 0;
};

/// An instruction that is computed once a run.
struct ScalarStep {
    Op op = Op::constant;
    std::uint32_t payload = 0;
    std::array<std::uint32_t, 3> operands{};  ///< Scalars.
};

/// An instruction that is computed once a block, into a register.
struct BlockStep {
    Op op = Op::constant;
    std::uint32_t payload = 0;
    std::uint32_t target = 0;
    std::array<Place, 3> operands{};
    BlockLoop loop = nullptr;  ///< Of operations that are functions of their operands.
};

struct Plan {
    std::vector<ScalarStep> scalar_steps;  ///< Step k computes scalar k.
    std::vector<BlockStep> block_steps;
    std::vector<Place> results;
    std::uint32_t register_count = 0;
};

/// Gives every value a place.
class Planner {
public:
    explicit Planner(const CellKernel& kernel)
        : kernel_(kernel), places_(kernel.code.size()), readers_(kernel.code.size()) {}

    Plan plan() && {
        count_readers();
        for (ValueId id = 0; id < kernel_.code.size(); ++id) place(id);
        for (const ValueId id : kernel_.results) plan_.results.push_back(places_[id]);
        return std::move(plan_);
    }

private:
    std::size_t arity(ValueId id) const {
        return static_cast<std::size_t>(info(kernel_.code[id].op).arity);
    }

    void count_readers() {
        for (ValueId id = 0; id < kernel_.code.size(); ++id) {
            for (std::size_t k = 0; k < arity(id); ++k) ++readers_[kernel_.code[id].operands[k]];
        }
        // Results are read at the end of the block, by nobody who would release them.
        for (const ValueId id : kernel_.results) ++readers_[id];
    }

    bool is_scalar(ValueId id) const {
        const Instruction& instruction = kernel_.code[id];
        if (instruction.op == Op::constant || instruction.op == Op::uniform) return true;
        if (!is_function_of_operands(instruction.op)) return false;
        for (std::size_t k = 0; k < arity(id); ++k) {
            if (places_[instruction.operands[k]].kind != Place::Kind::scalar) return false;
        }
        return true;
    }

    void place(ValueId id) {
        if (is_scalar(id)) {
            place_scalar(id);
        } else if (kernel_.code[id].op == Op::field) {
            places_[id] = {Place::Kind::field, kernel_.code[id].payload};
        } else if (kernel_.code[id].op == Op::neighbour) {
            places_[id] = {Place::Kind::beside, kernel_.code[id].payload};
        } else {
            place_vector(id);
        }
    }

    void place_scalar(ValueId id) {
        const Instruction& instruction = kernel_.code[id];
        ScalarStep step{instruction.op, instruction.payload, {}};
        for (std::size_t k = 0; k < arity(id); ++k) {
            step.operands[k] = places_[instruction.operands[k]].index;
        }
        const auto index = static_cast<std::uint32_t>(plan_.scalar_steps.size());
        places_[id] = {Place::Kind::scalar, index};
        plan_.scalar_steps.push_back(step);
    }

    void place_vector(ValueId id) {
        const Instruction& instruction = kernel_.code[id];
        BlockStep step;
        step.op = instruction.op;
        step.payload = instruction.payload;
        unsigned scalars = 0;
        for (std::size_t k = 0; k < arity(id); ++k) {
            step.operands[k] = places_[instruction.operands[k]];
            if (step.operands[k].kind == Place::Kind::scalar) scalars |= 1u << k;
        }
        if (is_function_of_operands(step.op)) step.loop = block_loop(step.op, scalars);
        // The target is taken before operands are released: a loop's output overlaps no operand.
        step.target = take_register();
        for (std::size_t k = 0; k < arity(id); ++k) release(instruction.operands[k]);
        places_[id] = {Place::Kind::vector, step.target};
        if (readers_[id] == 0) free_.push_back(step.target);
        plan_.block_steps.push_back(step);
    }

    std::uint32_t take_register() {
        if (free_.empty()) return plan_.register_count++;
        const std::uint32_t taken = free_.back();
        free_.pop_back();
        return taken;
    }

    void release(ValueId id) {
        if (--readers_[id] != 0 || places_[id].kind != Place::Kind::vector) return;
        free_.push_back(places_[id].index);
    }

    const CellKernel& kernel_;
    std::vector<Place> places_;
    std::vector<std::uint32_t> readers_;  ///< Reads of a value that are still to come.
    std::vector<std::uint32_t> free_;
    Plan plan_;
};

/// One run of a plan: its arguments, and the memory it works in.
class Runner {
public:
    Runner(const Plan& plan, Stencil stencil, const KernelArguments& arguments)
        : plan_(plan),
          stencil_(stencil),
          arguments_(arguments),
          scalars_(plan.scalar_steps.size()),
          registers_(static_cast<std::size_t>(plan.register_count * block_cells)) {
        for (std::size_t k = 0; k < scalars_.size(); ++k) {
            scalars_[k] = to_number(scalar(plan.scalar_steps[k]));
        }
    }

    void run(RowRange rows) {
        const PlaneLayout& layout = arguments_.layout;
        for (std::int64_t number = rows.begin; number < rows.end; ++number) {
            row_ = number % layout.height;
            slice_ = number / layout.height;
            for (column_ = 0; column_ < layout.width; column_ += block_cells) {
                count_ = std::min(block_cells, layout.width - column_);
                offset_ = layout.row_start(number) + column_;
                for (const BlockStep& step : plan_.block_steps) compute(step);
                for (std::size_t k = 0; k < plan_.results.size(); ++k) store(k);
            }
        }
    }

private:
    std::uint32_t scalar(const ScalarStep& step) const {
        if (step.op == Op::constant) return step.payload;
        if (step.op == Op::uniform) return to_bits(arguments_.uniforms[step.payload]);
        const auto word = [&](std::size_t k) { return to_bits(scalars_[step.operands[k]]); };
        switch (info(step.op).arity) {
            case 1: return evaluate(step.op, word(0), 0, 0);
            case 2: return evaluate(step.op, word(0), word(1), 0);
            default: return evaluate(step.op, word(0), word(1), word(2));
        }
    }

    float* register_of(std::uint32_t index) {
        return registers_.data() + static_cast<std::int64_t>(index) * block_cells;
    }

    const float* address(Place place) {
        switch (place.kind) {
            case Place::Kind::scalar: return scalars_.data() + place.index;
            case Place::Kind::field: return arguments_.fields[place.index] + offset_;
            case Place::Kind::beside: return beside(Neighbour::of(place.index));
            case Place::Kind::vector: return register_of(place.index);
            case Place::Kind::nowhere: return nullptr;
        }
        return nullptr;
    }

    const float* beside(Neighbour at) const {
        std::int64_t offset = offset_;
        if (stencil_.x) offset += at.dx;
        if (stencil_.y) offset += at.dy * arguments_.layout.stride;
        if (stencil_.z) offset += at.dz * arguments_.layout.slice_stride;
        return arguments_.fields[at.slot] + offset;
    }

    void compute(const BlockStep& step) {
        float* out = register_of(step.target);
        if (step.loop) {
            step.loop(out, address(step.operands[0]), address(step.operands[1]),
                      address(step.operands[2]), count_);
            return;
        }
        switch (step.op) {
            case Op::laplacian: laplacian(out, arguments_.fields[step.payload] + offset_); break;
            case Op::mask: mask(out, arguments_.masks[step.payload] + offset_); break;
            case Op::cell_column:
                for (std::int64_t i = 0; i < count_; ++i) {
                    out[i] = to_number(static_cast<std::uint32_t>(column_ + i));
                }
                break;
            case Op::cell_row:
                std::fill_n(out, count_, to_number(static_cast<std::uint32_t>(row_)));
                break;
            case Op::cell_slice:
                std::fill_n(out, count_, to_number(static_cast<std::uint32_t>(slice_)));
                break;
            default: CHECK(false, "interpreter: every source has its loop");
        }
    }

    // The order of the sums is the specification's: ((((N + S) + E) + W) + U) + D.
    void laplacian(float* __restrict out, const float* c) const {
        const std::int64_t count = count_;
        if (stencil_ == Stencil::plane) {
            const float* north = c - arguments_.layout.stride;
            const float* south = c + arguments_.layout.stride;
            for (std::int64_t i = 0; i < count; ++i) {
                out[i] = (((north[i] + south[i]) + c[i + 1]) + c[i - 1]) - 4.0f * c[i];
            }
            return;
        }
        // Other grids one pair after the other.
        bool is_first = true;
        const auto add_pair = [&](const float* first, const float* second) {
            for (std::int64_t i = 0; i < count; ++i) {
                out[i] = is_first ? first[i] + second[i] : (out[i] + first[i]) + second[i];
            }
            is_first = false;
        };
        const std::int64_t row = arguments_.layout.stride, slice = arguments_.layout.slice_stride;
        if (stencil_.y) add_pair(c - row, c + row);
        if (stencil_.x) add_pair(c + 1, c - 1);
        if (stencil_.z) add_pair(c - slice, c + slice);
        const auto neighbours = static_cast<float>(2 * stencil_.axes());
        for (std::int64_t i = 0; i < count; ++i) out[i] -= neighbours * c[i];
    }

    void mask(float* __restrict out, const std::uint8_t* bytes) const {
        for (std::int64_t i = 0; i < count_; ++i) out[i] = bytes[i] != 0 ? 1.0f : 0.0f;
    }

    void store(std::size_t result) {
        const Place place = plan_.results[result];
        float* out = arguments_.results[result] + offset_;
        if (place.kind == Place::Kind::scalar) {
            std::fill_n(out, count_, scalars_[place.index]);
        } else {
            std::memcpy(out, address(place), static_cast<std::size_t>(count_) * sizeof(float));
        }
    }

    const Plan& plan_;
    Stencil stencil_;
    const KernelArguments& arguments_;
    std::vector<float> scalars_;
    std::vector<float> registers_;
    std::int64_t row_ = 0;     ///< In its slice.
    std::int64_t slice_ = 0;
    std::int64_t column_ = 0;  ///< Of the block's first cell.
    std::int64_t count_ = 0;   ///< Cells of the block.
    std::int64_t offset_ = 0;  ///< Of the block's first cell from cell (0, 0, 0), in elements.
};

class InterpretedKernel : public Kernel {
public:
    InterpretedKernel(const CellKernel& kernel, Stencil stencil)
        : plan_(Planner(kernel).plan()),
          stencil_(stencil),
          field_count_(kernel.field_names.size()),
          mask_count_(kernel.mask_names.size()),
          uniform_count_(kernel.uniform_names.size()) {}

    void run(const KernelArguments& arguments, RowRange rows) const override {
        CHECK(arguments.fields.size() == field_count_ && arguments.masks.size() == mask_count_ &&
                  arguments.uniforms.size() == uniform_count_ &&
                  arguments.results.size() == plan_.results.size(),
              "interpreter: a kernel gets an argument for every slot and result");
        Runner(plan_, stencil_, arguments).run(rows);
    }

private:
    Plan plan_;
    Stencil stencil_;
    std::size_t field_count_, mask_count_, uniform_count_;
};

/// Planning costs about as much as the hash that a cache would need, so nothing is kept.
class Interpreter : public Backend {
public:
    std::string_view name() const override { return "interp"; }

    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        return std::make_shared<const InterpretedKernel>(kernel, stencil);
    }
};

}  // namespace

std::unique_ptr<Backend> make_interpreter() { return std::make_unique<Interpreter>(); }

}  // namespace cascade
