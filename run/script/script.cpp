// Parses a script, the files that it uses, and the options that change it. Then checks the whole
// script.
#include "run/script/script.h"

#include "core/check.h"
#include "core/file.h"
#include "core/near_name.h"
#include "lang/check/chance.h"
#include "lang/check/check.h"
#include "lang/check/unread_stages.h"
#include "lang/program/stage_kinds.h"
#include "lang/syntax/parse.h"
#include "lang/syntax/parse_table.h"
#include "picture/image.h"
#include "run/script/embedded_script.h"
#include "run/script/option_statements.h"
#include "lang/syntax/picture_expression.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <set>
#include <unordered_map>

namespace cascade {

namespace {

// Reads the files that a script names in `use "file.cascade"` or `use "table.csv"`. These files
// contain systems and functions.

constexpr std::size_t most_files = 1000;

class UsedFiles {
public:
    explicit UsedFiles(Script& script) : script_(script) {
        taken_.insert(std::filesystem::path(script.name).filename().generic_string());
    }

    void run() {
        // Each file that is read may append the files that it uses to this list, so the list grows
        // during the loop.
        for (std::size_t k = 0; k < script_.tree.uses.size(); ++k) {
            const ast::Use use = script_.tree.uses[k];
            const auto folder = folders_.find(use.span.source);
            const std::filesystem::path from =
                folder == folders_.end() ? std::filesystem::path() : folder->second;
            const std::filesystem::path path = (from / use.path).lexically_normal();
            if (!taken_.insert(path.generic_string()).second) continue;
            if (taken_.size() > most_files) {
                return script_.diagnostics.error(
                    use.span, fmt::format("a script uses at most {} files", most_files));
            }
            const auto text = text_of(path.generic_string(), use);
            if (text) add(path, *text);
        }
    }

private:
    std::optional<std::string> text_of(const std::string& path, const ast::Use& use);
    void add(const std::filesystem::path& path, const std::string& text);
    void set_folder_of_files(ast::ExprId first, const std::filesystem::path& folder);

    Script& script_;
    /// The paths of the files that were read, relative to the script's folder.
    std::set<std::string> taken_;
    std::unordered_map<SourceId, std::filesystem::path> folders_;
};

std::optional<std::string> UsedFiles::text_of(const std::string& path, const ast::Use& use) {
    auto& known = script_.overrides.used;
    const auto found = std::find_if(known.begin(), known.end(),
                                    [&](const auto& each) { return each.first == path; });
    if (found != known.end()) return found->second;
    auto text = GrantedFiles(script_.folder, script_.overrides.reads)
                    .read(path, is_table_name(path) ? largest_table_text : largest_script);
    if (!text) {
        script_.diagnostics.error(use.span, text.error().message, text.error().hint);
        add_unknown_names(script_.tree, use.span);
        return std::nullopt;
    }
    known.emplace_back(path, *text);
    return std::move(*text);
}

void UsedFiles::add(const std::filesystem::path& path, const std::string& text) {
    const std::string name = (script_.folder == "." ? path : script_.folder / path).string();
    const SourceId source = script_.sources.add(name, text);
    folders_[source] = path.parent_path();
    const auto first = static_cast<ast::ExprId>(script_.tree.expressions.size());
    if (is_table_name(name)) {
        return parse_table(source, script_.sources, script_.tree, script_.diagnostics);
    }
    parse_used(source, script_.sources, script_.tree, script_.diagnostics);
    set_folder_of_files(first, path.parent_path());
}

/// A used file gives the paths of data files relative to its own folder. This function makes the
/// paths relative to the script's folder.
void UsedFiles::set_folder_of_files(ast::ExprId first, const std::filesystem::path& folder) {
    if (folder.empty()) return;
    auto& expressions = script_.tree.expressions;
    for (ast::ExprId id = first; id < expressions.size(); ++id) {
        const auto* call = std::get_if<ast::Call>(&expressions[id].node);
        const bool names_file =
            call != nullptr && (call->function.text == "field" || call->function.text == "image");
        if (!names_file) continue;
        for (std::uint32_t k = 0; k < call->argument_count; ++k) {
            ast::Expr& argument = expressions[script_.tree.arguments[call->first_argument + k]];
            auto* text = std::get_if<ast::Text>(&argument.node);
            if (text != nullptr) text->value = (folder / text->value).generic_string();
        }
    }
}

/// Reads all files that the script's tree uses, directly or indirectly, and adds their systems and
/// functions to the tree. A path is relative to the folder of the file that contains it. Each file
/// is read only once, even if it is named several times or in a cycle. Files whose texts are in
/// `script.overrides.used` are not read. Afterwards, that list contains the texts of all files.
/// Errors are reported at the place where the script names the file.
void load_used_files(Script& script) { UsedFiles(script).run(); }

}  // namespace

std::string Script::messages(bool colour) const {
    RenderStyle style;
    style.colour = colour;
    return render(diagnostics, sources, style);
}

Script Script::detailed(std::int64_t times) const {
    Overrides changed = overrides;
    changed.detail = times;
    Script result = load_script(name, text, folder, std::move(changed));
    result.file = file;
    return result;
}

Program Script::coarser(std::int64_t times) const {
    Overrides changed = overrides;
    changed.coarse = times;
    const Script result = load_script(name, text, folder, std::move(changed));
    CHECK(result.program, "coarser cells make no script wrong");
    return *result.program;
}

std::uint32_t Script::stage_count() const {
    const auto& stages = program->stages;
    for (std::uint32_t k = 0; k < stages.size(); ++k) {
        if (overrides.until_stage && stages[k].name == *overrides.until_stage) return k + 1;
    }
    return static_cast<std::uint32_t>(stages.size());
}

std::uint32_t Script::final_stage() const {
    const std::uint32_t count = stage_count();
    for (std::uint32_t k = count; k-- > 0;) {
        if (program->stages[k].iterations > 0) return k;
    }
    return count - 1;
}

std::string example_of_stage(const Program& program) {
    const std::string_view system =
        program.systems.empty() ? "turing_spots" : std::string_view(program.systems.back().name);
    return fmt::format("add 'stage spots: {} {{ }}'", system);
}

std::string output_stem(const Script& script) {
    std::filesystem::path file = script.file.lexically_normal();
    if (!file.has_filename()) file = file.parent_path();
    const std::string stem = file.stem().string();
    return stem.empty() || stem == "." || stem == ".." || stem.starts_with("<") ? "cascade" : stem;
}

std::string shown_name(const Script& script) {
    return script.name.starts_with("<") ? output_stem(script) + ".cascade" : script.name;
}

Span option_span(Sources& sources, const std::string& option, const std::string& value) {
    const SourceId id = sources.add(fmt::format("<{}>", option), value);
    return {id, 0, static_cast<std::uint32_t>(value.size())};
}

Result<std::uint32_t> find_stage(const Program& program, const std::string& asked) {
    std::vector<std::string> names;
    for (std::uint32_t k = 0; k < program.stages.size(); ++k) {
        if (program.stages[k].name == asked) return k;
        names.push_back(program.stages[k].name);
    }
    std::uint32_t number = 0;
    const char* const end = asked.data() + asked.size();
    const auto parsed = std::from_chars(asked.data(), end, number);
    if (parsed.ec == std::errc() && parsed.ptr == end && number >= 1 && number <= names.size()) {
        return number - 1;
    }
    return failure(fmt::format("no stage is called '{}'", asked),
                   fmt::format("the stages are {}", fmt::join(names, ", ")));
}

std::optional<std::uint32_t> find_stage_of_option(Script& script, const std::string& name,
                                                  Span span) {
    std::vector<std::string> names;
    for (const Stage& stage : script.program->stages) names.push_back(stage.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) return static_cast<std::uint32_t>(found - names.begin());
    Diagnostic diagnostic;
    diagnostic.span = span;
    diagnostic.message = fmt::format("no stage is called '{}'", name);
    const std::string near = nearest_name(name, names);
    if (!near.empty()) diagnostic.hint = fmt::format("did you mean '{}'?", near);
    diagnostic.notes.push_back(
        {std::nullopt, fmt::format("the stages are {}", fmt::join(names, ", "))});
    script.diagnostics.add(std::move(diagnostic));
    return std::nullopt;
}

namespace {

void check_until_stage(Script& script) {
    if (!script.overrides.until_stage) return;
    const std::string& name = *script.overrides.until_stage;
    find_stage_of_option(script, name, option_span(script.sources, "--until-stage", name));
}

/// Checks the picture block, and warns of stages that no other stage and no picture reads.
void check_views(Script& script) {
    if (script.program->stages.empty()) return;
    const std::uint32_t stage = script.final_stage();
    const std::uint32_t last = script.stage_count() - 1;
    // With --until-stage, the picture may name stages that do not run, which is not an error of the
    // script. So the picture is checked only if all stages run.
    if (last + 1 != script.program->stages.size()) return;
    const Program& program = *script.program;
    std::vector<PictureView> views{{stage, std::nullopt}};
    if (const auto expression = picture_expression(script.tree)) {
        views[0].formula = check_view(script.tree, *expression, stage, last, program,
                                      script.sources, script.diagnostics);
        if (!views[0].formula) return;
        if (views[0].formula->nodes.back().type != ValueType::colour) {
            script.diagnostics.error(views[0].formula->nodes.back().span,
                                     "'color' must be a colour",
                                     "use rgb(…) or palette(value, low, high, \"name\")");
        }
    }
    // The checker of the picture block has already reported these errors, so the diagnostics are
    // ignored.
    Diagnostics unspoken;
    for (const char* const setting :
         {"height", "roughness", "metalness", "opacity", "emission", "body"}) {
        const auto expression = picture_expression(script.tree, setting);
        if (!expression) continue;
        auto formula =
            check_view(script.tree, *expression, stage, last, program, script.sources, unspoken);
        if (formula) views.push_back({stage, std::move(formula)});
    }
    const auto skin = picture_expression(script.tree, "skin");
    const auto below = stage_of_fields_before(program, stage);
    if (skin && below) {
        views.push_back({*below, check_view(script.tree, *skin, *below, last, program,
                                            script.sources, unspoken)});
    }
    warn_of_unread_stages(program, views, script.diagnostics);
}

}  // namespace

Script load_script(std::string name, std::string text, std::filesystem::path folder,
                   Overrides overrides) {
    Script script;
    script.name = std::move(name);
    script.file = script.name;
    script.text = std::move(text);
    script.folder = folder.empty() ? "." : std::move(folder);
    script.overrides = std::move(overrides);

    const SourceId source = script.sources.add(script.name, script.text);
    script.tree = parse(source, script.sources, script.diagnostics);
    load_used_files(script);
    for (const std::string& set : script.overrides.sets) {
        const SourceId id = script.sources.add("<--set>", set);
        parse_override(id, script.sources, script.tree, script.diagnostics);
    }
    add_option_statements(script);
    auto program = check(script.tree, script.sources, script.diagnostics);
    if (!program) return script;
    script.program = std::make_shared<const Program>(*std::move(program));

    check_until_stage(script);
    warn_of_draws_by_step(*script.program, script.diagnostics);
    warn_of_idle_seed(script.tree, *script.program, script.diagnostics);
    if (!script.diagnostics.has_errors()) check_views(script);
    if (script.diagnostics.has_errors()) script.program.reset();
    return script;
}

Result<void> check_for_fields(const Script& script, std::string_view what) {
    for (std::uint32_t k = 0; k < script.stage_count(); ++k) {
        if (!script.program->system_of(k).cells) continue;
        return failure(fmt::format("stage '{}' consists of cells that crawl, but {} stages of "
                                   "fields",
                                   script.program->stages[k].name, what),
                       "use 'cascade run' for this stage");
    }
    return {};
}

Result<LoadedFile> load_script_file(const std::filesystem::path& path, Overrides overrides) {
    constexpr std::uint64_t largest_picture = std::uint64_t{1} << 30;
    constexpr std::string_view signature = "\x89PNG\r\n\x1a\n";
    // A picture may be larger than a script. From a pipe or a device, at most as many bytes are
    // read as a script may have.
    const bool is_picture = first_bytes(path, signature.size()) == signature;
    auto bytes = read_file(path, is_picture ? largest_picture : largest_script);
    if (!bytes) {
        const auto size = size_of_file(path);
        if (!size || is_picture || *size <= largest_script) return tl::unexpected(bytes.error());
        return failure(fmt::format("{}: this script has {} bytes, but at most {} can be read",
                                   path.string(), *size, largest_script),
                       "is it really a Cascade script?");
    }
    if (!bytes->starts_with(signature)) {
        return LoadedFile{load_script(path.string(), std::move(*bytes), path.parent_path(),
                                      std::move(overrides)),
                          ""};
    }
    auto embedded = parse_embedded_script(*bytes, path.string());
    if (!embedded) return tl::unexpected(embedded.error());
    Overrides merged = merge(embedded->overrides, overrides);
    LoadedFile file{load_script(embedded->name, std::move(embedded->text), path.parent_path(),
                                std::move(merged)),
                    std::move(embedded->picture_options), std::move(embedded->varied),
                    std::move(embedded->session)};
    file.script.file = path;
    return file;
}

}  // namespace cascade
