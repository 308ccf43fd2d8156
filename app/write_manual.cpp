// The program cascade_manual writes the manual pages and completions of `cascade` into a folder.
// The build runs it (package/manual.cmake).

#include "app/manual.h"
#include "core/file.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <utility>
#include <vector>

int main(int argc, char** argv) {
    if (argc != 2) {
        fmt::print(stderr, "usage: cascade_manual FOLDER\n");
        return 64;
    }
    const std::filesystem::path folder = argv[1];
    const cascade::Manual manual = cascade::read_manual();
    std::vector<std::pair<std::filesystem::path, std::string>> files = {
        {"man1/cascade.1", cascade::man_page(manual)},
        {"bash/cascade", cascade::bash_completions(manual)},
        {"zsh/_cascade", cascade::zsh_completions(manual)},
        {"fish/cascade.fish", cascade::fish_completions(manual)},
    };
    for (const cascade::ManualCommand& command : manual.commands) {
        files.emplace_back(fmt::format("man1/cascade-{}.1", command.name),
                           cascade::man_page(command));
    }
    for (const auto& [name, text] : files) {
        const auto path = folder / name;
        auto done = cascade::make_folder(path.parent_path());
        if (done) done = cascade::write_file(path, text);
        if (!done) {
            fmt::print(stderr, "cascade_manual: {}\n", done.error().message);
            return 1;
        }
    }
    return 0;
}
