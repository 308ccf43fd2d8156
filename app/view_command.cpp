// The command `cascade view` serves the page of a session until Ctrl-C, and opens the page in the
// browser.
#include "app/commands.h"
#include "app/exit_status.h"
#include "app/interrupt.h"
#include "app/session_file.h"
#include "lang/print/library_note.h"
#include "view/page_files.h"
#include "view/page_server.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <thread>

namespace cascade {

namespace {

/// A page that redirects to an address. It is in a file that only this user can read. If the
/// address were an argument of the browser's command, every user of the machine could see the token
/// in it.
class LeadingPage {
public:
    explicit LeadingPage(const std::string& address) {
        std::string pattern =
            (std::filesystem::temp_directory_path() / "cascade-XXXXXX.html").string();
        const int file = ::mkstemps(pattern.data(), 5);
        if (file < 0) return;
        path_ = pattern;
        const std::string text =
            fmt::format("<!doctype html><meta http-equiv=\"refresh\" content=\"0; url={}\">\n",
                        address);
        const bool is_written =
            ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
        ::close(file);
        if (!is_written) path_.clear();
    }
    ~LeadingPage() {
        if (!path_.empty()) ::unlink(path_.c_str());
    }
    LeadingPage(const LeadingPage&) = delete;
    LeadingPage& operator=(const LeadingPage&) = delete;

    const std::string& path() const { return path_; }

private:
    std::string path_;
};

/// A new folder for models that users load into the page. Only this user can read it. The
/// destructor removes it.
class FolderOfModels {
public:
    FolderOfModels() {
        std::string pattern = (std::filesystem::temp_directory_path() / "cascade-XXXXXX").string();
        if (::mkdtemp(pattern.data()) != nullptr) path_ = pattern;
    }
    ~FolderOfModels() {
        std::error_code ignored;
        if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
    }
    FolderOfModels(const FolderOfModels&) = delete;
    FolderOfModels& operator=(const FolderOfModels&) = delete;

    /// Empty if the folder could not be made.
    const std::filesystem::path& path() const { return path_; }

private:
    std::filesystem::path path_;
};

/// Whether this process has a screen on which a browser could open.
bool has_screen() { return std::getenv("DISPLAY") || std::getenv("WAYLAND_DISPLAY"); }

void open_in_browser(const std::string& path) {
    std::string program = "xdg-open", argument = path;
    std::array<char*, 3> arguments = {program.data(), argument.data(), nullptr};
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        posix_spawn_file_actions_addopen(&actions, stream, "/dev/null", O_RDWR, 0);
    }
    pid_t child = 0;
    if (::posix_spawnp(&child, "xdg-open", &actions, nullptr, arguments.data(), environ) == 0) {
        std::thread([child] { ::waitpid(child, nullptr, 0); }).detach();
    }
    posix_spawn_file_actions_destroy(&actions);
}

/// Returns the script that runs until the user chooses a system of the library in the page.
LoadedFile script_to_replace(const Overrides& overrides) {
    const std::string text = starting_script(*find_library_text("gray_scott"));
    return {load_script("new.cascade", text, ".", overrides), ""};
}

}  // namespace

int view_command(const Options& options, Console& console) {
    const bool chooses = options.scripts.empty();
    const FolderOfModels models;
    Overrides overrides = options.overrides;
    if (!models.path().empty()) overrides.reads.folders.push_back(models.path());
    auto file =
        chooses ? script_to_replace(overrides) : load(options.scripts[0], overrides, console);
    if (!file) return exit_status::wrong_script;
    Script& script = file->script;
    console.say(script.messages(console.error().colour));
    if (!script.program) return exit_status::wrong_script;

    const std::string stem = output_stem(script);
    tell_of_files_left(script.folder, stem, script.file, "view", console);

    RunControl control;
    ProgressDisplay display = make_progress_display(console, false);
    control.report = [&](const Progress& progress) { display.show(progress); };
    const InterruptGuard interrupt(control.cancel);
    const auto session = session_to_play(*file, overrides, console, false);
    if (!session) {
        console.fail(session.error());
        return exit_status::wrong_script;
    }
    auto run = *session ? LiveRun::play(**session, script.folder, options.run.simulation, control)
                        : LiveRun::begin(std::move(script), options.run.simulation, control);
    display.clear();
    if (!run) {
        console.say(run.error().messages(console.error().colour));
        return exit_status::failed_run;
    }
    const auto kept = SessionFile::of(**run, stem, "view", true);
    auto server = PageServer::start(std::move(*run), page_files(), chooses, models.path());
    if (!server) {
        console.fail(server.error());
        return exit_status::failed_run;
    }
    console.print((*server)->address() + "\n");
    console.note(
        fmt::format("only this machine can open the page; on another machine, first run 'ssh -L "
                    "{0}:127.0.0.1:{0} HOST'; Ctrl-C ends Cascade",
                    (*server)->port()));
    const LeadingPage page((*server)->address());
    if (!options.no_browser && has_screen() && !page.path().empty()) open_in_browser(page.path());
    while (!control.cancel) {
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
        tell_news(*kept, console);
    }
    if (interrupt.signal() != SIGINT) kept->leave();
    return exit_status::success;
}

}  // namespace cascade
