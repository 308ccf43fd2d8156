// Cascade as a library: a script becomes a running pattern inside your own program.
//
//     cascade::Pattern pattern("system_name: turing_spots\niterations: 6000\nka: 1/80\n");
//     if (!pattern.ok()) { std::cerr << pattern.messages(); return 2; }
//     while (!pattern.finished()) pattern.step(100);
//     std::vector<float> b = pattern.values("b");      // height() rows of width() numbers
//
// Link with the CMake target Cascade::cascade. No function throws or prints. One thread at a time
// may use a Pattern, but any thread or signal handler may call cancel(). From C, and from languages
// that call C, cascade/cascade_c.h does the same.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
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

/// How a pattern is computed. Only `sets` and `seed` affect results.
struct PatternOptions {
    bool native_code = true;        ///< Compile the equations; false interprets them.
    int threads = 0;                ///< 0 for all that the machine has.
    std::string name = "<script>";  ///< The script's name in messages.
    std::string folder = ".";       ///< Paths in the script are relative to it.
    /// Values of parameters and settings, as `--set` takes them: "ka=1/80", "spots.ka=1/80".
    std::vector<std::string> sets = {};
    std::optional<std::uint32_t> seed = {};  ///< Of all random numbers, in place of the script's.
};

/// A parameter of a stage.
struct PatternParameter {
    struct Range {
        double low = 0, high = 1;
        std::optional<double> step;
    };
    std::string stage;
    std::string name;
    std::string doc;             ///< Its doc comment; may be empty.
    std::optional<Range> range;  ///< `in low .. high step s`.
    bool is_uniform = true;      ///< One number for all cells.
    double value = 0;            ///< NaN if it varies, or if its stage has not begun.
};

/// A measured feature of a pattern (spec/command_line.md). NaN if the pattern lacks it.
struct PatternFeature {
    std::string name;
    double value = 0;
};

/// How far a stage has come.
struct PatternProgress {
    std::string stage;
    int stage_number = 1;  ///< Counted from 1.
    int stage_count = 1;
    std::int64_t step = 0;        ///< Complete steps of this stage.
    std::int64_t steps = 0;       ///< Steps that it will take.
    double t = 0;                 ///< Its time if it ends at a time,
    double duration = 0;          ///< and that end; 0 if it ends after some steps.
    double steps_per_second = 0;  ///< 0 while unknown.
    double seconds_left = -1;     ///< Of this stage; negative while unknown.
};

/// Receives progress about ten times a second. Returns false to cancel.
using ProgressWatcher = std::function<bool(const PatternProgress&)>;

/// The values of all cells at the moment when the view was made. They stay readable and the same
/// while a copy of `owner` exists, also when the pattern goes on or is destroyed: then it goes on
/// in other memory.
struct PatternView {
    enum class Number { binary32, binary64 };
    const void* data = nullptr;  ///< The first cell of the first row; null if there are no values.
    Number number = Number::binary32;  ///< binary64 with `precision: double`.
    std::int64_t width = 0;            ///< Cells of a row, one after the other.
    std::int64_t height = 0;
    std::int64_t depth = 0;
    std::int64_t row_bytes = 0;    ///< From a row to the next.
    std::int64_t slice_bytes = 0;  ///< From a slice to the next.
    /// True if the values are computed for the view, false if they lie in the pattern's own memory.
    bool is_computed = false;
    std::uint64_t moment = 0;  ///< Pattern::moment() at which they are the present ones.
    std::shared_ptr<const void> owner;
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
    /// The same with place and hint, where there are any; otherwise line and column are 0.
    Message problem() const;

    /// Opens a script, a picture that carries one, a session, or the folder of a saved run, which
    /// goes on where it was saved. Paths in a script are relative to its folder; `options.name` and
    /// `options.folder` are not used.
    static Pattern open(const std::string& path, const PatternOptions& options = {});

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
    /// The same with a watcher, which may be empty.
    std::int64_t step(std::int64_t count, const ProgressWatcher& watcher);
    /// Takes all steps. False if they were cancelled or have failed.
    bool run(const ProgressWatcher& watcher = {});
    /// True when every stage has taken all its steps.
    bool finished() const;
    /// Name of the stage that steps are taken in now (the last one when finished).
    std::string current_stage() const;
    /// Complete steps of that stage.
    std::int64_t steps() const;
    /// Changes with every step and every change: values read earlier are then those of the past.
    std::uint64_t moment() const;

    /// The parameters of all stages, in the order of the script.
    std::vector<PatternParameter> parameters() const;
    /// What `cascade run` would remark on the stages so far, a sentence each.
    std::vector<std::string> remarks() const;

    // A pattern can be changed between two steps (spec/session.md). Each change returns false if it
    // is refused. Then error() says why, nothing has changed, and the pattern stays ok.

    /// Gives a parameter or setting another value, as `--set NAME=EXPRESSION` does: "ka", "1/80".
    bool set(const std::string& name, const std::string& expression);
    /// The same with a number, which reaches the pattern unrounded.
    bool set(const std::string& name, double value);
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
    /// The same without rounding to single precision.
    std::vector<double> numbers(const std::string& expression);
    /// The same without a copy, where the expression is a species or a varying parameter of a grid
    /// without a mask: the view then lies in the pattern's memory. While somebody owns it, the next
    /// step copies that plane once.
    PatternView view(const std::string& expression);

    /// The features of the picture, or of `expression`: wavelength, spots, area and others. Empty
    /// if it is wrong, as values().
    std::vector<PatternFeature> features(const std::string& expression = "");
    /// What will grow, as `cascade analyze` tells it, in words or as JSON. Empty if a stage cannot
    /// be analysed. Then error() says why, and the pattern stays ok.
    std::string analysis(const std::string& stage = "", bool as_json = false);

    /// The present step as a PNG file in memory: what `cascade run` would draw, or `expression`. It
    /// carries the session, so that `cascade run FILE` draws it again. Empty if there is no
    /// picture. Then error() says why, and the pattern stays ok.
    std::string picture(const std::string& expression = "");
    /// Writes that picture to a file, whose name ends in .png.
    bool write_picture(const std::string& path, const std::string& expression = "");
    /// Saves all values in a folder, as `--save` does, for open() and `cascade run --resume`.
    bool save(const std::string& folder);

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
