// Files in memory: the files that the page carries and the files that the session writes.
#include "tab/files.h"

#include "core/file.h"
#include "core/granted_files.h"
#include "core/kept_files.h"
#include "core/own_folder.h"
#include "core/printable.h"

#include <fmt/format.h>

#include <map>

namespace cascade {
namespace {

std::map<std::string, std::string>& files() {
    static std::map<std::string, std::string> all;
    return all;
}

const std::string* find_file(const std::filesystem::path& path) {
    const auto found = files().find(path.lexically_normal().string());
    return found == files().end() ? nullptr : &found->second;
}

}  // namespace

void carry_file(std::string name, std::string bytes) {
    files().insert_or_assign(std::filesystem::path(name).lexically_normal().string(),
                             std::move(bytes));
}

Result<std::string> read_file(const std::filesystem::path& path, std::uint64_t largest) {
    const std::string* const bytes = find_file(path);
    if (bytes == nullptr) {
        return failure(fmt::format("cannot open '{}'", path.string()),
                       "this page carries only the files that its script needed at first");
    }
    if (bytes->size() > largest) {
        return failure(fmt::format("'{}' is larger than {} bytes", path.string(), largest));
    }
    return *bytes;
}

std::optional<std::uint64_t> size_of_file(const std::filesystem::path& path) {
    const std::string* const bytes = find_file(path);
    if (bytes == nullptr) return std::nullopt;
    return bytes->size();
}

std::string first_bytes(const std::filesystem::path& path, std::size_t count) {
    const std::string* const bytes = find_file(path);
    return bytes == nullptr ? std::string() : bytes->substr(0, count);
}

Result<std::string> read_plain_file(const std::filesystem::path& path, std::uint64_t largest) {
    return read_file(path, largest);
}

Result<std::string> read_linked_file(const std::filesystem::path& path, std::uint64_t largest,
                                     std::string_view) {
    return read_file(path, largest);
}

Result<std::string> read_file_below(const std::filesystem::path& folder,
                                    const std::filesystem::path& file, std::uint64_t largest,
                                    std::string_view) {
    return read_file(folder / file, largest);
}

Result<void> write_file(const std::filesystem::path& path, std::string_view bytes) {
    carry_file(path.string(), std::string(bytes));
    return {};
}

Result<void> make_folder(const std::filesystem::path&) { return {}; }
Result<void> check_writable(const std::filesystem::path&) { return {}; }
bool may_keep_files_in(const std::filesystem::path&) { return false; }

GrantedFiles::GrantedFiles(std::filesystem::path folder, ReadAccess, std::string_view owner)
    : base_(std::move(folder)), owner_(owner) {}

GrantedFiles GrantedFiles::none() { return {}; }

GrantedFiles GrantedFiles::beside(const std::string& file) const {
    return {(base_ / file).parent_path(), {}, owner_};
}

Result<std::string> GrantedFiles::read(const std::string& name, std::uint64_t largest) const {
    if (find_file(base_ / name) == nullptr) {
        return failure(fmt::format("cannot read '{}'", short_name(name)),
                       "this page carries only the files that its script needed at first");
    }
    return read_file(base_ / name, largest);
}

std::optional<std::string> KeptFiles::find(std::string_view) const { return std::nullopt; }
void KeptFiles::keep(std::string_view, std::string_view) {}

}  // namespace cascade
