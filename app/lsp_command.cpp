// The command `cascade lsp` serves an editor on standard input and output.
#include "app/commands.h"
#include "app/exit_status.h"
#include "lsp/serve.h"
#include "lsp/words.h"

#include <unistd.h>

namespace cascade {

int lsp_command(const Options& options, Console& console) {
    if (options.prints_words) {
        console.print(lsp::language_words());
        return exit_status::success;
    }
    if (::isatty(STDIN_FILENO)) {
        console.note(
            "editors start 'cascade lsp' and speak the Language Server Protocol with it; "
            "Ctrl-D ends it");
    }
    const auto served = lsp::serve(STDIN_FILENO, STDOUT_FILENO);
    if (!served) {
        console.fail(served.error());
        return exit_status::failed_run;
    }
    return *served ? exit_status::success : exit_status::no_shutdown;
}

}  // namespace cascade
