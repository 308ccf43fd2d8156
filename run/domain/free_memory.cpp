// Reads /proc/meminfo, and the limits of all control groups (version 1 and 2) from this process's
// group up to the top. Cached pages of files count as free, because the system can release them.
#include "run/domain/free_memory.h"

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>

namespace cascade {

namespace {

namespace fs = std::filesystem;

/// The names of files in one version of control groups.
struct GroupFiles {
    std::string_view limit, used, file_bytes_1, file_bytes_2;
};
constexpr GroupFiles version_2{"memory.max", "memory.current", "inactive_file", "active_file"};
constexpr GroupFiles version_1{"memory.limit_in_bytes", "memory.usage_in_bytes",
                               "total_inactive_file", "total_active_file"};

/// Returns the number in a file. Returns an empty optional if the file contains anything else, such
/// as "max".
std::optional<std::uint64_t> number_in(const fs::path& path) {
    std::ifstream file(path);
    std::uint64_t number = 0;
    if (file >> number) return number;
    return std::nullopt;
}

/// Returns the number after a key in a file with lines "KEY NUMBER …", or 0 if the key is missing.
std::uint64_t number_of(const fs::path& path, std::string_view key) {
    std::ifstream file(path);
    std::string word, rest;
    std::uint64_t number = 0;
    while (file >> word >> number) {
        if (word == key) return number;
        std::getline(file, rest);
    }
    return 0;
}

/// Returns the free bytes below the limit of one group. Returns an empty optional if the group has
/// no limit.
std::optional<std::uint64_t> left_in(const fs::path& group, const GroupFiles& names) {
    const auto limit = number_in(group / names.limit);
    const auto used = number_in(group / names.used);
    if (!limit || !used) return std::nullopt;
    const fs::path statistics = group / "memory.stat";
    const std::uint64_t files =
        number_of(statistics, names.file_bytes_1) + number_of(statistics, names.file_bytes_2);
    const std::uint64_t held = *used - std::min(*used, files);
    return *limit - std::min(*limit, held);
}

/// Returns the smallest number of free bytes among a group and the groups above it, up to and
/// including `top`.
std::optional<std::uint64_t> left_up_to(const fs::path& top, const std::string& group,
                                        const GroupFiles& names) {
    std::optional<std::uint64_t> least;
    // In a container, `group` is often the path outside of the container. Of this path, only the
    // last group is then visible, as `top`.
    fs::path path = fs::path(group).lexically_normal().relative_path();
    while (true) {
        if (const auto left = left_in(top / path, names))
            least = std::min(least.value_or(*left), *left);
        if (path.empty()) return least;
        path = path.parent_path();
    }
}

}  // namespace

std::uint64_t available_memory(const fs::path& root) {
    std::uint64_t available = number_of(root / "proc/meminfo", "MemAvailable:") * 1024;
    const auto at_most = [&](const std::optional<std::uint64_t>& bytes) {
        // A group without free memory counts as 1 byte, because 0 means that the amount is unknown.
        if (bytes)
            available =
                std::max<std::uint64_t>(1, available > 0 ? std::min(available, *bytes) : *bytes);
    };
    const fs::path groups = root / "sys/fs/cgroup";
    // Examples of lines are "0::/user.slice" (version 2) and "5:cpu,memory:/docker/7a" (version 1).
    std::ifstream file(root / "proc/self/cgroup");
    for (std::string line; std::getline(file, line);) {
        const std::size_t first = line.find(':');
        const std::size_t second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const std::string group = line.substr(second + 1);
        if (controllers == ",,") {
            at_most(left_up_to(groups, group, version_2));
            at_most(left_up_to(groups / "unified", group, version_2));
        } else if (controllers.find(",memory,") != std::string::npos) {
            at_most(left_up_to(groups / "memory", group, version_1));
        }
    }
    return available;
}

}  // namespace cascade
