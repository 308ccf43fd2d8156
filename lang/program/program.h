// The checked program: every name is resolved, every argument counted, every order known. It
// contains no user error, so later stages only CHECK.
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
    IdVector<SystemId, System> systems;  ///< Built-in ones first.
    std::vector<Stage> stages;
    DomainSettings domain;
    std::shared_ptr<Literals> literals =
        std::make_shared<Literals>();  ///< Never null; shared by copies.

    const System& system_of(std::uint32_t stage) const { return systems[stages[stage].system]; }
};

/// Does a node of a formula of `stage` differ from cell to cell? `operand_differs` says whether one
/// of its operands does. Items of the stage that are not known yet count as different.
bool differs_by_cell(const Node& node, bool operand_differs, const Program& program,
                     std::uint32_t stage);

/// The program as text for `--dump program`: systems in use, stages, resolved formulas, orders, and
/// which values vary.
std::string print_program(const Program& program);

}  // namespace cascade
