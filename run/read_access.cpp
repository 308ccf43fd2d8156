#include "run/read_access.h"

#include <fmt/format.h>

#include <algorithm>

namespace cascade {

namespace {

/// Links followed as far as the path exists; empty where that cannot be told.
std::filesystem::path real_path(const std::filesystem::path& path) {
    std::error_code error;
    auto real = std::filesystem::weakly_canonical(std::filesystem::absolute(path, error), error);
    return error ? std::filesystem::path() : real;
}

bool is_below(const std::filesystem::path& file, const std::filesystem::path& folder) {
    const std::filesystem::path real = real_path(folder);
    if (file.empty() || real.empty()) return false;
    const auto [end, rest] = std::mismatch(real.begin(), real.end(), file.begin(), file.end());
    // A folder written with a slash behind it ends in an empty name.
    return end == real.end() || (end->empty() && std::next(end) == real.end());
}

}  // namespace

Result<std::filesystem::path> readable_path(const std::filesystem::path& folder,
                                            const std::string& name, const ReadAccess& access) {
    if (name.empty()) return failure("a file has a name");
    if (name.find('\0') != std::string::npos) return failure("the name of a file has no NUL byte");
    std::filesystem::path path = (folder / name).lexically_normal();
    // Nothing would end the wait for a pipe that nobody writes to.
    std::error_code error;
    if (std::filesystem::is_other(path, error)) {
        return failure(fmt::format("'{}' is a pipe or a device and no file", name));
    }
    if (access.everything) return path;
    const std::filesystem::path file = real_path(path);
    const bool is_granted =
        is_below(file, folder) ||
        std::any_of(access.folders.begin(), access.folders.end(),
                    [&](const std::filesystem::path& each) { return is_below(file, each); });
    if (is_granted) return path;
    return failure(fmt::format("'{}' lies outside of the script's folder", name),
                   "--allow-read FOLDER lets a script read there");
}

}  // namespace cascade
