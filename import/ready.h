// Patterns of Ready (github.com/GollyGang/ready): the data that the readers of a file's parts
// share.
#pragma once

#include "import/importer.h"
#include "import/vtk_arrays.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace cascade::importing {

/// The properties of a pattern that its reader has found.
struct ReadyPattern {
    Import& import;
    FreeNames names = {};
    /// The cells along x, y and z. In Ready, y points upwards. Cascade's rows run downwards, so
    /// that pictures look the same.
    std::array<std::int64_t, 3> cells = {1, 1, 1};
    bool is_periodic = true;
    bool has_nine_cells = false;  ///< Whether Laplacians in the plane read nine cells.
    /// The names of the species in the script, in Ready's order.
    std::vector<std::string> species = {};
    /// The names of parameters in the script, by their names in Ready.
    std::map<std::string, std::string> parameters = {};
    /// The values of parameters, by their names in Ready.
    std::map<std::string, double> values = {};

    int axes() const {
        return static_cast<int>(cells[0] > 1) + static_cast<int>(cells[1] > 1) +
               static_cast<int>(cells[2] > 1);
    }
    std::int64_t longest() const { return std::max({cells[0], cells[1], cells[2]}); }
    bool has_spacing() const { return values.contains("dx"); }
};

/// Ready's name of the chemical `index`: a … z, aa … az, ba …
std::string ready_chemical(std::size_t index);
/// The number of a chemical. Empty if no chemical has this name.
std::optional<std::size_t> ready_chemical_number(std::string_view name, std::size_t count);

/// Adds the definitions and rates of the formula. Returns false after an error.
bool add_ready_formula(ReadyPattern& pattern, const pugi::xml_node& formula, Draft& draft);

/// Adds the starting values that result from the overlays of the file. `stored` are the starting
/// values of species that no overlay overwrites. Returns false after an error.
bool add_ready_start(ReadyPattern& pattern, const pugi::xml_node& generator,
                     const std::vector<std::string>& stored, Draft& draft);

}  // namespace cascade::importing
