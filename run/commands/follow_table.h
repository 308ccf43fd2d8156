// The table and the diagram of branches of steady states.
#pragma once

#include "continuation/branch.h"
#include "core/result.h"
#include "lang/program/program.h"
#include "picture/drawing.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Describes states of a stage by numbers.
class FollowTable {
public:
    FollowTable(const Program& program, std::uint32_t stage, ItemId varied);

    /// The names of the numbers of a state: for each species its norm, least, largest and mean
    /// value.
    const std::vector<std::string>& numbers() const { return numbers_; }
    /// The number with this name, such as "max_u", or "max" for the first species. Fails with a
    /// list of the names.
    Result<std::size_t> find_number(std::string_view name) const;

    /// The table as CSV, with a row for each point.
    std::string csv(const std::vector<continuation::Branch>& branches) const;
    /// A line for each branch, its special points and its ends.
    std::string words(const std::vector<continuation::Branch>& branches) const;
    /// Curves of a number over the parameter: solid where states are stable, dashed where not.
    Drawing diagram(const std::vector<continuation::Branch>& branches, std::size_t number,
                    const std::string& title) const;

    /// The numbers of a state, in the order of numbers().
    std::vector<double> measured(const continuation::Vector& state) const;

private:
    std::string name_of_varied_;
    std::vector<std::string> species_, numbers_;
};

}  // namespace cascade
