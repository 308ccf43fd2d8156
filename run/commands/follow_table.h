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

struct StatePictures;

/// The name of a kind of special point. Empty for other points.
std::string_view word_of(continuation::PointKind kind);

/// Describes states of a stage by numbers.
class FollowTable {
public:
    /// The names of the species, in the order of the unknowns.
    const std::vector<std::string>& species() const { return species_; }

    /// `areas` has the area of each cell, by which means are weighted.
    FollowTable(const Program& program, std::uint32_t stage, ItemId varied,
                continuation::Vector areas);

    /// The names of the numbers of a state: for each species its norm, least, largest and mean
    /// value.
    const std::vector<std::string>& numbers() const { return numbers_; }
    /// The index in numbers() of the number with this name, such as "max_u", or "max" for the first
    /// species. Fails with a list of the names.
    Result<std::size_t> find_number(std::string_view name) const;

    /// The table as CSV, with a row for each point.
    std::string csv(const std::vector<continuation::Branch>& branches) const;
    /// The branches as a JSON array, for the answer of --json.
    std::string json(const std::vector<continuation::Branch>& branches) const;
    /// A line for each branch, its special points and its ends.
    std::string words(const std::vector<continuation::Branch>& branches) const;
    /// Curves of a number over the parameter: solid where states are stable, dashed where not.
    /// Pictures of some states stand below.
    Drawing diagram(const std::vector<continuation::Branch>& branches, std::size_t number,
                    const std::string& title, const StatePictures& pictures) const;

    /// The numbers of a state, in the order of numbers().
    std::vector<double> measured(const continuation::Vector& state) const;

private:
    std::string name_of_varied_;
    std::vector<std::string> species_, numbers_;
    continuation::Vector areas_;
};

}  // namespace cascade
