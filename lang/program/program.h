// The checked program. All names in it are resolved, all arguments are counted, and the order in
// which values are computed is known. The program contains no user errors, so code that reads it
// reports no user errors and only uses CHECK.
#pragma once

#include "lang/program/domain.h"
#include "lang/program/literals.h"
#include "lang/program/stage.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace cascade {

struct Program {
    IdVector<SystemId, System> systems;  ///< Built-in systems come first.
    std::vector<Stage> stages;
    DomainSettings domain;
    std::shared_ptr<Literals> literals =
        std::make_shared<Literals>();  ///< Never null. Copies of a program share the same Literals.

    const System& system_of(std::uint32_t stage) const { return systems[stages[stage].system]; }
};

/// Whether the value of a node in a formula of `stage` may differ from cell to cell.
/// `operand_differs` is true if the value of any operand may differ. If it is not yet known whether
/// an item of the stage differs, the item counts as different.
bool differs_by_cell(const Node& node, bool operand_differs, const Program& program,
                     std::uint32_t stage);

/// The program as text for `--dump program`: systems in use, stages, resolved formulas, orders, and
/// which values vary by cell.
std::string print_program(const Program& program);

}  // namespace cascade
