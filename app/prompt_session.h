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

/// Takes lines, as from a LineReader. A line that is wrong changes nothing: neither the script nor
/// the fields. One that is right is kept; what has been computed is kept too, as far as the stages
/// are the same.
class PromptSession {
public:
    /// `show_after_run`: a picture after each :run, for terminals.
    PromptSession(const SimulationOptions& options, Console& console, bool show_after_run);
    ~PromptSession();

    /// Handles one line. False when the user wants to leave.
    bool take(const std::string& line);
    /// Ctrl-C: drops a block that has been begun.
    void drop_pending() { pending_.clear(); }
    /// No more lines come: what is pending is checked as it is.
    void end();

    /// What to write before the next line: its number in the script.
    std::string prompt() const;
    /// Names with which a line can go on, for completion.
    std::vector<std::string> names(const std::string& line) const;
    /// Has a line been wrong, or a run failed?
    bool has_failed() const { return has_failed_; }
    /// As :load does.
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
    /// Are all steps of all stages taken?
    bool is_over() const;
    void tell_over();
    void remark(const std::string& words);

    // What is wrong (prompt_session.cpp).
    void fail(const Failure& failure);
    void tell_faults(const Script& script);

    SimulationOptions options_;
    Console& console_;
    bool show_after_run_;
    std::string pending_;  ///< The first lines of a block, not yet complete.
    std::string last_warnings_;
    bool has_failed_ = false;
    std::unique_ptr<Script> script_;          ///< Always right; null until something was typed.
    std::unique_ptr<Simulation> simulation_;  ///< Refers to *script_.
};

}  // namespace cascade
