// Models that users load into a page. They arrive in parts and are stored in a folder of the
// session.
#pragma once

#include "core/result.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace cascade {

/// A part of a file that is being sent: the bytes from position `at` on. The whole file has `size`
/// bytes.
struct LoadPart {
    std::string name;  ///< The name of the file on the user's machine.
    std::uint64_t at = 0;
    std::uint64_t size = 0;
    std::string bytes;
};

/// The largest number of bytes of one model, and of all models of a session together.
struct LoadLimits {
    std::uint64_t model = std::uint64_t{64} << 20;
    std::uint64_t session = std::uint64_t{256} << 20;
};

/// Only one thread may use this object.
class LoadedModels {
public:
    /// Stores models in `folder`, which scripts must be permitted to read. Each model gets a file
    /// name that is used neither there nor in `script_folder`, which scripts search first. If
    /// `folder` is empty, no model is accepted.
    LoadedModels(std::filesystem::path folder, std::filesystem::path script_folder,
                 const LoadLimits& limits = {});

    /// Adds the next part of a file. A part that has already arrived is ignored. If this was the
    /// last part, returns the name by which scripts find the model, and otherwise an empty name. If
    /// the file is too large or is not a readable model, fails and discards the file. Only one file
    /// can arrive at a time: the first part of a file discards an incomplete earlier file.
    Result<std::string> add(const LoadPart& part);

private:
    Result<std::string> keep(const std::string& name, const std::string& bytes);
    Result<std::string> free_name(const std::string& wanted, const std::string& bytes) const;

    std::filesystem::path folder_, script_folder_;
    LoadLimits limits_;
    std::string name_;  ///< The name, the size and the bytes so far of the file that is arriving.
    std::uint64_t size_ = 0;
    std::string bytes_;
    /// The name by which scripts find the model; empty until the file is complete.
    std::string kept_as_;
    std::uint64_t kept_ = 0;  ///< The number of bytes of all stored models.
};

}  // namespace cascade
