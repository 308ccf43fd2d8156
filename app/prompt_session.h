// A session at the prompt. Its script grows line by line, and its run continues with each new
// script.
#pragma once

#include "app/commands.h"
#include "app/console.h"
#include "app/session_file.h"
#include "app/terminal_pictures.h"
#include "run/pictures/painter.h"
#include "run/script/script.h"
#include "run/session/live_run.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Handles the lines of a LineReader. A line with an error changes neither the script nor the
/// fields. Any other line is added to the script, and the run continues with the new script
/// (LiveRun).
class PromptSession {
public:
    /// If `at_terminal` is true, draws a picture after each command :run, and stores the session in
    /// a file until it ends.
    PromptSession(const SimulationOptions& options, Console& console, bool at_terminal,
                  const TerminalPictures& pictures);
    ~PromptSession();

    /// Handles one line. Returns false if the line ends the session.
    bool take(const std::string& line);
    /// Discards an unfinished block after Ctrl-C.
    void drop_pending() { pending_.clear(); }
    /// Prints the path of the file that stores the session, but only once.
    void tell_where_kept() const {
        if (kept_) tell_news(*kept_, console_);
    }
    /// Must be called at the end of the input. Checks an unfinished block as if it were complete.
    void end();

    /// Returns the prompt for the next line, with the line's number in the script.
    std::string prompt() const;
    /// Returns names that can complete the word at the end of `line`.
    std::vector<std::string> names(const std::string& line) const;
    /// Whether any line had an error, or any run has failed.
    bool has_failed() const { return has_failed_; }
    /// Loads a script, a picture or a saved run, like the command :load.
    void load(const std::string& path);

private:
    struct Command;
    static std::span<const Command> commands();

    // The following functions change the script (prompt_session.cpp).
    bool obey(std::string_view line);
    void add_text(const std::string& text);
    bool change(Script script);
    void load_saved(const std::string& folder);
    void load_session(const std::string& path);
    void play(const SessionLog& log, const std::filesystem::path& folder);
    void set(const std::string& assignment);
    void print_text(const std::string&);
    void forget(const std::string&);
    void help(const std::string& topic);
    void help_on(const std::string& topic);
    void obey_shell(const CommandEntry& command, std::vector<std::string> words);

    // The following functions control the run (prompt_run.cpp).
    bool has_something_to_run();
    bool begin_with(const std::function<Accepted<std::unique_ptr<LiveRun>>(RunControl&)>& make);
    bool begin_run();
    void take_over(std::unique_ptr<LiveRun> run);
    bool apply(const Change& change);
    void move(const std::function<Accepted<void>(RunControl&)>& go);
    void init(const std::string&);
    void run(const std::string& count);
    bool advance(std::int64_t steps);
    void next(const std::string&);
    void go_to(const std::string& stage);
    void paint(const std::string& assignment);
    void undo(const std::string&);
    void redo(const std::string&);
    std::optional<Painter> painter_of(const std::string& expression);
    void show(const std::string& expression);
    void print_value(const std::string& expression);
    void print_features_shown(const std::string&);
    void list_stages(const std::string&);
    void save(const std::string& path);
    void save_text(const std::string& path);
    void save_picture(const std::string& path);
    void tell_place();
    void tell_over();
    void remark(const std::string& words);

    // The following functions report errors (prompt_session.cpp).
    void fail(const Failure& failure);
    void print_errors(const Script& script);
    void print_refusal(const Refusal& refusal);

    /// Returns the script of the run or, without a run, the script typed so far. Returns null
    /// before anything was typed.
    const Script* script() const { return run_ ? &run_->script() : script_.get(); }

    SimulationOptions options_;
    Console& console_;
    bool at_terminal_;
    TerminalPictures pictures_;
    std::string pending_;  ///< The first lines of an unfinished block.
    std::string last_warnings_;
    std::string shown_;  ///< The expression of the picture that was drawn last.
    bool has_failed_ = false;
    std::unique_ptr<Script> script_;  ///< Null if there is a run. Never has errors.
    std::unique_ptr<LiveRun> run_;    ///< Null until the first command that needs a run.
    std::string stem_ = "prompt";     ///< Output files have names that begin with this text.
    /// The stored log of the run. Null if the session is not at a terminal.
    std::shared_ptr<SessionFile> kept_;
};

}  // namespace cascade
