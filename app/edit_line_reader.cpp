// Reads lines with libedit. No other file includes libedit's header.
#include "app/history_file.h"
#include "app/line_reader.h"
#include "app/prompt_text.h"

#include <histedit.h>

#include <cstdio>
#include <cstdlib>
#include <termios.h>
#include <unistd.h>

namespace cascade {

namespace {

/// As long as this object exists, Ctrl-C is an ordinary character of the terminal. libedit changes
/// the terminal in the same way, but only some time after it has drawn its prompt.
class InterruptKeyIsText {
public:
    InterruptKeyIsText() { set(false); }
    ~InterruptKeyIsText() { set(true); }
    InterruptKeyIsText(const InterruptKeyIsText&) = delete;
    InterruptKeyIsText& operator=(const InterruptKeyIsText&) = delete;

private:
    static void set(bool signals) {
        termios settings = {};
        if (tcgetattr(STDIN_FILENO, &settings) != 0) return;
        settings.c_lflag = signals ? settings.c_lflag | ISIG : settings.c_lflag & ~tcflag_t{ISIG};
        tcsetattr(STDIN_FILENO, TCSANOW, &settings);
    }
};

class EditReader : public LineReader {
public:
    EditReader(const std::filesystem::path& history_file, NamesToComplete names)
        : names_(std::move(names)),
          history_file_(history_file),
          history_(history_init()),
          edit_(el_init("cascade", stdin, stdout, stderr)) {
        HistEvent event;
        history(history_.get(), &event, H_SETSIZE, static_cast<int>(HistoryFile::most_lines));
        history(history_.get(), &event, H_SETUNIQUE, 1);
        for (const std::string& line : history_file_.load()) {
            history(history_.get(), &event, H_ENTER, line.c_str());
        }
        EditLine* const edit = edit_.get();
        el_set(edit, EL_CLIENTDATA, this);
        el_set(edit, EL_PROMPT, &EditReader::prompt);
        el_set(edit, EL_EDITOR, "emacs");
        el_set(edit, EL_HIST, ::history, history_.get());
        el_set(edit, EL_ADDFN, "cascade-complete", "Complete the word", &EditReader::complete);
        el_set(edit, EL_BIND, "^I", "cascade-complete", nullptr);
        // Makes Ctrl-C discard the line that is being edited, instead of ending the program.
        el_set(edit, EL_SETTY, "-d", "-isig", nullptr);
        el_set(edit, EL_ADDFN, "cascade-drop", "Drop the line", &EditReader::drop);
        el_set(edit, EL_BIND, "^C", "cascade-drop", nullptr);
        el_set(edit, EL_BIND, "^R", "em-inc-search-prev", nullptr);
        el_source(edit, nullptr);  // The user's ~/.editrc may override these settings.
    }

    TypedLine read(const std::string& prompt) override {
        prompt_ = prompt;
        dropped_ = false;
        int count = 0;
        const InterruptKeyIsText key;
        const char* const text = el_gets(edit_.get(), &count);
        if (dropped_) return {TypedLine::Kind::cancelled, ""};
        if (!text || count <= 0) return {};
        TypedLine line{TypedLine::Kind::line, std::string(text, static_cast<std::size_t>(count))};
        while (line.text.ends_with('\n') || line.text.ends_with('\r')) line.text.pop_back();
        if (line.text.find_first_not_of(" \t") != std::string::npos) {
            HistEvent event;
            history(history_.get(), &event, H_ENTER, line.text.c_str());
            history_file_.add(line.text);
        }
        return line;
    }

private:
    struct EndEdit {
        void operator()(EditLine* edit) const { el_end(edit); }
    };
    struct EndHistory {
        void operator()(History* history) const { history_end(history); }
    };

    static EditReader& of(EditLine* edit) {
        void* self = nullptr;
        el_get(edit, EL_CLIENTDATA, &self);
        return *static_cast<EditReader*>(self);
    }

    static char* prompt(EditLine* edit) { return of(edit).prompt_.data(); }

    static unsigned char drop(EditLine* edit, int) {
        of(edit).dropped_ = true;
        std::fputs("^C\n", stdout);
        return CC_NEWLINE;
    }

    static unsigned char complete(EditLine* edit, int) {
        const LineInfo* const line = el_line(edit);
        const std::string typed(line->buffer, line->cursor);
        const Completion completion = complete_word(typed, of(edit).names_(typed));
        if (!completion.insert.empty()) {
            if (el_insertstr(edit, completion.insert.c_str()) == -1) return CC_ERROR;
            return CC_REFRESH;
        }
        if (completion.choices.empty()) return CC_REFRESH_BEEP;
        std::fputc('\n', stdout);
        for (const std::string& choice : completion.choices) std::printf("%s  ", choice.c_str());
        std::fputc('\n', stdout);
        return CC_REDISPLAY;
    }

    NamesToComplete names_;
    HistoryFile history_file_;
    std::string prompt_;
    bool dropped_ = false;
    std::unique_ptr<History, EndHistory> history_;
    std::unique_ptr<EditLine, EndEdit> edit_;
};

}  // namespace

std::unique_ptr<LineReader> make_edit_reader(const std::filesystem::path& history,
                                             NamesToComplete names) {
    return std::make_unique<EditReader>(history, std::move(names));
}

std::filesystem::path history_path() {
    const char* const state = std::getenv("XDG_STATE_HOME");
    // The XDG base directory specification says that relative paths are ignored.
    if (state && *state == '/') return std::filesystem::path(state) / "cascade/history";
    const char* const home = std::getenv("HOME");
    if (!home || !*home) return {};
    return std::filesystem::path(home) / ".local/state/cascade/history";
}

}  // namespace cascade
