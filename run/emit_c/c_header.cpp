// Fills in the texts of run/emit_c/c_header_text.h, in which the stage's name replaces $, and the
// same name in capitals replaces $$. Between these texts, writes the tables, the struct and the
// functions.
#include "run/emit_c/c_header.h"

#include "core/plane.h"
#include "core/version.h"
#include "run/emit_c/c_comment.h"
#include "run/emit_c/c_header_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace cascade {

namespace {

std::string upper(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return text;
}

/// Writes a float literal of C. NaN and infinity become expressions.
std::string c_number(float value) {
    if (std::isnan(value)) return "(0.0f / 0.0f)";
    if (std::isinf(value)) return value > 0 ? "(1.0f / 0.0f)" : "(-1.0f / 0.0f)";
    return fmt::format("(float){:.9g}", value);
}

std::string stencil_words(Stencil stencil) {
    const char* neighbours[] = {
        "",        "(E + W)",           "(N + S)",           "((N + S) + E) + W",
        "(U + D)", "((E + W) + U) + D", "((N + S) + U) + D", "((((N + S) + E) + W) + U) + D"};
    return fmt::format("{} - {}c", neighbours[stencil.number()], 2 * stencil.axes());
}

class HeaderWriter {
public:
    HeaderWriter(const Program& program, std::uint32_t stage, const CStage& compiled,
                 const std::string& script)
        : program_(program),
          stage_(program.stages[stage]),
          system_(program.system_of(stage)),
          compiled_(compiled),
          script_(script),
          big_(upper(compiled.name)),
          layout_(program.domain.grid) {}

    std::string write() const {
        std::string text = introduction();
        text += filled(c_text::beginning);
        text += constants();
        text += filled(c_text::sides);
        text += structure();
        text += prototypes();
        text += filled(c_text::planes);
        if (compiled_.step.find("_draw(") != std::string::npos) text += filled(c_text::draws);
        if (!compiled_.masks.empty()) text += filled(c_text::masks);
        if (compiled_.reduces) text += filled(c_text::reductions);
        text += filled(c_text::allocation);
        if (!compiled_.data.empty()) text += filled(c_text::data);
        text += initialisation() + start() + step();
        return text + filled(c_text::ending);
    }

private:
    /// Puts the names in place of $$ and $.
    std::string filled(std::string_view pattern) const {
        std::string text;
        for (std::size_t k = 0; k < pattern.size(); ++k) {
            if (pattern[k] != '$') {
                text += pattern[k];
            } else if (k + 1 < pattern.size() && pattern[k + 1] == '$') {
                text += big_;
                ++k;
            } else {
                text += compiled_.name;
            }
        }
        return text;
    }

    template <typename Entry>
    std::string table(std::string_view member, std::string_view prefix,
                      const std::vector<Entry>& entries) const {
        std::string text;
        for (const Entry& entry : entries) {
            text += fmt::format(" *   {}[{}_{}_{}]  {}{}\n", member, big_, prefix, entry.identifier,
                                c_comment(entry.meaning),
                                entry.is_given ? ": to be set before the start" : "");
        }
        return text;
    }

    std::string introduction() const {
        std::string text = fmt::format("/* Stage '{}' (system {}) of {}, compiled by Cascade {}.\n",
                                       c_comment(stage_.name), c_comment(system_.name),
                                       c_comment(script_), version());
        text += filled(R"( *
 *     struct $ s;
 *     void *memory = malloc($$_BYTES);
 *     $_init(&s, memory);
 *     $_start(&s);
 *     $_run(&s, 1000);
 *
 * $_init lays all planes in memory and sets the numbers to what the script says.
 * $_start computes the starting values; a program may change them, or set its own instead.
 * $_step takes a step, $_run several. Planes change their place from step to step: take
 * their addresses from the struct. The bits are those of `cascade run`; with OpenMP threads share the
 * work. Nothing is freed but `memory`, by whoever allocated it.
 *
 * Layout. A plane holds one value per cell, and a table has the address of its cell (0, 0, 0):
 * cell (column i, row j, slice k) is plane[$_at(i, j, k)]. A row starts on 64 bytes. The
 * halo, cells -1 and after the last along each axis, is filled by the step.
 *
)");
        text += table("species", "SPECIES", compiled_.species);
        text += table("numbers", "NUMBER", compiled_.numbers);
        text += table("planes", "PLANE", compiled_.planes);
        text += table("masks", "MASK", compiled_.masks);
        if (!compiled_.sides.empty()) {
            text += filled(
                " *   sides[species][$_left ... $_back]  rules at the sides, which may "
                "change\n");
        }
        text += fmt::format(
            " *   steps  complete steps since the start\n"
            " *\n"
            " * Rounding. IEEE binary32, to nearest even, no fused multiply-add; denormal numbers "
            "are\n"
            " * zero. The Laplacian is {}, in this order.\n"
            " */\n",
            stencil_words(program_.domain.grid.stencil()));
        return text;
    }

    template <typename Entry>
    std::string enumeration(std::string_view prefix, const std::vector<Entry>& entries) const {
        if (entries.empty()) return "";
        std::vector<std::string> names;
        for (const Entry& entry : entries) {
            names.push_back(fmt::format("    {}_{}_{}", big_, prefix, entry.identifier));
        }
        return fmt::format("enum {{\n{}\n}};\n", fmt::join(names, ",\n"));
    }

    std::size_t plane_count() const {
        return 2 * compiled_.species.size() +
               compiled_.scratch_registers * compiled_.species.size() + compiled_.planes.size() +
               compiled_.temporaries + compiled_.side_planes;
    }

    std::string constants() const {
        // The number of cells includes the padding of rows and the halo.
        const auto cells = static_cast<std::size_t>(layout_.size());
        const std::size_t plane_bytes = cells * sizeof(float);
        const std::size_t mask_bytes = cells * compiled_.masks.size();
        const std::size_t row_bytes =
            compiled_.reduces ? static_cast<std::size_t>(layout_.row_count()) * sizeof(double) : 0;
        const auto define = [&](std::string_view what, const std::string& value) {
            return fmt::format("#define {}_{} {}\n", big_, what, value);
        };
        const auto number = [](std::int64_t value) { return std::to_string(value); };
        std::string text = "/* The grid, and how its planes lie: in elements. */\n";
        text += define("WIDTH", number(layout_.width));
        text += define("HEIGHT", number(layout_.height));
        text += define("DEPTH", number(layout_.depth));
        text += define("ROWS", number(layout_.row_count()));
        text += define("CELLS", number(program_.domain.grid.cell_count()));
        text += define("SPACING", c_number(static_cast<float>(program_.domain.grid.spacing)));
        text += define("STRIDE", number(layout_.stride));
        text += define("SLICE_STRIDE", number(layout_.slice_stride));
        text += define("ORIGIN", number(layout_.offset(0, 0)));
        text += define("PLANE_SIZE", number(layout_.size()));
        text += "/* Bytes of memory that the stage needs. */\n";
        text += define("BYTES", fmt::format("((size_t){})", plane_count() * plane_bytes +
                                                                mask_bytes + row_bytes + 63));
        if (!stage_.time.has_duration() && !stage_.time.open_end) {
            text += "/* Steps that the script takes. */\n";
            text += define("ITERATIONS", number(stage_.iterations));
        }
        text += "/* Indices in the tables. */\n";
        text += enumeration("SPECIES", compiled_.species);
        text += enumeration("NUMBER", compiled_.numbers);
        text += enumeration("PLANE", compiled_.planes);
        text += enumeration("MASK", compiled_.masks);
        return text;
    }

    /// Returns the names and lengths of the struct's members that are arrays of planes, in their
    /// order in memory.
    std::vector<std::pair<std::string, std::size_t>> plane_tables() const {
        const std::size_t species = compiled_.species.size();
        std::vector<std::pair<std::string, std::size_t>> tables;
        const auto add = [&](const char* name, std::size_t count) {
            if (count > 0) tables.emplace_back(name, count);
        };
        add("species", species);
        add("planes", compiled_.planes.size());
        add("next", species);
        add("scratch", compiled_.scratch_registers * species);
        add("temporaries", compiled_.temporaries);
        add("side_planes", compiled_.side_planes);
        return tables;
    }

    std::string structure() const {
        std::string text = fmt::format("struct {} {{\n", compiled_.name);
        const auto member = [&](const std::string& declaration) {
            text += fmt::format("    {};\n", declaration);
        };
        if (!compiled_.numbers.empty()) {
            member(fmt::format("float numbers[{}]", compiled_.numbers.size()));
        }
        if (!compiled_.masks.empty()) {
            member(fmt::format("unsigned char *masks[{}]", compiled_.masks.size()));
        }
        if (!compiled_.sides.empty()) {
            member(fmt::format("struct {}_side sides[{}][6]", compiled_.name,
                               compiled_.species.size()));
        }
        member("int64_t steps");
        for (const auto& [name, count] : plane_tables()) {
            if (name == "next") text += "    /* The members below are for the functions only. */\n";
            member(fmt::format("float *{}[{}]", name, count));
        }
        if (compiled_.reduces) member("double *rows");
        if (compiled_.speed) member("double length, base_time");
        if (compiled_.speed) member("int64_t base_step");
        return text + "};\n";
    }

    std::string prototypes() const {
        std::string text = fmt::format(
            "\n/* Columns [column_begin, column_end) of rows [row_begin, row_end) of a pass, in the object\n"
            "   file. */\n"
            "typedef void {}_kernel(const float *const *fields, const unsigned char *const "
            "*masks,\n"
            "    const float *uniforms, float *const *results, int64_t column_begin,\n"
            "    int64_t column_end, int64_t stride, int64_t row_begin, int64_t row_end,\n"
            "    int64_t is_near{});\n",
            compiled_.name, layout_.depth > 1 ? ", int64_t slice_rows, int64_t slice" : "");
        for (const CKernel& kernel : compiled_.kernels) {
            text += fmt::format("extern {}_kernel {};\n", compiled_.name, kernel.name);
        }
        for (const CData& data : compiled_.data) {
            text += fmt::format("extern const float {}[];\n", data.name);
        }
        std::vector<std::string> rules;
        const SideRules boundary(program_.domain.grid.boundary);
        for (const SideRule& rule : boundary.at) {
            rules.push_back(fmt::format("{{{}, 0, NULL}}", c_side(rule.kind)));
        }
        text += fmt::format(
            "\n/* The sides of what is no species{}. */\n"
            "static const struct {}_side {}_boundary[6] = {{\n    {}\n}};\n",
            compiled_.sides.empty() ? ", and of all species" : "", compiled_.name, compiled_.name,
            fmt::join(rules, ",\n    "));
        return text;
    }

    std::string c_side(SideKind kind) const {
        return fmt::format("{}_{}", compiled_.name,
                           side_kind_words[static_cast<std::size_t>(kind)]);
    }

    std::string initialisation() const {
        std::string text = filled(R"(
/* Lays out the struct in $$_BYTES bytes of memory and sets its numbers. */
static inline void $_init(struct $ *s, void *memory) {
    char *place = (char *)(((uintptr_t)memory + 63) / 64 * 64);
    int k;
    memset(s, 0, sizeof *s);
    memset(memory, 0, $$_BYTES);
)");
        for (const auto& [name, count] : plane_tables()) {
            text += fmt::format("    for (k = 0; k < {}; ++k) s->{}[k] = {}_plane(&place);\n",
                                count, name, compiled_.name);
        }
        for (std::size_t k = 0; k < compiled_.masks.size(); ++k) {
            text += fmt::format(
                "    s->masks[{}] = (unsigned char *)place + {}_ORIGIN;\n"
                "    place += {}_PLANE_SIZE;\n",
                k, big_, big_);
        }
        if (compiled_.reduces) {
            text += fmt::format(
                "    s->rows = (double *)(void *)place;\n"
                "    place += {}_ROWS * sizeof(double);\n",
                big_);
        }
        text += "    (void)place;\n";
        for (std::size_t k = 0; k < compiled_.numbers.size(); ++k) {
            const float value = compiled_.numbers[k].value;
            if (value == 0 && !std::signbit(value)) continue;
            text += fmt::format("    s->numbers[{}] = {};\n", k, c_number(value));
        }
        for (std::size_t species = 0; species < compiled_.sides.size(); ++species) {
            for (std::size_t side = 0; side < side_count; ++side) {
                text += fmt::format("    s->sides[{}][{}].kind = {};\n", species, side,
                                    c_side(compiled_.sides[species][side]));
            }
        }
        for (std::size_t k = 0; k < compiled_.planes.size(); ++k) {
            if (compiled_.planes[k].data.empty()) continue;
            text += fmt::format("    {}_copy(s->planes[{}], {});\n", compiled_.name, k,
                                compiled_.planes[k].data);
        }
        if (compiled_.speed) {
            text += fmt::format("    s->length = (double)s->numbers[{}];\n", *compiled_.speed);
        }
        return text + "}\n\n";
    }

    std::string start() const {
        std::string text = filled(R"(/* Computes the starting values. */
static inline void $_start(struct $ *s) {
    const uint64_t before = $_enter();
)");
        text += compiled_.start;
        text += "    s->steps = 0;\n";
        if (compiled_.speed) {
            text += fmt::format(
                "    s->base_step = 0;\n    s->base_time = 0;\n"
                "    s->length = (double)s->numbers[{}];\n",
                *compiled_.speed);
        }
        return text + fmt::format("    {}_set_control(before);\n}}\n\n", compiled_.name);
    }

    std::string step() const {
        std::string text = filled(R"(/* Takes one step. */
static inline void $_step(struct $ *s) {
    const uint64_t before = $_enter();
    int k;
)");
        const auto uses = [&](std::string_view word) {
            return compiled_.step.find(word) != std::string::npos;
        };
        const bool needs_time = uses("(float)t") || uses("(float)(t +");
        const std::string length = compiled_.speed
                                       ? fmt::format("(double)s->numbers[{}]", *compiled_.speed)
                                       // If the length of steps varies by cell, the cells have no
                                       // common time, and the length counts as 0.
                                       : "0";
        if (needs_time || uses("length)")) {
            text += fmt::format("    const double length = {};\n", length);
        }
        if (needs_time) text += compiled_.speed ? "    double t;\n" : "    const double t = 0;\n";
        if (compiled_.step_aggregates > 0) {
            text += fmt::format("    float aggregates[{}];\n", compiled_.step_aggregates);
        }
        if (needs_time && compiled_.speed) text += filled(c_text::clock);
        if (compiled_.frozen) {
            text += fmt::format(
                "    if (s->numbers[{}] != 0) {{ /* Everything is frozen. */\n"
                "        ++s->steps;\n        {}_set_control(before);\n"
                "        return;\n    }}\n",
                *compiled_.frozen, compiled_.name);
        }
        text += compiled_.step;
        text += fmt::format(R"(    for (k = 0; k < {}; ++k) {{
        float *const old = s->species[k];
        s->species[k] = s->next[k];
        s->next[k] = old;
    }}
    ++s->steps;
    {}_set_control(before);
}}
)",
                            compiled_.species.size(), compiled_.name);
        return text;
    }

    const Program& program_;
    const Stage& stage_;
    const System& system_;
    const CStage& compiled_;
    const std::string& script_;
    std::string big_;
    PlaneLayout layout_;
};

}  // namespace

std::string c_header(const Program& program, std::uint32_t stage, const CStage& compiled,
                     const std::string& script) {
    return HeaderWriter(program, stage, compiled, script).write();
}

}  // namespace cascade
