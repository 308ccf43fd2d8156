// The module that uses libSBML (import/sbml.h).
#include "core/version.h"
#include "import/sbml.h"

#include <fmt/format.h>
#include <sbml/SBMLTypes.h>
#include <sbml/conversion/ConversionProperties.h>

#include <memory>
#include <set>

namespace cascade::importing {

namespace {

class SbmlReading {
public:
    SbmlReading(const Model& model, SbmlModel& made) : model_(model), made_(made) {}

    void read() {
        made_.name = model_.isSetName() ? model_.getName() : model_.getId();
        refuse_what_has_no_counterpart();
        for (unsigned k = 0; k < model_.getNumRules(); ++k)
            ruled_.insert(model_.getRule(k)->getVariable());
        for (unsigned k = 0; k < model_.getNumCompartments(); ++k) add(*model_.getCompartment(k));
        for (unsigned k = 0; k < model_.getNumParameters(); ++k) add(*model_.getParameter(k));
        for (unsigned k = 0; k < model_.getNumReactions(); ++k) add(*model_.getReaction(k));
        for (unsigned k = 0; k < model_.getNumRules(); ++k) add(*model_.getRule(k));
        for (unsigned k = 0; k < model_.getNumSpecies(); ++k) add(*model_.getSpecies(k));
    }

private:
    void refuse(const SBase& part, std::string why) {
        made_.problems.emplace_back(part.getLine(), std::move(why));
    }

    void refuse_what_has_no_counterpart() {
        if (model_.getNumEvents() > 0) {
            refuse(*model_.getEvent(0), "events have no counterpart in Cascade");
        }
        if (model_.isSetConversionFactor()) {
            refuse(model_, "conversion factors have no counterpart in Cascade");
        }
    }

    /// The formula of a part of the model, with a name for the time of the simulation.
    SbmlFormula formula_of(const ASTNode* math, const SBase& part) {
        if (math == nullptr) {
            refuse(part, fmt::format("{} has no formula", part.getElementName()));
            return {};
        }
        const std::unique_ptr<ASTNode> copy(math->deepCopy());
        name_time(*copy, part);
        const std::unique_ptr<char, void (*)(void*)> text(SBML_formulaToL3String(copy.get()),
                                                          std::free);
        return {text ? text.get() : "", part.getLine()};
    }

    void name_time(ASTNode& node, const SBase& part) {
        const int type = node.getType();
        if (type == AST_NAME_TIME) {
            node.setType(AST_NAME);
            node.setName("sbml_time");
        }
        if (type == AST_FUNCTION_DELAY) refuse(part, "delays have no counterpart in Cascade");
        if (type == AST_FUNCTION_RATE_OF) refuse(part, "'rateOf' has no counterpart in Cascade");
        for (unsigned k = 0; k < node.getNumChildren(); ++k) name_time(*node.getChild(k), part);
    }

    static SbmlFormula number(double value, const SBase& part) {
        return {fmt::format("{}", value), part.getLine()};
    }

    SbmlFormula start_of(const SBase& part, double usual) {
        const auto* const assigned = model_.getInitialAssignmentBySymbol(part.getId());
        if (assigned != nullptr) return formula_of(assigned->getMath(), *assigned);
        return number(usual, part);
    }

    void add(const Compartment& part) {
        if (!part.getConstant() && ruled_.contains(part.getId())) {
            return refuse(part,
                          "a compartment that changes its size has no counterpart in Cascade");
        }
        made_.constants.push_back({part.getId(), start_of(part, size_of(part))});
    }
    static double size_of(const Compartment& part) { return part.isSetSize() ? part.getSize() : 1; }

    void add(const Parameter& part) {
        const auto* const rule = model_.getRateRuleByVariable(part.getId());
        const double value = part.isSetValue() ? part.getValue() : 0;
        if (rule != nullptr) {
            made_.rates.push_back(
                {part.getId(), start_of(part, value), formula_of(rule->getMath(), *rule), {}, ""});
        } else if (!ruled_.contains(part.getId())) {
            made_.constants.push_back({part.getId(), start_of(part, value)});
        }
    }

    void add(const Reaction& part) {
        const KineticLaw* const law = part.getKineticLaw();
        if (law == nullptr) {
            return refuse(part, fmt::format("the reaction '{}' has no rate", part.getId()));
        }
        if (part.isSetFast() && part.getFast()) {
            return refuse(part, "fast reactions have no counterpart in Cascade");
        }
        made_.assignments.push_back({part.getId(), formula_of(law->getMath(), *law)});
    }

    void add(const Rule& part) {
        if (part.isAlgebraic())
            return refuse(part, "algebraic rules have no counterpart in Cascade");
        if (part.isAssignment()) {
            made_.assignments.push_back({part.getVariable(), formula_of(part.getMath(), part)});
        }
    }

    /// The value of a species is its concentration, or its amount if the model says so.
    void add(const Species& part) {
        const Compartment* const compartment = model_.getCompartment(part.getCompartment());
        const double size = compartment != nullptr ? size_of(*compartment) : 1;
        const bool is_amount = part.getHasOnlySubstanceUnits();
        double start = 0;
        if (part.isSetInitialAmount()) start = part.getInitialAmount() / (is_amount ? 1 : size);
        if (part.isSetInitialConcentration()) {
            start = part.getInitialConcentration() * (is_amount ? size : 1);
        }
        if (part.isSetConversionFactor())
            refuse(part, "conversion factors have no counterpart in Cascade");
        SbmlRate made{part.getId(),
                      start_of(part, start),
                      {},
                      {},
                      is_amount || size == 1 ? "" : part.getCompartment()};
        if (const auto* const rule = model_.getRateRuleByVariable(part.getId())) {
            made.rule = formula_of(rule->getMath(), *rule);
        } else if (ruled_.contains(part.getId())) {
            return;
        } else if (part.getConstant() || part.getBoundaryCondition()) {
            made_.constants.push_back({part.getId(), std::move(made.start)});
            return;
        }
        if (made.rule.text.empty()) add_reactions(part, made);
        made_.rates.push_back(std::move(made));
    }

    void add_reactions(const Species& species, SbmlRate& made) {
        const auto add_factor = [&](const SpeciesReference& each, double sign, double& factor) {
            if (each.getSpecies() != species.getId()) return;
            const bool varies = each.isSetStoichiometryMath() || ruled_.contains(each.getId()) ||
                                model_.getInitialAssignmentBySymbol(each.getId()) != nullptr;
            if (varies && each.isSetId()) refuse(each, "a stoichiometry must be a number");
            if (each.isSetStoichiometryMath()) refuse(each, "a stoichiometry must be a number");
            factor += sign * (each.isSetStoichiometry() ? each.getStoichiometry() : 1);
        };
        for (unsigned k = 0; k < model_.getNumReactions(); ++k) {
            const Reaction& reaction = *model_.getReaction(k);
            double factor = 0;
            for (unsigned n = 0; n < reaction.getNumReactants(); ++n) {
                add_factor(*reaction.getReactant(n), -1, factor);
            }
            for (unsigned n = 0; n < reaction.getNumProducts(); ++n) {
                add_factor(*reaction.getProduct(n), 1, factor);
            }
            if (factor != 0) made.reactions.emplace_back(factor, reaction.getId());
        }
    }

    const Model& model_;
    SbmlModel& made_;
    std::set<std::string> ruled_;
};

SbmlModel read_sbml_text(const std::string& text) {
    SbmlModel made;
    const std::unique_ptr<SBMLDocument> document(readSBMLFromString(text.c_str()));
    // Replaces calls of functions by their formulas, and makes parameters of single reactions
    // parameters of the model.
    for (const char* const option : {"expandFunctionDefinitions", "promoteLocalParameters"}) {
        if (document->getNumErrors(LIBSBML_SEV_ERROR) + document->getNumErrors(LIBSBML_SEV_FATAL) >
            0)
            break;
        ConversionProperties properties;
        properties.addOption(option, true);
        document->convert(properties);
    }
    for (unsigned k = 0; k < document->getNumErrors(); ++k) {
        const SBMLError& error = *document->getError(k);
        if (error.isError() || error.isFatal()) {
            made.problems.emplace_back(error.getLine(), error.getShortMessage());
        }
    }
    const Model* const model = document->getModel();
    if (made.problems.empty() && model == nullptr) {
        made.problems.emplace_back(0, "the file has no model");
    }
    if (made.problems.empty()) SbmlReading(*model, made).read();
    return made;
}

}  // namespace

}  // namespace cascade::importing

extern "C" __attribute__((visibility("default"))) cascade::importing::SbmlReader*
cascade_sbml_reader(std::string_view version) {
    return version == cascade::version() ? &cascade::importing::read_sbml_text : nullptr;
}
