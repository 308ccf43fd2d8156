// A session at the prompt: a script that grows line by line, and its run.
#pragma once

#include "app/console.h"
#include "run/script/script.h"
#include "run/simulation/simulation.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cascade {

/// Takes the lines of a LineReader. A line with an error changes neither the script nor the fields.
/// Otherwise it is kept, and so are the computed values of all stages that it does not change.
class PromptSession {
public:
    /// `show_after_run`: a picture after each :run, for terminals.
    PromptSession(const SimulationOptions& options, Console& console, bool show_after_run);
    ~PromptSession();

    /// Handles one line. False when the user leaves.
    bool take(const std::string& line);
    /// Drops an unfinished block (Ctrl-C).
    void drop_pending() { pending_.clear(); }
    /// End of input: checks an unfinished block as it is.
    void end();

    /// The prompt for the next line: its number in the script.
    std::string prompt() const;
    /// Names that can follow at the end of `line`, for completion.
    std::vector<std::string> names(const std::string& line) const;
    /// True once a line had an error or a run failed.
    bool has_failed() const { return has_failed_; }
    /// Loads a script, a picture or a saved folder, as :load does.
    void load(const std::string& path);

private:
    struct Command;
    static std::span<const Command> commands();

    // The script (prompt_session.cpp).
    bool obey(std::string_view line);
    void add_text(const std::string& text);
    bool change(Script script);
    void load_saved(const std::string& folder);
    void set(const std::string& assignment);
    void print_text(const std::string&);
    void forget(const std::string&);
    void help(const std::string&);

    // Its run (prompt_run.cpp).
    Result<std::unique_ptr<Simulation>> carry_over(Script& script) const;
    bool has_something_to_run();
    bool make_simulation();
    void init(const std::string&);
    void run(const std::string& count);
    bool advance(std::int64_t steps);
    void show(const std::string& expression);
    void list_stages(const std::string&);
    void save(const std::string& folder);
    void tell_place();
    /// True if all stages have taken all their steps.
    bool is_over() const;
    void tell_over();
    void remark(const std::string& words);

    // Errors (prompt_session.cpp).
    void fail(const Failure& failure);
    void print_errors(const Script& script);

    SimulationOptions options_;
    Console& console_;
    bool show_after_run_;
    std::string pending_;  ///< The first lines of an unfinished block.
    std::string last_warnings_;
    bool has_failed_ = false;
    std::unique_ptr<Script> script_;          ///< Without errors; null until something was typed.
    std::unique_ptr<Simulation> simulation_;  ///< Refers to *script_.
};

}  // namespace cascade
