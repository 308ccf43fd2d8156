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

/// Returns the word for a kind of special points, and an empty string for regular points.
std::string_view word_of(continuation::PointKind kind);

/// Describes states of a stage by numbers.
class FollowTable {
public:
    /// The names of the species, in the order of the unknowns.
    const std::vector<std::string>& species() const { return species_; }

    /// `areas` contains the area of each cell, by which the means are weighted.
    FollowTable(const Program& program, std::uint32_t stage, ItemId varied,
                continuation::Vector areas);

    /// The names of the numbers that describe a state: for each species the norm, and the smallest,
    /// largest and mean value.
    const std::vector<std::string>& numbers() const { return numbers_; }
    /// Returns the index in numbers() of a number, such as "max_u". "max" is the number of the
    /// first species. Fails with a list of the names if there is no such number.
    Result<std::size_t> find_number(std::string_view name) const;

    /// Writes a table as CSV, with a row for each point.
    std::string csv(const std::vector<continuation::Branch>& branches) const;
    /// Writes the branches as a JSON array for the answer of --json.
    std::string json(const std::vector<continuation::Branch>& branches) const;
    /// Describes each branch in a line, followed by a line for each of its special points and ends.
    std::string words(const std::vector<continuation::Branch>& branches) const;
    /// Draws curves of a number over the parameter: solid where states are stable, dashed where
    /// they are not. Below the diagram, there are pictures of some states.
    Drawing diagram(const std::vector<continuation::Branch>& branches, std::size_t number,
                    const std::string& title, const StatePictures& pictures) const;

    /// Computes the numbers that describe a state, in the order of numbers().
    std::vector<double> measured(const continuation::Vector& state) const;

private:
    std::string name_of_varied_;
    std::vector<std::string> species_, numbers_;
    continuation::Vector areas_;
};

}  // namespace cascade
