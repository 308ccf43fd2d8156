// Runs the plans of kernels (ir/block_plan.h) block by block. Fields are read from memory without
// copying them. Values of links are computed for the first link of every cell of a block, then for
// the second link of every cell, and so on.
#include "ir/interpreter.h"

#include "core/check.h"
#include "core/floating_point.h"
#include "ir/block_plan.h"
#include "ir/word_operations.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace cascade {
namespace {

using namespace interpreting;

/// One run of a plan: its arguments and its working memory.
template <typename Number>
class Runner {
public:
    Runner(const Plan<Number>& plan, Stencil stencil, const KernelArgumentsOf<Number>& arguments)
        : plan_(plan),
          stencil_(stencil),
          arguments_(arguments),
          scalars_(plan.scalar_steps.size()),
          registers_(static_cast<std::size_t>(plan.register_count * block_cells)) {
        for (std::size_t k = 0; k < scalars_.size(); ++k) {
            scalars_[k] = number(scalar(plan.scalar_steps[k]));
        }
    }

    void run(const Patch& cells) {
        const PlaneLayout& layout = arguments_.layout;
        const ColumnRange columns = cells.columns.within(layout.width);
        for (std::int64_t number = cells.rows.begin; number < cells.rows.end; ++number) {
            row_ = number % layout.height;
            slice_ = number / layout.height;
            for (column_ = columns.begin; column_ < columns.end; column_ += block_cells) {
                count_ = std::min(block_cells, columns.end - column_);
                offset_ = layout.row_start(number) + column_;
                for (const Section<Number>& section : plan_.sections) compute(section);
                for (std::size_t k = 0; k < plan_.results.size(); ++k) store(k);
            }
        }
    }

private:
    using Word = WordOf<Number>;

    static Number number(Word word) { return std::bit_cast<Number>(word); }
    static Word bits(Number value) { return std::bit_cast<Word>(value); }

    Word scalar(const ScalarStep& step) const {
        if (step.op == Op::constant) return static_cast<Word>(step.payload);
        if (step.op == Op::uniform) return bits(arguments_.uniforms[step.payload]);
        const auto word = [&](std::size_t k) { return bits(scalars_[step.operands[k]]); };
        const int arity = info(step.op).arity;
        return static_cast<Word>(evaluate(step.op, word(0), arity > 1 ? word(1) : 0,
                                          arity > 2 ? word(2) : 0, precision_of<Number>));
    }

    Number* register_of(std::uint32_t index) {
        return registers_.data() + static_cast<std::int64_t>(index) * block_cells;
    }

    const Number* address(Location location) {
        switch (location.kind) {
            case Location::Kind::scalar: return scalars_.data() + location.index;
            case Location::Kind::field: return arguments_.fields[location.index] + offset_;
            case Location::Kind::beside: return beside(Neighbour::of(location.index));
            case Location::Kind::vector: return register_of(location.index);
            case Location::Kind::nowhere: return nullptr;
        }
        return nullptr;
    }

    const Number* beside(Neighbour at) const {
        std::int64_t offset = offset_;
        if (stencil_.x) offset += at.dx;
        if (stencil_.y) offset += at.dy * arguments_.layout.stride;
        if (stencil_.z) offset += at.dz * arguments_.layout.slice_stride;
        return arguments_.fields[at.slot.index()] + offset;
    }

    void compute(const Section<Number>& section) {
        if (!section.reductions.empty()) return reduce_links(section);
        for (const BlockStep<Number>& step : section.steps) compute(step);
    }

    void reduce_links(const Section<Number>& section) {
        constexpr Number infinity = std::numeric_limits<Number>::infinity();
        for (const Reduction& each : section.reductions) {
            const Number first = each.op == Op::link_sum     ? Number{0}
                                 : each.op == Op::link_least ? infinity
                                                             : -infinity;
            std::fill_n(register_of(each.target), count_, first);
        }
        for (std::int64_t number = 0; find_links(number); ++number) {
            for (const BlockStep<Number>& step : section.steps) compute(step);
            for (const Reduction& each : section.reductions) reduce_links(each);
        }
        for (const Reduction& each : section.reductions) {
            if (each.op != Op::link_sum) continue;
            Number* const out = register_of(each.target);
            for (std::int64_t i = 0; i < count_; ++i) out[i] += Number{0};  // Turns −0 into 0.
        }
    }

    void reduce_links(const Reduction& reduction) {
        const bool is_scalar = reduction.operand.kind == Location::Kind::scalar;
        const Number* const a = address(reduction.operand);
        Number* const out = register_of(reduction.target);
        for (std::int64_t i = 0; i < count_; ++i) {
            const auto place = static_cast<std::size_t>(i);
            if (has_link_[place]) out[i] = reduced(reduction.op, out[i], a[is_scalar ? 0 : i]);
        }
    }

    /// Combines the result `before` of earlier links with the value `a` of the next link. The
    /// result is NaN if either value is NaN.
    static Number reduced(Op op, Number before, Number a) {
        const Number value = keeps_denormals() ? a : flushed(a);
        if (op == Op::link_sum) return before + value;
        const bool is_farther = op == Op::link_least ? before < value : before > value;
        return std::isnan(before) || is_farther ? before : value;
    }

    /// Finds link number `number` of each cell of the block. Returns false if no cell has so many
    /// links.
    bool find_links(std::int64_t number) {
        constexpr std::int64_t slice_cells = LinkTable<Number>::slice_cells;
        const LinkTable<Number>& links = arguments_.links;
        bool has_entries = false;
        for (std::int64_t i = 0; i < count_; ++i) {
            const std::int64_t slice = first_slice() + i / slice_cells, lane = i % slice_cells;
            const std::int64_t entry = links.starts[slice] + number;
            const bool is_entry = entry < links.starts[slice + 1];
            const auto place = static_cast<std::size_t>(i);
            has_entries = has_entries || is_entry;
            has_link_[place] = is_entry && (links.filled[entry] >> lane & 1) != 0;
            targets_[place] =
                has_link_[place] ? links.target(entry * slice_cells + lane) : offset_ + i;
        }
        return has_entries;
    }

    /// The slice that contains the block's first cell.
    std::int64_t first_slice() const {
        constexpr std::int64_t slice_cells = LinkTable<Number>::slice_cells;
        const std::int64_t slices = (arguments_.layout.width + slice_cells - 1) / slice_cells;
        return row_ * slices + column_ / slice_cells;
    }

    void compute(const BlockStep<Number>& step) {
        Number* out = register_of(step.target);
        if (step.loop) {
            step.loop(out, address(step.operands[0]), address(step.operands[1]),
                      address(step.operands[2]), count_);
            return;
        }
        switch (step.op) {
            case Op::laplacian:
                if (stencil_.links) {
                    over_links(out, step);
                } else {
                    laplacian(out, arguments_.fields[step.payload] + offset_);
                }
                break;
            case Op::link_flow:
            case Op::link_squares:
            case Op::link_weighted:
            case Op::gradient_x:
            case Op::gradient_y:
            case Op::gradient_z: over_links(out, step); break;
            case Op::theirs:
                for (std::int64_t i = 0; i < count_; ++i) {
                    out[i] = arguments_.fields[step.payload][targets_[static_cast<std::size_t>(i)]];
                }
                break;
            case Op::mask: mask(out, arguments_.masks[step.payload] + offset_); break;
            case Op::cell_column:
                for (std::int64_t i = 0; i < count_; ++i) {
                    out[i] = number(static_cast<Word>(column_ + i));
                }
                break;
            case Op::cell_row: std::fill_n(out, count_, number(static_cast<Word>(row_))); break;
            case Op::cell_slice: std::fill_n(out, count_, number(static_cast<Word>(slice_))); break;
            default: CHECK(false, "interpreter: every source has its loop");
        }
    }

    /// sum − times · c with one rounding, for times = 2 or 4. The product times · c is exact unless
    /// it overflows. If it would overflow, computes (sum / times − c) · times. Even if sum / times
    /// is denormal and flushed, the result is the same, because c is so large.
    template <int times>
    static Number minus_multiple(Number sum, Number c) {
        constexpr Number largest = std::numeric_limits<Number>::max() / 4;
        const Number near = sum - Number{times} * c;
        const Number far = Number{times} * (sum * (Number{1} / times) - c);
        return std::abs(c) > largest ? far : near;
    }

    // Adds in the order of the specification: ((((N + S) + E) + W) + U) + D.
    void laplacian(Number* __restrict out, const Number* c) const {
        const std::int64_t count = count_;
        if (stencil_ == Stencil::plane) {
            const Number* north = c - arguments_.layout.stride;
            const Number* south = c + arguments_.layout.stride;
            for (std::int64_t i = 0; i < count; ++i) {
                out[i] = minus_multiple<4>(((north[i] + south[i]) + c[i + 1]) + c[i - 1], c[i]);
            }
            return;
        }
        // All other stencils: adds the opposite neighbours in pairs, one axis after the other.
        bool is_first = true;
        const auto add_pair = [&](const Number* first, const Number* second) {
            for (std::int64_t i = 0; i < count; ++i) {
                out[i] = is_first ? first[i] + second[i] : (out[i] + first[i]) + second[i];
            }
            is_first = false;
        };
        const std::int64_t row = arguments_.layout.stride, slice = arguments_.layout.slice_stride;
        if (stencil_.y) add_pair(c - row, c + row);
        if (stencil_.x) add_pair(c + 1, c - 1);
        if (stencil_.z) add_pair(c - slice, c + slice);
        for (std::int64_t i = 0; i < count; ++i) {
            out[i] = stencil_.axes() == 1   ? minus_multiple<2>(out[i], c[i])
                     : stencil_.axes() == 2 ? minus_multiple<4>(out[i], c[i])
                                            : out[i] - Number{6} * c[i];
        }
    }

    void over_links(Number* out, const BlockStep<Number>& step) const {
        const LinkTable<Number>& links = arguments_.links;
        const Flow flow = Flow::with(step.payload);
        const Number* f = arguments_.fields[flow.of.index()];
        const auto gradient = [&](int axis) {
            const Number* weights = links.gradients[static_cast<std::size_t>(axis)];
            return [=](std::int64_t link, Number difference, std::int64_t, std::int64_t) {
                return weights[link] * difference;
            };
        };
        switch (step.op) {
            case Op::laplacian:
                return sum_over_links(out, f, [&](auto link, Number difference, auto, auto) {
                    return links.weights[link] * difference;
                });
            case Op::link_squares:
                return sum_over_links(out, f, [&](auto link, Number difference, auto, auto) {
                    return links.weights[link] * (difference * difference);
                });
            case Op::link_flow: {
                const Number* s = arguments_.fields[flow.factor.index()];
                return sum_over_links(out, f, [&](auto link, Number difference, auto i, auto j) {
                    return links.weights[link] * ((s[j] + s[i]) * difference);
                });
            }
            case Op::link_weighted: {
                const Number* s = arguments_.fields[flow.factor.index()];
                return sum_over_links(out, f, [&](auto link, Number difference, auto, auto) {
                    return s[link] * difference;
                });
            }
            case Op::gradient_x: return sum_over_links(out, f, gradient(0));
            case Op::gradient_y: return sum_over_links(out, f, gradient(1));
            default: return sum_over_links(out, f, gradient(2));
        }
    }

    /// Computes the sum of `term(link, f_j − f_i, i, j)` over the links of each cell i of the
    /// block, where j is the cell to which the link leads.
    template <typename Term>
    void sum_over_links(Number* __restrict out, const Number* f, const Term& term) const {
        constexpr std::int64_t slice_cells = LinkTable<Number>::slice_cells;
        const LinkTable<Number>& links = arguments_.links;
        for (std::int64_t first = 0; first < count_; first += slice_cells) {
            const std::int64_t slice = first_slice() + first / slice_cells;
            const std::int64_t cells = std::min(slice_cells, count_ - first);
            for (std::int64_t lane = 0; lane < cells; ++lane) {
                const std::int64_t i = offset_ + first + lane;
                Number sum = 0;
                for (std::int64_t entry = links.starts[slice]; entry < links.starts[slice + 1];
                     ++entry) {
                    const std::int64_t link = entry * slice_cells + lane;
                    const std::int64_t j = links.target(link);
                    sum += term(link, f[j] - f[i], i, j);
                }
                out[first + lane] = sum;
            }
        }
    }

    void mask(Number* __restrict out, const std::uint8_t* bytes) const {
        for (std::int64_t i = 0; i < count_; ++i) out[i] = bytes[i] != 0 ? Number{1} : Number{0};
    }

    void store(std::size_t result) {
        const Location location = plan_.results[result];
        Number* out = arguments_.results[result] + offset_;
        if (location.kind == Location::Kind::scalar) {
            std::fill_n(out, count_, scalars_[location.index]);
        } else {
            std::memcpy(out, address(location), static_cast<std::size_t>(count_) * sizeof(Number));
        }
        if (keeps_denormals()) flush(out);
    }

    /// Flushes denormal results to zeros of the same sign, as WebAssembly kernels do.
    void flush(Number* out) const {
        for (std::int64_t i = 0; i < count_; ++i) out[i] = flushed(out[i]);
    }

    static Number flushed(Number value) {
        const bool is_tiny = std::abs(value) < std::numeric_limits<Number>::min();
        return is_tiny ? std::copysign(Number{0}, value) : value;
    }

    const Plan<Number>& plan_;
    Stencil stencil_;
    const KernelArgumentsOf<Number>& arguments_;
    std::vector<Number> scalars_;
    std::vector<Number> registers_;
    std::int64_t row_ = 0;  ///< The row that contains the block, counted within its slice.
    std::int64_t slice_ = 0;
    std::int64_t column_ = 0;  ///< The column of the block's first cell.
    std::int64_t count_ = 0;   ///< The number of cells in the block.
    /// The index of the block's first element, counted from cell (0, 0, 0).
    std::int64_t offset_ = 0;
    // The link that is being reduced, for each cell of the block.
    std::array<bool, block_cells> has_link_{};
    /// The index of the element to which the link leads. If the cell has no such link, the index of
    /// the cell's own element.
    std::array<std::int64_t, block_cells> targets_{};
};

template <typename Number>
class InterpretedKernel : public Kernel {
public:
    InterpretedKernel(const CellKernel& kernel, Stencil stencil)
        : plan_(plan_blocks<Number>(kernel)),
          stencil_(stencil),
          field_count_(kernel.field_names.size()),
          mask_count_(kernel.mask_names.size()),
          uniform_count_(kernel.uniform_names.size()) {}

    using Kernel::run;
    void run(const KernelArgumentsOf<Number>& arguments, const Patch& cells) const override {
        CHECK(arguments.fields.size() == field_count_ && arguments.masks.size() == mask_count_ &&
                  arguments.uniforms.size() == uniform_count_ &&
                  arguments.results.size() == plan_.results.size(),
              "interpreter: a kernel gets an argument for every slot and result");
        Runner<Number>(plan_, stencil_, arguments).run(cells);
    }

private:
    Plan<Number> plan_;
    Stencil stencil_;
    std::size_t field_count_, mask_count_, uniform_count_;
};

/// Plans are not cached, because making a plan takes about as long as the hash that a cache would
/// need.
class Interpreter : public Backend {
public:
    std::string_view name() const override { return "interp"; }

    Result<KernelPointer> compile(const CellKernel& kernel, Stencil stencil) override {
        return with_number(kernel.precision, [&](auto zero) -> KernelPointer {
            return std::make_shared<const InterpretedKernel<decltype(zero)>>(kernel, stencil);
        });
    }

    KernelPointer find(const CellKernel& kernel, Stencil stencil) override {
        return *compile(kernel, stencil);
    }
};

}  // namespace

std::unique_ptr<Backend> make_interpreter() { return std::make_unique<Interpreter>(); }

}  // namespace cascade
