// Cascade as a library: a script becomes a running pattern inside your own program.
//
//     cascade::Pattern pattern("system_name: turing_spots\niterations: 6000\nka: 1/80\n");
//     if (!pattern.ok()) { std::cerr << pattern.messages(); return 2; }
//     while (!pattern.finished()) pattern.step(100);
//     std::vector<float> b = pattern.values("b");      // height() rows of width() numbers
//
// Link with the CMake target Cascade::cascade. No function throws or prints. One thread at a time
// may use a Pattern, but any thread or signal handler may call cancel().
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#if defined(__GNUC__)
#define CASCADE_API __attribute__((visibility("default")))
#else
#define CASCADE_API
#endif

namespace cascade {

/// One fault of a script. Lines and columns count from 1.
struct Message {
    bool is_error = true;
    std::string file;
    int line = 0;
    int column = 0;
    std::string text;
    std::string hint;  ///< What to write instead; may be empty.
};

/// How a pattern is computed. Does not affect results.
struct PatternOptions {
    bool native_code = true;        ///< Compile the equations; false interprets them.
    int threads = 0;                ///< 0 for all that the machine has.
    std::string name = "<script>";  ///< The script's name in messages.
    std::string folder = ".";       ///< Paths in the script are relative to it.
};

/// A checked script and the state of its run.
class CASCADE_API Pattern {
public:
    /// Parses and checks a script and computes the starting values of its first stage.
    explicit Pattern(const std::string& script, const PatternOptions& options = {});
    ~Pattern();
    Pattern(Pattern&&) noexcept;
    Pattern& operator=(Pattern&&) noexcept;

    /// False if the script is wrong or the run has failed: see diagnostics(), messages(), error().
    bool ok() const;
    /// Faults and warnings of the script, in order of source location.
    std::vector<Message> diagnostics() const;
    /// The same as text, drawn as the command line draws them.
    std::string messages() const;
    /// Why a run failed (non-finite values, no memory); empty if it has not.
    std::string error() const;

    /// Columns of the grid; 0 if the script is wrong. The cells of a model form one row.
    std::int64_t width() const;
    std::int64_t height() const;  ///< Rows.
    std::int64_t depth() const;   ///< Slices; 1 for a plane.

    /// Names of the stages, in order.
    std::vector<std::string> stages() const;
    /// Names of the species of a stage; empty for an unknown stage.
    std::vector<std::string> species(const std::string& stage) const;

    /// Takes up to `count` steps, and continues with the next stage when one ends. Returns how many
    /// were taken: fewer at the end of the last stage, after cancel(), or on failure. A non-finite
    /// value is found within 64 steps, at the end of a stage or by values(). The pattern has then
    /// failed, and returns to the last step at which all values were finite.
    std::int64_t step(std::int64_t count);
    /// True when every stage has taken all its steps.
    bool finished() const;
    /// Name of the stage that steps are taken in now (the last one when finished).
    std::string current_stage() const;
    /// Complete steps of that stage.
    std::int64_t steps() const;

    // A pattern can be changed between two steps (spec/session.md). Each change returns false if it
    // is refused. Then error() says why, nothing has changed, and the pattern stays ok.

    /// Gives a parameter or setting another value, as `--set NAME=EXPRESSION` does: "ka", "1/80".
    bool set(const std::string& name, const std::string& expression);
    /// Continues with another script. Items of the same name keep their values. With other cells
    /// (grid, mask, model, seed, precision) the run begins anew.
    bool set_script(const std::string& script);
    /// Gives a species, or a varying parameter or `frozen`, the values of an expression over the
    /// present state of the current stage: "b", "if(disc(0.5, 0.5, 0.1) > 0, 8, b)".
    bool paint(const std::string& item, const std::string& expression);
    /// Ends the current stage at its present step and begins the next one.
    bool begin_next_stage();
    /// Returns to the moment before the last change, to the bit, and forward again.
    bool undo();
    bool redo();
    /// The log of all steps and changes, as text. play() grows the same pattern from it to the bit.
    std::string session() const;
    /// Replays a session to its end: the text of session(), or the bytes of a picture. Its script's
    /// paths are relative to `options.folder`.
    static Pattern play(const std::string& session, const PatternOptions& options = {});

    /// The values of an expression over the present state, row by row, slice after slice: a species
    /// or parameter of the current stage ("b"), of an earlier one ("stage1.b"), or arithmetic ("b -
    /// stage1.b"). Cells outside the domain's mask are NaN, unless the expression is the same in
    /// all cells. A stage of crawling cells has one value for each, in the order of their numbers
    /// (spec/cells.md). Empty if the expression is wrong; then error() says why, and the pattern
    /// stays ok. Also empty if a value of the state is not finite, as for step().
    std::vector<float> values(const std::string& expression);

    /// The present step as a PNG file in memory: what `cascade run` would draw, or `expression`. It
    /// carries the session, so that `cascade run FILE` draws it again. Empty if there is no
    /// picture. Then error() says why, and the pattern stays ok.
    std::string picture(const std::string& expression = "");

    /// Makes a running step() return after its present step. The next step() continues.
    void cancel();

private:
    struct Implementation;
    Pattern();
    std::unique_ptr<Implementation> self_;
};

/// The library's version, such as "0.1.0".
CASCADE_API const char* library_version();

}  // namespace cascade
