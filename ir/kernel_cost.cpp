// Counts the cost instruction by instruction. A neighbour's value, a mask or a link table that is
// loaded several times counts once.
#include "ir/kernel_cost.h"

#include "ir/loop_levels.h"

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace cascade {

namespace {

/// For each value, whether it is a negation that only multiply-adds read. Such a negation costs
/// nothing, because the multiply-add includes it.
IdVector<ValueId, bool> signs_of_multiply_adds(const CellKernel& kernel) {
    IdVector<ValueId, bool> is_sign;
    for (const Instruction& instruction : kernel.code) {
        is_sign.push_back(instruction.op == Op::negate);
        if (instruction.op == Op::multiply_add) continue;
        for (int k = 0; k < info(instruction.op).arity; ++k) {
            is_sign[instruction.operands[static_cast<std::size_t>(k)]] = false;
        }
    }
    for (const ValueId id : kernel.results) is_sign[id] = false;
    return is_sign;
}

/// Counts the cost of one kernel.
class Counter {
public:
    Counter(const CellKernel& kernel, Stencil stencil, double links)
        : kernel_(kernel),
          stencil_(stencil),
          links_(links),
          word_(static_cast<double>(format_of(kernel.precision).bits) / 8),
          varies_(varying(kernel)),
          is_folded_(signs_of_multiply_adds(kernel)) {}

    KernelCost count() {
        const IdVector<ValueId, LoopLevel> levels = loop_levels_of(kernel_);
        for (const ValueId id : kernel_.code.ids()) {
            if (levels[id] != LoopLevel::link) add(id, 1);
        }
        for (const LinkLoop& loop : cell_schedule_of(kernel_, levels).loops) {
            load_places();
            for (const ValueId id : loop.values) add(id, links_);
        }
        const auto stores = static_cast<double>(kernel_.results.size());
        cost_.stores += stores;
        cost_.store_bytes += stores * word_;
        return cost_;
    }

private:
    using Read = std::tuple<FieldSlot, int, int, int>;

    /// Adds the cost of a value that is computed `times` times per cell.
    void add(ValueId id, double times) {
        if (!varies_[id] || is_folded_[id]) return;
        const Instruction& instruction = kernel_.code[id];
        switch (instruction.op) {
            case Op::cell_column:
            case Op::cell_row:
            case Op::cell_slice: break;
            case Op::field: load({instruction.field(), 0, 0, 0}); break;
            case Op::neighbour: load(within_stencil(Neighbour::of(instruction.slot()))); break;
            case Op::mask: load_mask(MaskSlot(instruction.slot())); break;
            case Op::laplacian: add_laplacian(instruction.field()); break;
            case Op::link_flow: {
                const Flow flow = Flow::with(instruction.payload);
                add_link_sum({flow.factor, flow.of}, {}, 5);
                break;
            }
            case Op::link_weighted: {
                const Flow flow = Flow::with(instruction.payload);
                add_link_sum({flow.of}, {instruction.op, flow.factor}, 3);
                break;
            }
            case Op::link_squares: add_link_sum({instruction.field()}, {}, 4); break;
            case Op::gradient_x:
            case Op::gradient_y:
            case Op::gradient_z: add_link_sum({instruction.field()}, {instruction.op}, 3); break;
            case Op::theirs: gather(instruction.field()); break;
            case Op::link_sum:
            case Op::link_least:
            case Op::link_greatest: cost_.operations += links_; break;
            default: add_operation(instruction, times);
        }
    }

    void add_operation(const Instruction& instruction, double times) {
        cost_.operations += times;
        if (instruction.op == Op::divide || instruction.op == Op::square_root) {
            cost_.divisions += times;
        }
    }

    /// The value that reading a neighbour loads. Along an axis that has only one cell, the
    /// neighbour is the cell itself.
    Read within_stencil(const Neighbour& at) const {
        return {at.slot, stencil_.x ? at.dx : 0, stencil_.y ? at.dy : 0, stencil_.z ? at.dz : 0};
    }

    void load(const Read& read) {
        if (!loaded_.insert(read).second) return;
        cost_.loads += 1;
        cost_.load_bytes += word_;
    }

    void load_mask(MaskSlot slot) {
        if (!masks_.insert(slot).second) return;
        cost_.loads += 1;
        cost_.load_bytes += 1;
    }

    void add_laplacian(FieldSlot slot) {
        if (stencil_.links) return add_link_sum({slot}, {}, 3);
        load({slot, 0, 0, 0});
        for (const int side : {-1, 1}) {
            if (stencil_.x) load({slot, side, 0, 0});
            if (stencil_.y) load({slot, 0, side, 0});
            if (stencil_.z) load({slot, 0, 0, side});
        }
        // n pairs of neighbours take 2 n − 1 sums. A product and a difference follow, so n pairs
        // take 2 n + 1 operations.
        cost_.operations += 2 * stencil_.axes() + 1;
    }

    /// Identifies the link weights that a sum reads. A Laplacian and each component of the gradient
    /// have their own weights. Any other sum reads the weights in the plane of `slot`.
    struct Weights {
        Op op = Op::laplacian;
        FieldSlot slot{};
        friend auto operator<=>(const Weights&, const Weights&) = default;
    };

    void add_link_sum(std::initializer_list<FieldSlot> slots, Weights weights, double operations) {
        cost_.operations += operations * links_;
        for (const FieldSlot slot : slots) {
            load({slot, 0, 0, 0});
            gather(slot);
        }
        load_places();
        if (!weights_.insert(weights).second) return;
        cost_.loads += links_;
        add_link_bytes(word_);
    }

    /// Adds the loads of a field in the cells to which links lead.
    void gather(FieldSlot slot) {
        if (!gathered_.insert(slot).second) return;
        cost_.loads += links_;
        cost_.load_bytes += links_ * word_;
    }

    void load_places() {
        if (std::exchange(has_places_, true)) return;
        cost_.loads += links_;
        add_link_bytes(sizeof(std::int32_t));
    }

    void add_link_bytes(double bytes) {
        cost_.load_bytes += links_ * bytes;
        cost_.link_bytes += links_ * bytes;
    }

    const CellKernel& kernel_;
    Stencil stencil_;
    double links_;
    double word_;  ///< The size of a word in bytes.
    IdVector<ValueId, bool> varies_, is_folded_;
    std::set<Read> loaded_;
    std::set<MaskSlot> masks_;
    std::set<FieldSlot> gathered_;
    std::set<Weights> weights_;
    bool has_places_ = false;
    KernelCost cost_;
};

}  // namespace

KernelCost& KernelCost::operator+=(const KernelCost& other) {
    operations += other.operations;
    divisions += other.divisions;
    loads += other.loads;
    stores += other.stores;
    load_bytes += other.load_bytes;
    store_bytes += other.store_bytes;
    link_bytes += other.link_bytes;
    return *this;
}

KernelCost cost_of(const CellKernel& kernel, Stencil stencil, double links) {
    return Counter(kernel, stencil, links).count();
}

}  // namespace cascade
