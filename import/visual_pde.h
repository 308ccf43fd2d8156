// Simulations of VisualPDE (visualpde.com): what the source files of their reader share.
#pragma once

#include "import/importer.h"

#include <nlohmann/json.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace cascade::importing {

/// The options of a simulation, as texts. An option that is not given has VisualPDE's default.
class VisualPdeOptions {
public:
    /// Reads a link, or a preset as JSON.
    static std::optional<VisualPdeOptions> read(Import& import);

    std::string text(const std::string& key) const;
    /// An option of one of the four species, such as "reactionStr_1".
    std::string text(std::string_view key, std::size_t species) const;
    bool is_true(const std::string& key) const { return text(key) == "true"; }
    /// Makes the text of an option a source, for messages about it.
    Span source(Import& import, const std::string& key) const;

private:
    std::map<std::string, std::string> values_;
};

/// The names of a simulation, and the meaning of its formulas.
class VisualPdeNames {
public:
    VisualPdeNames(Import& import, const VisualPdeOptions& options, Draft& draft)
        : import_(import), options_(options), draft_(draft) {}

    /// Declares species and parameters, and finds the size of the domain. Returns false after an
    /// error.
    bool declare();

    enum class Where : std::uint8_t { rate, start, mask, side, picture };
    /// Translates the formula of an option. If the text is not a formula, reports an error. An
    /// empty text means 0.
    std::optional<Expression> formula(Span span, Where where);
    std::optional<Expression> option(const std::string& key, Where where);
    /// The value of an option that is one number.
    std::optional<double> constant(const std::string& key);

    /// Whether a translated formula is the same number in all cells.
    bool is_uniform(const Expression& formula) const;
    const std::vector<std::string>& species() const { return species_; }
    std::size_t algebraic() const { return algebraic_; }
    bool is_line() const { return is_line_; }
    /// The number of species whose formula gives their next value. They come before the algebraic
    /// species.
    std::size_t maps() const { return maps_; }
    /// The definition that is 1 inside a mask that changes. Empty if the mask does not change.
    const std::string& inside() const { return inside_; }
    /// The boundary condition of a species in small letters.
    std::string kind_of_sides(std::size_t species) const;
    bool is_closed(const std::string& species) const;
    Expression operate(const std::string& function, const std::string& species);
    /// div(factor * grad(species)) in a domain whose mask changes. Empty if the factor is a tensor.
    std::optional<Expression> flow(Expression factor, const std::string& species);
    bool is_differentiated(const std::string& species) const {
        return differentiated_.contains(species);
    }
    std::string fresh_name(const char* wanted) { return names_.fresh(wanted); }
    void differentiate(const std::string& species) { differentiated_.insert(species); }
    /// Adds the parameters that formulas have read so far.
    void add_parameters();
    void fail(Span span, std::string why, std::string hint = "");
    bool has_failed() const { return has_failed_; }

    double width = 0, height = 0, spacing = 0;
    std::int64_t columns = 1, rows = 1;

private:
    struct Parameter {
        std::string foreign, own, range;
        Span value;
        bool is_read = false;
    };

    bool declare_parameters();
    bool measure();
    bool find_moving_mask();
    std::optional<Expression> meaning(const Expression& part, Where where);
    std::optional<Expression> named(const Expression& part, Where where);
    std::optional<Expression> derivative(const std::string& word);
    std::optional<Expression> at_other_cell(const Expression& part);
    std::optional<Expression> picture(const Expression& part, Where where);
    Expression on_edge(bool is_outer);
    std::optional<Expression> number_for(const Expression& part, double x, double y) const;
    std::optional<std::string> place_in_picture(const Expression& at, char axis);
    Expression shifted(const std::string& species, int right, int up);
    Expression with_safe_powers(const Expression& formula);
    Expression place(char axis);
    void add_function(const std::string& text);

    Import& import_;
    const VisualPdeOptions& options_;
    Draft& draft_;
    FreeNames names_;
    std::vector<std::string> species_;
    /// The names of species in the script, by their names in VisualPDE.
    std::map<std::string, std::string> own_species_;
    std::vector<Parameter> parameters_;
    std::map<std::string, double> values_;  ///< The values of parameters that are numbers.
    std::set<std::string> differentiated_;
    std::map<std::string, std::string> pictures_;
    std::size_t algebraic_ = 0, maps_ = 0;
    std::string inside_;
    bool is_line_ = false;
    bool has_failed_ = false;
    int depth_ = 0;
};

/// Adds the boundary conditions of all species, and `boundary` and `mask` of the domain.
bool add_visual_pde_sides(VisualPdeNames& names, Import& import, const VisualPdeOptions& options,
                          Draft& draft);

}  // namespace cascade::importing
