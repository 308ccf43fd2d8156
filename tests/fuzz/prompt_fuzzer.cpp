// A fuzzer of the prompt: lines are typed into a session, and the last one is completed. Lines that
// would read or write files or take steps are left out. All other lines have the same effect as in
// a terminal.
#include "app/prompt_session.h"
#include "app/prompt_text.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <sstream>

namespace cascade {

namespace {

bool touches_nothing(std::string_view line) {
    line = trim(line);
    for (const char* command : {":load", ":save", ":run", ":init", ":show"}) {
        if (line.starts_with(command)) return false;
    }
    return line.find("mesh") == std::string_view::npos &&
           line.find("use") == std::string_view::npos;
}

void type(const std::string& text) {
    static const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    Console console({nowhere, false, false}, {nowhere, false, true});
    SimulationOptions options;
    options.backend = "interp";
    options.threads = 1;
    options.memory_limit = std::uint64_t{16} << 20;
    PromptSession session(options, console, false, TerminalPictures());
    std::istringstream lines(text);
    std::string last;
    for (std::string line; std::getline(lines, line);) {
        if (!touches_nothing(line)) continue;
        session.prompt();
        last = line;
        if (!session.take(line)) break;
    }
    session.end();
    complete_word(last, session.names(last));
}

}  // namespace

}  // namespace cascade

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    cascade::type(std::string(reinterpret_cast<const char*>(data), size));
    return 0;
}
