// The ways to run the kernels of steps.
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

/// What a backend is made with; one that has no use for an option ignores it.
struct BackendOptions {
    int lanes = 0;                     ///< Cells in a vector; 0 takes the host's number.
    std::filesystem::path cache = {};  ///< Where compiled kernels are kept; empty: nowhere.
};

/// A row of the table of backends.
struct BackendKind {
    std::string_view name;      ///< As --backend takes it.
    std::string_view meaning;   ///< For its help.
    bool is_native;             ///< Compiles kernels.
    bool is_available;          ///< In this build. Where it is not, `make` fails and says why.
    std::string (*describe)();  ///< With versions, for --version.
    Result<std::unique_ptr<Backend>> (*make)(const BackendOptions& options);
};

/// All of them, the fastest first. The last one is always available.
std::span<const BackendKind> backends();
/// The backend of this name, which is in the table.
const BackendKind& backend_named(std::string_view name);
bool is_available(std::string_view name);
/// The names of those that are available, in the order of the table.
std::vector<std::string> available_backends();
/// The first of them.
const BackendKind& fastest_backend();

}  // namespace cascade
