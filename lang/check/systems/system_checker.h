// Checks one `system` or `cells` block (internal to the checker).
//
// check_system.cpp collects the block's declarations, check_system_formulas.cpp checks their
// formulas, and check_cells.cpp contains the checks for blocks of cells.
#pragma once

#include "lang/check/expressions/check_expression.h"
#include "lang/check/systems/system_inheritance.h"

#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace cascade::checking {

class SystemChecker {
public:
    SystemChecker(Workspace& work, const DerivedSystem& derived, SystemId index)
        : work_(work),
          derived_(derived),
          index_(index),
          declarations_(system_declarations(work, system(), derived.statements)) {}

    void run();

private:
    struct RateStatements {
        const Declaration* assignment = nullptr;
        std::vector<const Declaration*> terms;

        bool empty() const { return assignment == nullptr && terms.empty(); }
        std::vector<const Declaration*> all() const;
    };

    System& system() { return work_.draft->systems[index_]; }
    bool is_cells() const { return derived_.from.block->is_cells; }
    Scope scope(Context context, const Declaration& declaration) const {
        Scope result;
        result.context = context;
        result.system = index_;
        result.indices = declaration.indices;
        return result;
    }

    // Declarations.
    void declare(const Declaration& declaration);
    void declare_value(const Declaration& declaration);
    bool can_declare(const Declaration& declaration);
    bool is_misspelt_text(const Declaration& declaration);
    void collect_rate(const Declaration& declaration);
    void add_statement_of_rate(RateStatements& rate, const Declaration& declaration);
    void report_rate_of_definition(const Declaration& rate);
    void report_no_species(const Declaration& declaration, const Meaning* meaning);
    void find_unknowns();
    bool find_unknown(Declaration& constraint, bool in_definitions);
    std::string_view name_read_by(const ast::Word& word) const;
    std::vector<ast::Word> names_without_values(const Declaration& constraint,
                                                bool in_definitions) const;
    void report_families();
    void report_no_rates();

    // Formulas.
    void report_type(const Declaration& declaration, const CheckedExpression& checked,
                     Context context, ValueType wanted);
    std::optional<CheckedExpression> check_value(const Declaration& declaration, Context context,
                                                 ValueType type = ValueType::number);
    Formula sum_of(const RateStatements& rate, ValueType type = ValueType::number);
    void check_values();
    void check_definitions();
    void check_rates();
    void check_invariants();
    void check_settings();

    // For cells.
    void add_cell_quantities();
    bool declare_of_cells(const Declaration& declaration);
    bool can_declare_in_cells(const Declaration& declaration);
    bool collect_rate_of_cells(const Declaration& declaration);
    void check_rates_of_cells();
    void check_rules_of_cells();
    void check_rule(std::string_view name, Formula& rule, Context context, ValueType type,
                    bool may_draw);
    void find_near();

    Workspace& work_;
    const DerivedSystem& derived_;
    SystemId index_;
    std::vector<Declaration> declarations_;
    std::unordered_map<std::string, Span> declared_;
    // The declaration of each item and of each definition. Null for those that every cell has
    // without a declaration.
    IdVector<ItemId, const Declaration*> values_;
    IdVector<DefinitionId, const Declaration*> definitions_;
    std::vector<const Declaration*> invariants_, settings_;
    std::vector<const Declaration*> rate_statements_;
    IdVector<ItemId, RateStatements> rates_;
    // For blocks of cells.
    RateStatements velocity_, spin_;
    /// The declarations of divide, die, …, by name.
    std::map<std::string, const Declaration*, std::less<>> rules_;
    std::vector<const Declaration*> restarts_;
};

}  // namespace cascade::checking
