// Models in SBML, the Systems Biology Markup Language: the data that the module with libSBML reads
// from a file.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cascade::importing {

/// A formula in the infix notation of SBML Level 3, and its line in the file. Time has the name
/// `sbml_time`. The text is empty if the file gives no formula.
struct SbmlFormula {
    std::string text;
    unsigned line = 0;
};

/// A parameter, a compartment, a species, or an assigned value.
struct SbmlQuantity {
    std::string id;
    SbmlFormula value;
};

/// The rate of change of a quantity: a rule, or the sum of reactions with their factors.
struct SbmlRate {
    std::string id;
    SbmlFormula start;
    SbmlFormula rule;
    /// The factor and the id of each reaction.
    std::vector<std::pair<double, std::string>> reactions;
    /// The sum of reactions is divided by the size of this compartment. Empty if it is not divided.
    std::string compartment;
};

struct SbmlModel {
    std::string name;
    std::vector<SbmlQuantity> constants;    ///< Includes the sizes of compartments.
    std::vector<SbmlQuantity> assignments;  ///< Rules, and the rates of reactions by their ids.
    std::vector<SbmlRate> rates;
    /// Problems that prevent the import, with their lines. If there are problems, all other members
    /// are meaningless.
    std::vector<std::pair<unsigned, std::string>> problems;
};

/// The module's only symbol: a function that takes the version of its caller and returns the
/// reader, or null if the module has another version.
inline constexpr const char* sbml_reader_symbol = "cascade_sbml_reader";
using SbmlReader = SbmlModel(const std::string& text);
using SbmlReaderEntry = SbmlReader*(std::string_view version);

}  // namespace cascade::importing
