// Links are resolved before a path is compared with the granted folders. core/open_below then opens
// the file below its folder, so a name that changes meanwhile cannot lead outside the folder.
#include "core/granted_files.h"

#include "core/file.h"
#include "core/file_failure.h"
#include "core/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace cascade {

namespace {

namespace fs = std::filesystem;

/// The path with the symbolic links in its existing part resolved.
fs::path real_path(const fs::path& path, std::error_code& error) {
    const fs::path absolute = fs::absolute(path, error);
    return error ? fs::path() : fs::weakly_canonical(absolute, error);
}

/// The path from `folder` to `file`, both resolved, if `file` is below `folder`.
std::optional<fs::path> way_down(const fs::path& folder, const fs::path& file) {
    auto [end, rest] = std::mismatch(folder.begin(), folder.end(), file.begin(), file.end());
    // A folder written with a trailing slash ends in an empty name.
    if (end != folder.end() && end->empty()) ++end;
    if (end != folder.end() || rest == file.end()) return std::nullopt;
    fs::path way;
    for (; rest != file.end(); ++rest) way /= *rest;
    return way;
}

/// Whether a relative name stays inside its folder if symbolic links are ignored.
bool stays_inside(const std::string& name) {
    const fs::path path = fs::path(name).lexically_normal();
    return path.is_relative() && *path.begin() != "..";
}

}  // namespace

GrantedFiles::GrantedFiles(fs::path folder, ReadAccess access, std::string_view owner)
    : base_(folder.empty() ? fs::path(".") : std::move(folder)),
      roots_{base_},
      everything_(access.everything),
      owner_(owner) {
    roots_.insert(roots_.end(), access.folders.begin(), access.folders.end());
}

GrantedFiles GrantedFiles::none() {
    GrantedFiles files;
    files.owner_ = "model";
    return files;
}

GrantedFiles GrantedFiles::beside(const std::string& file) const {
    GrantedFiles files = *this;
    files.base_ = (base_ / file).parent_path();
    return files;
}

Result<std::string> GrantedFiles::read_at(const fs::path& path, const std::string& name,
                                          std::uint64_t largest, bool& is_missing) const {
    std::error_code error;
    if (everything_) {
        is_missing = !fs::exists(path, error);
        return read_linked_file(path, largest, name);
    }
    const fs::path file = real_path(path, error);
    if (error && (error == std::errc::filename_too_long || stays_inside(name))) {
        return cannot("read", name, error.value());
    }
    for (const fs::path& root : roots_) {
        const fs::path folder = real_path(root, error);
        const auto way = error || file.empty() ? std::nullopt : way_down(folder, file);
        if (!way) continue;
        is_missing = !fs::exists(file, error);
        return read_file_below(folder, *way, largest, name);
    }
    return failure(fmt::format("'{}' lies outside of the {}'s folder", short_name(name), owner_),
                   "use --allow-read FOLDER to allow files of that folder");
}

Result<std::string> GrantedFiles::read(const std::string& name, std::uint64_t largest) const {
    if (name.empty()) return failure("a file has a name");
    if (name.find('\0') != std::string::npos) return failure("the name of a file has no NUL byte");
    bool is_missing = false;
    auto bytes = read_at(base_ / name, name, largest, is_missing);
    const fs::path path(name);
    if (bytes || !is_missing || path.is_absolute()) return bytes;
    for (std::size_t k = 1; k < roots_.size(); ++k) {
        for (const fs::path& part : {path, path.filename()}) {
            is_missing = false;
            auto found = read_at(roots_[k] / part, name, largest, is_missing);
            if (found) return found;
        }
    }
    return bytes;
}

}  // namespace cascade
