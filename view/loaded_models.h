// Models that users load on a page. They arrive in parts and are kept in a folder of the session.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace cascade {

/// A part of a file: its bytes from `at` on, of `size` in all.
struct LoadPart {
    std::string name;  ///< As the user's machine calls the file.
    std::uint64_t at = 0;
    std::uint64_t size = 0;
    std::string bytes;
};

/// In bytes: of one model, and of all models of a session.
struct LoadLimits {
    std::uint64_t model = std::uint64_t{64} << 20;
    std::uint64_t session = std::uint64_t{256} << 20;
};

/// Not thread-safe.
class LoadedModels {
public:
    /// Keeps models in `folder`, to which scripts must have access. Their names differ from those
    /// of other files there and in `script_folder`, where scripts search first. An empty `folder`
    /// takes none.
    LoadedModels(std::filesystem::path folder, std::filesystem::path script_folder,
                 const LoadLimits& limits = {});

    /// Takes the next part of a file; parts that it has are ignored. After the last one it returns
    /// the name by which scripts find the model, before that an empty one. Fails, and keeps nothing
    /// of the file, if it is too large or no readable model. Files are taken one after the other: a
    /// first part ends the file before.
    Result<std::string> add(const LoadPart& part);

private:
    Result<std::string> keep(const std::string& name, const std::string& bytes);
    Result<std::string> free_name(const std::string& wanted, const std::string& bytes) const;

    std::filesystem::path folder_, script_folder_;
    LoadLimits limits_;
    std::string name_;  ///< Of the file that arrives, and its size and bytes so far.
    std::uint64_t size_ = 0;
    std::string bytes_;
    std::string kept_as_;     ///< The script's name for it, when all of it has arrived.
    std::uint64_t kept_ = 0;  ///< Bytes of all models.
};

}  // namespace cascade
