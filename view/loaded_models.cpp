// Loaded files are checked by the same functions, with the same limits, as models that scripts
// name.
#include "view/loaded_models.h"

#include "core/file.h"
#include "core/granted_files.h"
#include "core/printable.h"
#include "mesh/model_file.h"

#include <fmt/format.h>

#include <new>
#include <string_view>
#include <utility>

namespace cascade {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_name = 80;
constexpr int most_of_a_name = 1000;

/// The last part of a path. Characters that have a meaning in scripts or paths are replaced by '_'.
fs::path plain_name(std::string_view name) {
    name.remove_prefix(name.find_last_of("/\\") + 1);  // If there is no slash, npos + 1 is 0.
    if (name.size() > longest_name) name.remove_prefix(name.size() - longest_name);
    std::string plain;
    for (const char sign : name) {
        const bool is_plain = ('a' <= sign && sign <= 'z') || ('A' <= sign && sign <= 'Z') ||
                              ('0' <= sign && sign <= '9') || sign == '-' || sign == '.';
        plain += is_plain ? sign : '_';
    }
    if (plain.starts_with('.')) plain = "model" + plain;
    return plain;
}

bool holds(const fs::path& path, const std::string& bytes) {
    if (size_of_file(path) != bytes.size()) return false;
    const auto found = read_plain_file(path, bytes.size());
    return found && *found == bytes;
}

}  // namespace

LoadedModels::LoadedModels(fs::path folder, fs::path script_folder, const LoadLimits& limits)
    : folder_(std::move(folder)), script_folder_(std::move(script_folder)), limits_(limits) {}

Result<std::string> LoadedModels::add(const LoadPart& part) {
    if (folder_.empty()) return failure("there is no folder for models on this machine");
    if (part.at == 0) {
        name_ = part.name;
        size_ = part.size;
        bytes_.clear();
        kept_as_.clear();
    }
    if (part.name != name_ || part.size != size_ || part.at > bytes_.size()) {
        if (!kept_as_.empty() && part.name == name_ && part.size == size_) return kept_as_;
        return failure(fmt::format("parts of '{}' are missing", short_name(part.name)),
                       "load the file again, one file at a time");
    }
    const bool is_large = size_ > limits_.model;
    if (is_large || kept_ + size_ > limits_.session) {
        return failure(
            is_large
                ? fmt::format("'{}' has more than {} bytes", short_name(name_), limits_.model)
                : fmt::format("the models of a session can have at most {} bytes", limits_.session),
            "save the model beside the script and name it in the script");
    }
    if (part.at < bytes_.size()) return std::string();
    bytes_ += part.bytes;
    if (bytes_.size() < size_) return std::string();
    const std::string bytes = std::exchange(bytes_, {});
    if (bytes.size() > size_) {
        return failure(fmt::format("'{}' is longer than announced", short_name(name_)));
    }
    auto kept = keep(name_, bytes);
    if (kept) kept_as_ = *kept;
    return kept;
}

Result<std::string> LoadedModels::keep(const std::string& name, const std::string& bytes) {
    const auto found = free_name(plain_name(name).string(), bytes);
    if (!found) return found;
    const fs::path path = folder_ / *found;
    if (holds(path, bytes)) return found;
    if (const auto written = write_file(path, bytes); !written) {
        return tl::unexpected(written.error());
    }
    Result<void> readable;
    try {
        const auto model = read_model(GrantedFiles(folder_, {}, "model"), *found);
        if (!model) readable = tl::unexpected(model.error());
    } catch (const std::bad_alloc&) {
        readable =
            failure(fmt::format("there is not enough memory to read '{}'", short_name(name)));
    }
    if (!readable) {
        std::error_code ignored;
        fs::remove(path, ignored);
        return tl::unexpected(readable.error());
    }
    kept_ += bytes.size();
    return found;
}

/// Returns the wanted name, with a number added if another file has this name. If a file with the
/// same bytes exists, returns that file's name.
Result<std::string> LoadedModels::free_name(const std::string& wanted,
                                            const std::string& bytes) const {
    const fs::path path(wanted);
    for (int k = 1; k < most_of_a_name; ++k) {
        const std::string name =
            k == 1 ? wanted
                   : fmt::format("{}-{}{}", path.stem().string(), k, path.extension().string());
        std::error_code ignored;
        const bool is_free =
            (!fs::exists(folder_ / name, ignored) || holds(folder_ / name, bytes)) &&
            (!fs::exists(script_folder_ / name, ignored) || holds(script_folder_ / name, bytes));
        if (is_free) return name;
    }
    return failure(fmt::format("there are too many models named '{}'", short_name(wanted)));
}

}  // namespace cascade
