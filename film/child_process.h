// Another program that reads what this one writes.
#pragma once

#include "core/descriptor.h"
#include "core/result.h"

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <vector>

namespace cascade {

/// True for a file that may be started.
bool is_program(const std::filesystem::path& path);

/// Started without a shell, in a process group of its own: signals of the terminal do not reach it.
/// What it prints is dropped but for its errors. Its destructor ends it.
class ChildProcess {
public:
    struct End {
        bool is_good = false;    ///< It ended by itself, with status 0.
        std::string last_words;  ///< Its last line of errors; else how it ended.
    };

    static Result<std::unique_ptr<ChildProcess>> start(const std::filesystem::path& program,
                                                       const std::vector<std::string>& arguments);
    ~ChildProcess();
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    /// Writes to its standard input; false if it no longer reads.
    bool write(std::string_view bytes);
    /// Closes its input and waits for its end.
    End end();

private:
    struct CloseFile {
        void operator()(std::FILE* file) const { std::fclose(file); }
    };

    ChildProcess() = default;

    pid_t process_ = -1;
    std::optional<Descriptor> input_;
    std::unique_ptr<std::FILE, CloseFile> errors_;
};

}  // namespace cascade
