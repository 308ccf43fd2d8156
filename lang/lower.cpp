// The kernels of a stage: its start, its step and its rates.
#include "lang/lower.h"

#include "core/check.h"
#include "lang/check_circles.h"
#include "lang/lower_formula.h"

namespace cascade {

namespace {

using lowering::KernelAssembly;

BoundKernel lower_start(const Program& program, std::uint32_t stage, bool uniform) {
    KernelAssembly assembly(program, stage);
    const Stage& source = program.stages[stage];
    std::vector<std::uint32_t> results;
    for (const std::uint32_t item : source.order) {
        if (source.uniform[item] != uniform) continue;
        const std::string name(assembly.system().item_name(item));
        const ValueId value = assembly.formula(source.items[item], {name, false});
        assembly.set_own(item, value);
        assembly.result(name, value);
        results.push_back(item);
    }
    return std::move(assembly).finish(std::move(results));
}

std::vector<std::uint32_t> species_items(const System& system) {
    std::vector<std::uint32_t> items;
    for (std::uint32_t item = 0; item < system.quantities.size(); ++item) {
        if (system.quantities[item].is_species) items.push_back(item);
    }
    return items;
}

/// Which of the definitions and rates the rates of species need, by their numbers in
/// step_dependencies: a definition that nothing needs must not take up slots.
std::vector<bool> needed_values(const System& system, const Dependencies& reads,
                                const std::vector<std::uint32_t>& order) {
    std::vector<bool> needed(reads.size(), false);
    for (const std::uint32_t item : system.rate_order) {
        needed[system.definitions.size() + item] = true;
    }
    for (std::size_t i = order.size(); i > 0; --i) {
        if (!needed[order[i - 1]]) continue;
        for (const std::uint32_t read : reads[order[i - 1]]) needed[read] = true;
    }
    return needed;
}

/// Computes the rates of all species, in order of their items.
std::vector<ValueId> add_rates(KernelAssembly& assembly) {
    const System& system = assembly.system();
    const Dependencies reads = step_dependencies(system);
    const std::vector<std::uint32_t> order = topological_order(reads).order;
    const std::vector<bool> needed = needed_values(system, reads, order);
    const auto definition_count = static_cast<std::uint32_t>(system.definitions.size());
    std::vector<ValueId> rates(system.quantities.size());
    for (const std::uint32_t value : order) {
        if (!needed[value]) continue;
        if (value < definition_count) {
            const Definition& definition = system.definitions[value];
            assembly.set_definition(
                value, assembly.formula(definition.formula, {definition.name, true}));
            continue;
        }
        const std::uint32_t item = value - definition_count;
        rates[item] =
            assembly.formula(system.rates[item], {system.quantities[item].name + "'", true});
        assembly.set_rate(item, rates[item]);
    }
    return rates;
}

/// Species take the first slots, in order of their items.
void read_species(KernelAssembly& assembly, std::uint32_t stage,
                  const std::vector<std::uint32_t>& species) {
    for (const std::uint32_t item : species) assembly.field_slot(stage, item);
    assembly.read_frozen_as_mask();
}

}  // namespace

BoundKernel lower_uniform_start(const Program& program, std::uint32_t stage) {
    return lower_start(program, stage, true);
}

BoundKernel lower_cell_start(const Program& program, std::uint32_t stage) {
    return lower_start(program, stage, false);
}

BoundKernel lower_rates(const Program& program, std::uint32_t stage) {
    KernelAssembly assembly(program, stage);
    const System& system = assembly.system();
    const std::vector<std::uint32_t> species = species_items(system);
    read_species(assembly, stage, species);
    const std::vector<ValueId> rates = add_rates(assembly);
    for (const std::uint32_t item : species) {
        assembly.result(system.quantities[item].name, rates[item]);
    }
    return std::move(assembly).finish(species);
}

BoundKernel lower_step(const Program& program, std::uint32_t stage) {
    KernelAssembly assembly(program, stage);
    KernelBuilder& builder = assembly.builder();
    const System& system = assembly.system();
    const std::vector<std::uint32_t> species = species_items(system);
    read_species(assembly, stage, species);
    const std::vector<ValueId> rates = add_rates(assembly);

    std::vector<ValueId> next(system.quantities.size());
    for (const std::uint32_t item : species) {
        const ValueId change =
            builder.multiply(assembly.own_item(system.speed_item()), rates[item]);
        next[item] = builder.add(assembly.own_item(item), change);
    }
    for (const Invariant& invariant : system.invariants) {
        const ValueId bound = assembly.formula(invariant.bound, {});
        ValueId& value = next[invariant.species];
        value = invariant.at_least ? builder.clamp_below(value, bound)
                                   : builder.clamp_above(value, bound);
    }
    const bool freezes = !program.stages[stage].uniform[system.frozen_item()];
    for (const std::uint32_t item : species) {
        if (freezes) {
            next[item] = builder.select(assembly.own_item(system.frozen_item()),
                                        assembly.own_item(item), next[item]);
        }
        assembly.result(system.quantities[item].name, next[item]);
    }
    return std::move(assembly).finish(species);
}

}  // namespace cascade
