// Orders the results so that results that share operations are adjacent, and cuts this list into
// parts of equal length.
#include "ir/kernel_parts.h"

#include "ir/loop_levels.h"

#include <algorithm>
#include <numeric>
#include <optional>

namespace cascade {
namespace {

// In tenths: a kernel stays whole if its parts together would take more than 12/10 of the time of
// the whole kernel.
constexpr std::size_t most_growth = 12;

/// Visits the values from which results are computed. Each value is visited once.
class Walk {
public:
    explicit Walk(const CellKernel& kernel) : kernel_(kernel), is_met_(kernel.code.size(), false) {}

    /// Visits the values from which `root` is computed and that no earlier call has visited, in no
    /// particular order. Calls `meet` with each value that the walk reaches and that has been
    /// visited before.
    template <typename Visit, typename Meet>
    void from(ValueId root, Visit visit, Meet meet) {
        open_.push_back(root);
        while (!open_.empty()) {
            const ValueId id = open_.back();
            open_.pop_back();
            if (is_met_[id]) {
                meet(id);
                continue;
            }
            is_met_[id] = true;
            visit(id);
            const Instruction& instruction = kernel_.code[id];
            for (int k = info(instruction.op).arity; k-- > 0;) {
                open_.push_back(instruction.operands[static_cast<std::size_t>(k)]);
            }
        }
    }

private:
    const CellKernel& kernel_;
    IdVector<ValueId, bool> is_met_;
    std::vector<ValueId> open_;
};

/// The results in an order in which related results follow each other. For example, one result is a
/// rate, and another is the new value computed from the same rate. A result that shares operations
/// with earlier results is moved behind the earlier result that computes the last shared operation.
std::vector<std::size_t> in_families(const CellKernel& kernel) {
    const std::size_t count = kernel.results.size();
    Walk walk(kernel);
    IdVector<ValueId, std::size_t> owner(kernel.code.size());
    std::vector<std::vector<std::size_t>> later(count);
    std::vector<std::size_t> open;
    for (std::size_t k = 0; k < count; ++k) {
        std::optional<ValueId> common;
        walk.from(
            kernel.results[k], [&](ValueId id) { owner[id] = k; },
            [&](ValueId id) {
                const bool is_operation = info(kernel.code[id].op).arity > 0;
                if (is_operation && owner[id] != k) common = std::max(common, std::optional(id));
            });
        (common ? later[owner[*common]] : open).push_back(k);
    }
    std::vector<std::size_t> order;
    std::reverse(open.begin(), open.end());
    while (!open.empty()) {
        const std::size_t k = open.back();
        open.pop_back();
        order.push_back(k);
        open.insert(open.end(), later[k].rbegin(), later[k].rend());
    }
    return order;
}

/// The part of a kernel that computes the given results.
KernelPart part_of(const CellKernel& kernel, std::vector<std::size_t> results) {
    KernelPart part{{}, std::move(results), true};
    part.kernel.precision = kernel.precision;
    part.kernel.field_names.resize(kernel.field_names.size());
    part.kernel.mask_names.resize(kernel.mask_names.size());
    part.kernel.uniform_names.resize(kernel.uniform_names.size());
    part.kernel.result_names.resize(part.results.size());
    Walk walk(kernel);
    IdVector<ValueId, ValueId> place(kernel.code.size());
    std::vector<ValueId> values;
    for (const std::size_t result : part.results) {
        values.clear();
        walk.from(
            kernel.results[result], [&](ValueId id) { values.push_back(id); }, [](ValueId) {});
        std::sort(values.begin(), values.end());
        for (const ValueId id : values) {
            Instruction instruction = kernel.code[id];
            for (int k = 0; k < info(instruction.op).arity; ++k) {
                ValueId& operand = instruction.operands[static_cast<std::size_t>(k)];
                operand = place[operand];
            }
            place[id] = part.kernel.code.next();
            part.kernel.code.push_back(instruction);
        }
        part.kernel.results.push_back(place[kernel.results[result]]);
    }
    return part;
}

/// The size of a kernel, as a measure of its run time. Values of links count `links` times. `links`
/// is a typical number of neighbours of a cell.
std::size_t time_of(const CellKernel& kernel) {
    constexpr std::size_t links = 12;
    constexpr std::size_t operations_of_gather = 8;
    std::size_t time = size_of(kernel);
    for (const LinkLoop& loop : cell_schedule_of(kernel, loop_levels_of(kernel)).loops) {
        time += links * (loop.values.size() + loop.reductions.size());
        for (const ValueId id : loop.values) {
            if (kernel.code[id].op == Op::theirs) time += links * operations_of_gather;
        }
    }
    return time;
}

}  // namespace

std::size_t size_of(const CellKernel& kernel) {
    // How many instructions take as long to compile as the loads of one operation.
    constexpr std::size_t loads_of_laplacian = 10;
    constexpr std::size_t loads_of_neighbour = 2;
    std::size_t size = kernel.code.size();
    for (const Instruction& instruction : kernel.code) {
        if (is_link_sum(instruction.op)) size += loads_of_laplacian;
        if (instruction.op == Op::neighbour) size += loads_of_neighbour;
    }
    return size;
}

std::vector<KernelPart> parts_of(const CellKernel& kernel) {
    const std::size_t count = kernel.results.size();
    if (count <= most_results_of_a_part) {
        std::vector<std::size_t> results(count);
        std::iota(results.begin(), results.end(), std::size_t{0});
        return {{kernel, std::move(results)}};
    }
    const std::vector<std::size_t> order = in_families(kernel);
    const KernelPart whole = part_of(kernel, order);
    const std::size_t most_time = time_of(whole.kernel) * most_growth / 10;
    const std::size_t parts = (count + most_results_of_a_part - 1) / most_results_of_a_part;
    std::vector<KernelPart> divided;
    std::size_t time = 0;
    for (std::size_t k = 0; k < parts; ++k) {
        const auto at = [&](std::size_t part) {
            return order.begin() + static_cast<std::ptrdiff_t>(part * count / parts);
        };
        divided.push_back(part_of(kernel, {at(k), at(k + 1)}));
        time += time_of(divided.back().kernel);
        if (time > most_time) return {whole};
    }
    return divided;
}

}  // namespace cascade
