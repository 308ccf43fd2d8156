// The table of backends: the interpreter and the compilers that can run the kernels of steps.
#pragma once

#include "core/result.h"
#include "ir/backend.h"

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// The options for making a backend. A backend ignores the options that it cannot use.
struct BackendOptions {
    /// The number of cells in a vector. 0: the largest number that suits this machine.
    int lanes = 0;
    /// The folder in which compiled kernels are stored. If empty, kernels are not stored.
    std::filesystem::path cache = {};
};

/// A row of the table of backends.
struct BackendKind {
    std::string_view name;     ///< The value of --backend that selects this row.
    std::string_view meaning;  ///< A description for the help of --backend.
    bool is_native;            ///< Whether the backend compiles kernels.
    /// Whether the backend is part of this build. If not, `make` fails with the reason.
    bool is_available;
    std::string (*describe)();  ///< Returns the name and versions, for --version.
    Result<std::unique_ptr<Backend>> (*make)(const BackendOptions& options);
};

/// Returns all rows of the table, the fastest backend first. The last backend is available in every
/// build.
std::span<const BackendKind> backends();
/// Returns the row with this name, which must be in the table.
const BackendKind& backend_named(std::string_view name);
bool is_available(std::string_view name);
/// Returns the names of the available backends, in the order of the table.
std::vector<std::string> available_backends();
/// Returns the first available backend of the table.
const BackendKind& fastest_backend();

}  // namespace cascade
