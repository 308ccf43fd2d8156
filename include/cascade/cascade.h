// Cascade as a library: runs a script as a pattern inside your own program.
//
//     cascade::Pattern pattern("system_name: turing_spots\niterations: 6000\nka: 1/80\n");
//     if (!pattern.ok()) { std::cerr << pattern.messages(); return 2; }
//     while (!pattern.finished()) pattern.step(100);
//     std::vector<float> b = pattern.values("b");      // height() rows of width() numbers
//
// Link with the CMake target Cascade::cascade. No function throws or prints. Only one thread at a
// time may use a Pattern, but any thread or signal handler may call cancel(). cascade/cascade_c.h
// offers the same functions to C, and to languages that can call C.
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

/// An error or warning about a script. Lines and columns count from 1.
struct Message {
    bool is_error = true;
    std::string file;
    int line = 0;
    int column = 0;
    std::string text;
    std::string hint;  ///< A suggestion. May be empty.
};

/// Options for running a pattern. Only `sets` and `seed` affect its results.
struct PatternOptions {
    /// Whether the equations are compiled. Otherwise they are interpreted.
    bool native_code = true;
    int threads = 0;                ///< The number of threads. 0: as many as the machine has.
    std::string name = "<script>";  ///< The script's name in messages.
    std::string folder = ".";       ///< Relative paths in the script start at this folder.
    /// Values of parameters and settings, in the notation of `--set`: "ka=1/80", "spots.ka=1/80".
    std::vector<std::string> sets = {};
    std::optional<std::uint32_t> seed = {};  ///< Replaces the script's seed of random numbers.
};

/// A parameter of a stage.
struct PatternParameter {
    struct Range {
        double low = 0, high = 1;
        std::optional<double> step;
    };
    std::string stage;
    std::string name;
    /// The comment in the script that describes the parameter; empty if there is none.
    std::string doc;
    std::optional<Range> range;  ///< The range that the script gives as `in low .. high step s`.
    bool is_uniform = true;      ///< Whether the value is the same in all cells.
    /// The present value. NaN if it is not the same in all cells or if its stage has not begun.
    double value = 0;
};

/// A measured feature of a pattern (spec/command_line.md). NaN if the pattern does not have it.
struct PatternFeature {
    std::string name;
    double value = 0;
};

/// The progress of a stage.
struct PatternProgress {
    std::string stage;
    int stage_number = 1;  ///< The number of the stage, from 1.
    int stage_count = 1;
    std::int64_t step = 0;   ///< Complete steps of this stage.
    std::int64_t steps = 0;  ///< The number of steps that the stage will take.
    double t = 0;  ///< The time since the start of the stage, if the stage ends after a duration.
    /// The duration after which the stage ends. 0 if it ends after a number of steps.
    double duration = 0;
    double steps_per_second = 0;  ///< 0 while unknown.
    double seconds_left = -1;     ///< Until the stage ends. Negative while unknown.
};

/// Called with the progress about ten times a second. Returns false to cancel.
using ProgressWatcher = std::function<bool(const PatternProgress&)>;

/// The values of all cells at the moment when the view was opened. They do not change, and can be
/// read as long as a copy of `owner` exists, even if the pattern takes steps or is destroyed. The
/// pattern then continues in other memory.
struct PatternView {
    enum class Number { binary32, binary64 };
    const void* data = nullptr;  ///< The first cell of the first row. Null if there are no values.
    Number number = Number::binary32;  ///< binary64 if the script says `precision: double`.
    std::int64_t width = 0;  ///< The number of cells in a row, which are adjacent in memory.
    std::int64_t height = 0;
    std::int64_t depth = 0;
    std::int64_t row_bytes = 0;    ///< The distance from one row to the next, in bytes.
    std::int64_t slice_bytes = 0;  ///< The distance from one slice to the next, in bytes.
    /// Whether the values were computed for this view. Otherwise they are in the pattern's own
    /// memory.
    bool is_computed = false;
    std::uint64_t moment = 0;  ///< The value of Pattern::moment() when the view was opened.
    std::shared_ptr<const void> owner;
};

/// The cells and triangles of a model. Positions are x, y and z of each point, in the coordinates
/// of scripts: 0 to 1 along the longest side of the model's box, and y upwards (spec/models.md).
struct PatternModel {
    std::vector<double> points;  ///< The positions of the cells, in the order of values().
    std::vector<double> areas;   ///< The areas of the cells, in the squared unit of `points`.
    /// The pairs of adjacent cells, between which species diffuse. Each pair occurs once, with the
    /// lower cell first.
    std::vector<std::uint32_t> links;
    /// For each pair, the length of the edge between both cells divided by the distance of the
    /// cells. This number is the flow between the cells for a difference of 1 (G. Turk, "Texturing
    /// Surfaces Using Reaction-Diffusion", thesis, 1992, section 4.4).
    std::vector<double> weights;
    std::vector<double> vertices;          ///< The points of the model's triangles.
    std::vector<std::uint32_t> triangles;  ///< Three vertices each, counterclockwise from outside.
};

/// A checked script and the state of its run.
class CASCADE_API Pattern {
public:
    /// Parses and checks a script, and computes the starting values of its first stage.
    explicit Pattern(const std::string& script, const PatternOptions& options = {});
    ~Pattern();
    Pattern(Pattern&&) noexcept;
    Pattern& operator=(Pattern&&) noexcept;

    /// Returns false if the script has errors or the run has failed. See diagnostics(), messages()
    /// and error().
    bool ok() const;
    /// The errors and warnings of the script, in the order of their positions in the script.
    std::vector<Message> diagnostics() const;
    /// The diagnostics as text, as the command line prints them.
    std::string messages() const;
    /// The reason why the run failed, such as values that are not finite or lack of memory. Empty
    /// if the run has not failed.
    std::string error() const;
    /// The last error with its position and hint. Line and column are 0 if the error has no
    /// position.
    Message problem() const;

    /// Opens a script, a picture that contains one, a session, or the folder of a saved run. A
    /// saved run continues from the moment at which it was saved. Relative paths in a script start
    /// at the script's folder. `options.name` and `options.folder` are ignored.
    static Pattern open(const std::string& path, const PatternOptions& options = {});

    /// The number of columns of the grid. 0 if the script has errors. A model counts as one row, so
    /// this is the number of its cells.
    std::int64_t width() const;
    std::int64_t height() const;  ///< The number of rows.
    std::int64_t depth() const;   ///< The number of slices. 1 for a plane.

    /// The names of the stages, in order.
    std::vector<std::string> stages() const;
    /// The names of the species of a stage. Empty if there is no such stage.
    std::vector<std::string> species(const std::string& stage) const;

    /// Takes up to `count` steps. When a stage ends, continues with the next one. Returns the
    /// number of steps taken, which is less than `count` at the end of the last stage, after
    /// cancel(), or on failure. A value that is not finite is found within 64 steps, at the end of
    /// a stage, or by values(). The pattern has then failed, and returns to the last step at which
    /// all values were finite.
    std::int64_t step(std::int64_t count);
    /// Takes up to `count` steps like step(count), and calls `watcher` with the progress. `watcher`
    /// may be empty.
    std::int64_t step(std::int64_t count, const ProgressWatcher& watcher);
    /// Takes all steps. Returns false if the run failed or was cancelled.
    bool run(const ProgressWatcher& watcher = {});
    /// Whether every stage has taken all its steps.
    bool finished() const;
    /// The name of the stage that takes steps now, or of the last stage if all stages have ended.
    std::string current_stage() const;
    /// The number of complete steps of the current stage.
    std::int64_t steps() const;
    /// A number that changes with every step and every change. If it still has the value from an
    /// earlier call, values that were read at that time are still the present ones.
    std::uint64_t moment() const;

    /// The parameters of all stages, in the order of the script.
    std::vector<PatternParameter> parameters() const;
    /// The remarks that `cascade run` would make on the stages so far. Each is a sentence.
    std::vector<std::string> remarks() const;

    // The following functions change a pattern between two steps (spec/session.md). Each returns
    // false if the change is refused. Then error() gives the reason, nothing has changed, and ok()
    // is still true.

    /// Sets a parameter or setting, as `--set NAME=EXPRESSION` does, for example "ka" to "1/80".
    bool set(const std::string& name, const std::string& expression);
    /// Sets a parameter or setting to a number, without rounding it to the digits of a text.
    bool set(const std::string& name, double value);
    /// Continues with another script. Items with the same name in both scripts keep their values.
    /// If the new script has other cells (grid, mask, model, seed, precision), the run begins anew.
    bool set_script(const std::string& script);
    /// Sets the values of a species, of a parameter that varies from cell to cell, or of `frozen`.
    /// The expression is evaluated in the present state of the current stage. For example, paint
    /// "b" with "if(disc(0.5, 0.5, 0.1) > 0, 8, b)".
    bool paint(const std::string& item, const std::string& expression);
    /// Sets the values of a species, of a parameter that varies from cell to cell, or of `frozen`:
    /// a finite number for each cell, in the order of values(). Values outside a mask are ignored.
    bool set_values(const std::string& item, const std::vector<double>& values);
    /// Ends the current stage at its present step, and begins the next one.
    bool begin_next_stage();
    /// undo() returns to the moment before the last change, and redo() to the moment before the
    /// last undo(), both bit for bit.
    bool undo();
    bool redo();
    /// The log of all steps and changes, as text. play() repeats the log and makes the same
    /// pattern, bit for bit. Empty if there is no such log, because the pattern began with the
    /// values of a saved run, or because more than 256 MiB of values were set. Then error() gives
    /// the reason.
    std::string session();
    /// Repeats a session to its end. `session` is the text that session() returned, or the bytes of
    /// a picture file. Relative paths in the session's script start at `options.folder`.
    static Pattern play(const std::string& session, const PatternOptions& options = {});

    /// The values of an expression in the present state, row by row and slice by slice. The
    /// expression may be a species or parameter of the current stage ("b") or of an earlier stage
    /// ("stage1.b"), or any formula ("b - stage1.b"). Cells outside the domain's mask have NaN,
    /// unless the expression is uniform. A stage of crawling cells has one value for each cell, in
    /// the order of the cells' numbers (spec/cells.md). If the expression has errors, the result is
    /// empty, error() gives the reason, and ok() is still true. The result is also empty if the
    /// pattern has values that are not finite. See step().
    std::vector<float> values(const std::string& expression);
    /// The values of an expression, like values(), but not rounded to single precision.
    std::vector<double> numbers(const std::string& expression);
    /// The values of an expression. If the expression is a species or a varying parameter on a grid
    /// without a mask, no value is copied, and the view refers to the pattern's own memory. While a
    /// copy of the view's `owner` exists, the next step copies the plane of the view once.
    PatternView view(const std::string& expression);

    /// The features of the values in the picture, or of `expression` if it is not empty:
    /// wavelength, spots, area and others. Empty if the expression has errors. See values().
    std::vector<PatternFeature> features(const std::string& expression = "");
    /// The analysis by `cascade analyze`, which predicts what will grow in a stage, in words or as
    /// JSON. If the stage cannot be analysed, the result is empty, error() gives the reason, and
    /// ok() is still true.
    std::string analysis(const std::string& stage = "", bool as_json = false);

    /// The present step as a PNG file in memory. It shows the picture of `cascade run`, or
    /// `expression` if that is not empty. The file contains the session, so that `cascade run FILE`
    /// draws the picture again. If there is no picture, the result is empty, error() gives the
    /// reason, and ok() is still true.
    std::string picture(const std::string& expression = "");
    /// Writes the result of picture() to a file. The name of the file must end in .png.
    bool write_picture(const std::string& path, const std::string& expression = "");
    /// Saves all values to a folder, as the option `--save` does, for open() and `cascade run
    /// --resume`.
    bool save(const std::string& folder);

    /// Writes the present moment to a file in the format of its ending, as `cascade run -o PATH`
    /// does: a picture, a figure, a model, crawling cells, or a volume (.vti, .vdb). `options` is a
    /// JSON object with options of `cascade run`, such as {"palette": "viridis", "bake": 2048}. The
    /// file is unchanged if the function returns false.
    bool write(const std::string& path, const std::string& options = "{}");
    /// Takes all remaining steps, and writes a film of them: a frame after every `every` steps, at
    /// the start and at the end. If `every` is 0, the smallest interval of the stages is used,
    /// where a stage without an interval counts with a fiftieth of its steps. `options` takes the
    /// options of write(), and also "fps" or "seconds". `watcher` is called as in step(), and while
    /// frames are drawn. If it cancels the film, no file is written.
    bool film(const std::string& path, std::int64_t every = 0, const std::string& options = "{}",
              const ProgressWatcher& watcher = {});
    /// The script as a page that runs in browsers without the program, as `cascade export` writes
    /// it. The page begins with the script's starting values. Empty if there is no engine.wasm
    /// beside the library, or if the page cannot run the script. Then error() gives the reason.
    std::string page();

    /// The cells and triangles of the model on which the pattern grows. If the pattern grows on a
    /// grid, all arrays are empty, and error() says so.
    PatternModel model();

    /// Makes a step() in another thread return after its present step. The next step() continues
    /// from there.
    void cancel();

private:
    struct Implementation;
    Pattern();
    std::unique_ptr<Implementation> self_;
};

/// The library's version, such as "0.1.0".
CASCADE_API const char* library_version();

}  // namespace cascade
