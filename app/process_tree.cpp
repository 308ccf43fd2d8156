// Reads from /proc which processes descend from a process.
#include "app/process_tree.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

namespace cascade {
namespace {

std::vector<pid_t> children_of(pid_t process) {
    std::vector<pid_t> children;
    std::error_code gone;
    const std::string tasks = fmt::format("/proc/{}/task", process);
    for (auto task = std::filesystem::directory_iterator(tasks, gone);
         !gone && task != std::filesystem::directory_iterator(); task.increment(gone)) {
        std::ifstream list(task->path() / "children");
        for (pid_t child = 0; list >> child;) children.push_back(child);
    }
    return children;
}

/// Whether a process has ended, and its parent has not yet waited for it.
bool has_ended(pid_t process) {
    std::ifstream file(fmt::format("/proc/{}/stat", process));
    std::string text;
    std::getline(file, text);
    // The name of the process, which may contain brackets, is followed by the letter of its state.
    const std::size_t name_end = text.rfind(") ");
    return name_end != std::string::npos && text[name_end + 2] == 'Z';
}

}  // namespace

bool only_ended_below(pid_t process) {
    const std::vector<pid_t> children = children_of(process);
    for (const pid_t child : children) {
        if (!has_ended(child) && !only_ended_below(child)) return false;
    }
    return !children.empty();
}

}  // namespace cascade
