// Writes fields over time, or fields of many runs, as HDF5 files (The HDF Group, "HDF5 File Format
// Specification", version 1), in the layout of netCDF-4, which h5py, xarray, R, MATLAB and ParaView
// read. Cascade calls the library in a module, which is built if libhdf5-dev is installed and
// loaded when the first file is checked or written.
#pragma once

#include "core/precision.h"
#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace cascade {

using Hdf5Attribute = std::variant<double, std::int64_t, std::string, std::vector<std::int32_t>>;
/// Attributes by name. A value that is a text must be shorter than 64 kB.
using Hdf5Attributes = std::map<std::string, Hdf5Attribute>;

/// Numbers along one of the axes of the cells.
struct Hdf5Column {
    std::string name;
    std::string long_name;
    std::vector<double> values;
    std::string unit;  ///< The attribute `units`, which is left out if this is empty.
};

/// A value of an entry, such as its time.
using Hdf5Value = std::variant<double, std::int64_t, std::int32_t, std::string>;

/// Values along the axis of the entries, one for each entry.
struct Hdf5Record {
    std::string name;
    Hdf5Attributes attributes;
    Hdf5Value largest;  ///< Gives the type. A text gives the largest number of bytes.
};

/// The content of a file besides its entries. An entry is a moment of a run, or a run.
struct Hdf5Layout {
    /// The first record is the axis of the entries, and is as long as there are complete entries.
    std::vector<Hdf5Record> records;
    /// The axes of the cells, the slowest first, with the positions of the cells. Each name is
    /// also the name of a dimension scale.
    std::vector<Hdf5Column> axes;
    /// Further numbers along the last axis, such as the positions of a model's cells.
    std::vector<Hdf5Column> coordinates;
    /// The names of the fields' datasets, each with its attributes.
    std::vector<std::pair<std::string, Hdf5Attributes>> fields;
    Precision precision = Precision::single;
    /// The names of the stages, by number, with the attributes of their groups. If there are none,
    /// the file has no groups.
    std::vector<std::pair<std::string, Hdf5Attributes>> stages;
    Hdf5Attributes about;  ///< The attributes of the file.
    /// Datasets that hold one text each. Texts may have any length.
    std::map<std::string, std::string> texts;
};

/// An open file. After each call it can be read, even if the process is killed. If a call fails,
/// the file keeps the entries that it has.
class Hdf5File {
public:
    Hdf5File() = default;
    Hdf5File(const Hdf5File&) = delete;
    Hdf5File& operator=(const Hdf5File&) = delete;
    virtual ~Hdf5File() = default;

    /// Adds an entry with a value for each record. `fields` has the bytes of each field, in the
    /// layout's precision. A field without bytes is NaN in this entry. If this fails, nothing more
    /// can be added.
    virtual Result<void> add(const std::vector<Hdf5Value>& values,
                             const std::vector<std::string>& fields) = 0;
    /// Adds numbers to the attributes of a stage's group, /stages/NAME.
    virtual Result<void> describe(std::size_t stage,
                                  const std::map<std::string, double>& numbers) = 0;
    /// Writes the remaining data and closes the file. Must be the last call.
    virtual Result<void> close() = 0;
};

/// The name of the module's only symbol. The symbol is a function that takes the version of its
/// caller. It returns the function that makes files, or null if the module has another version.
inline constexpr const char* hdf5_opener_symbol = "cascade_hdf5_opener";
using Hdf5Opener = Result<std::unique_ptr<Hdf5File>>(const std::filesystem::path& path,
                                                     const Hdf5Layout& layout);
using Hdf5OpenerEntry = Hdf5Opener*(std::string_view version);

/// Loads the module. Fails if this build has no module or if the HDF5 library is missing. The error
/// message is about the output file `path`, and says what to install.
Result<void> check_hdf5(const std::filesystem::path& path);

/// Begins a file without entries, replacing a file of this name. Fails like check_hdf5(), and if
/// the file cannot be written. Errors name the file `shown`.
Result<std::unique_ptr<Hdf5File>> begin_hdf5(const std::filesystem::path& path,
                                             const Hdf5Layout& layout,
                                             const std::filesystem::path& shown);

/// Whether a field of a series may have this name beside the datasets that every series has.
bool is_hdf5_name(std::string_view name);

}  // namespace cascade
