// Takes the steps of a scheme with plain vectors in double precision. It computes the scheme's
// forms a second time, so that integrators are tested without kernels.
#pragma once

#include "solvers/etd_stages.h"
#include "solvers/scheme.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

namespace cascade::test {

/// One entry for each species, each a vector of cells.
using PlainState = std::vector<std::vector<double>>;
using PlainRates = std::function<PlainState(const PlainState& state, double t)>;
/// The Jacobian of a cell: the derivatives of its rates by its values.
using PlainMatrix = std::vector<std::vector<double>>;
using PlainJacobian = std::function<PlainMatrix(const std::vector<double>& cell, double t)>;

/// u' = v cos t, v' = −u cos t, whose solution turns on a circle by the angle sin t. Stages
/// evaluate these rates at different times.
inline PlainState swing(const PlainState& state, double t) {
    return {{state[1][0] * std::cos(t)}, {-state[0][0] * std::cos(t)}};
}

class SchemeRunner {
public:
    SchemeRunner(Scheme scheme, PlainRates rates, PlainState start, double speed = 0)
        : scheme_(std::move(scheme)), rates_(std::move(rates)), speed_(speed) {
        registers_.assign(scheme_.registers,
                          PlainState(start.size(), std::vector<double>(start[0].size())));
        registers_[old_register] = std::move(start);
    }

    /// Sets the Jacobian for solvers that solve equations. Without it, their matrix is 1.
    void set_jacobian(PlainJacobian jacobian) { jacobian_ = std::move(jacobian); }

    /// Computes a step without taking it. accept() takes it.
    void attempt(double step) {
        const bool has_first_rate = scheme_.rate_registers && knows_first_rate_;
        for (std::size_t k = has_first_rate ? 1 : 0; k < scheme_.sweeps.size(); ++k) {
            run(scheme_.sweeps[k], step);
        }
        step_ = step;
        knows_first_rate_ = true;
    }
    void accept() {
        registers_[old_register] = registers_[new_register];
        if (const auto& rates = scheme_.rate_registers) {
            std::swap(registers_[rates->first], registers_[rates->last]);
        }
        time_ += step_;
    }
    /// Evaluates the first rate of each step anew.
    void forget_first_rate() { knows_first_rate_ = false; }
    int evaluations() const { return evaluations_; }
    void step(double step) {
        attempt(step);
        accept();
    }

    const PlainState& state() const { return registers_[old_register]; }
    const PlainState& attempted() const { return registers_[new_register]; }
    const PlainState& error() const { return registers_[*scheme_.error_register]; }
    double time() const { return time_; }

private:
    /// Filters rates as if each cell were a wave without diffusion.
    void filter(const SweepFilter& filter) {
        if (filter.kept.empty()) return;
        for (std::size_t s = 0; s < registers_[filter.in_register].size(); ++s) {
            std::vector<double>& rates = registers_[filter.in_register][s];
            const double none = 0;
            std::vector<double*> waves{rates.data()};
            if (filter.error) waves.push_back(registers_[*filter.error][s].data());
            EtdMemory<double> memory;
            for (std::size_t k = 0; k < memory.size(); ++k) {
                memory[k] = registers_[filter.kept[k]][s].data();
            }
            std::vector<double> damping;
            for (std::size_t cell = 0; cell < rates.size(); ++cell) {
                WaveBlock<double> block;
                block.lines = block.count = 1;
                for (const double*& differences : block.differences) differences = &none;
                block.waves = waves;
                take_etd_stage(block, {}, filter.response, memory, damping);
                for (double*& at : waves) ++at;
                for (double*& at : memory) ++at;
            }
        }
    }

    /// Solves matrix · x = right by elimination without pivots.
    static std::vector<double> solved(PlainMatrix matrix, std::vector<double> right) {
        const std::size_t n = right.size();
        for (std::size_t k = 0; k < n; ++k) {
            for (std::size_t i = 0; i < n; ++i) {
                if (i == k) continue;
                const double factor = matrix[i][k] / matrix[k][k];
                for (std::size_t j = k; j < n; ++j) matrix[i][j] -= factor * matrix[k][j];
                right[i] -= factor * right[k];
            }
        }
        for (std::size_t k = 0; k < n; ++k) right[k] /= matrix[k][k];
        return right;
    }

    void run(const Sweep& sweep, double step) {
        const SweepForm& form = scheme_.forms[sweep.form];
        if (sweep.filter) filter(*sweep.filter);
        PlainState evaluated = registers_[sweep.inputs[0]];
        for (std::uint32_t s = 0; s < sweep.renewed; ++s) {
            evaluated[s] = registers_[new_register][s];
        }
        PlainState rates = evaluated;
        if (form.uses_rates()) {
            rates = rates_(evaluated, time_ + sweep.time * step);
            ++evaluations_;
        }
        std::vector<PlainState> inputs;
        for (const RegisterId input : sweep.inputs) inputs.push_back(registers_[input]);
        std::vector<std::size_t> species;
        for (const SpeciesId id : form.species) species.push_back(id.index());
        if (species.empty()) {
            for (std::size_t s = 0; s < rates.size(); ++s) species.push_back(s);
        }
        const auto coefficient = [&](std::uint32_t number) {
            const auto& [value, times_step] = sweep.coefficients[number];
            return value * (times_step ? step : 1);
        };
        PlainState solution = rates;
        const auto sum_of = [&](const std::vector<SweepTerm>& terms, std::size_t s,
                                std::size_t cell) {
            double sum = 0;
            for (const SweepTerm& term : terms) {
                double value = rates[s][cell];
                if (term.source == SweepTerm::Source::solution) {
                    value = solution[s][cell];
                } else if (term.source != SweepTerm::Source::rate) {
                    value = inputs[term.input][s][cell];
                }
                if (term.source == SweepTerm::Source::difference) {
                    value -= inputs[form.base_input][s][cell];
                }
                if (term.weight == SweepTerm::Weight::speed) value *= speed_;
                if (term.weight == SweepTerm::Weight::coefficient) {
                    value *= coefficient(term.coefficient);
                }
                sum += value;
            }
            return sum;
        };
        for (std::size_t cell = 0; form.equations && cell < rates[0].size(); ++cell) {
            const std::size_t n = rates.size();
            std::vector<double> values, right;
            for (std::size_t s = 0; s < n; ++s) {
                values.push_back(evaluated[s][cell]);
                right.push_back(sum_of(form.equations->terms, s, cell));
            }
            PlainMatrix matrix(n, std::vector<double>(n, 0));
            if (jacobian_) matrix = jacobian_(values, time_ + sweep.time * step);
            for (std::size_t i = 0; i < n; ++i) {
                for (std::size_t j = 0; j < n; ++j) {
                    matrix[i][j] *= -coefficient(form.equations->coefficient);
                }
                matrix[i][i] += 1;
            }
            right = solved(std::move(matrix), std::move(right));
            for (std::size_t s = 0; s < n; ++s) solution[s][cell] = right[s];
        }
        for (std::size_t o = 0; o < form.outputs.size(); ++o) {
            for (const std::size_t s : species) {
                for (std::size_t cell = 0; cell < rates[s].size(); ++cell) {
                    registers_[sweep.outputs[o]][s][cell] = sum_of(form.outputs[o].terms, s, cell);
                }
            }
        }
    }

    Scheme scheme_;
    PlainRates rates_;
    PlainJacobian jacobian_;
    double speed_;
    IdVector<RegisterId, PlainState> registers_;
    double time_ = 0, step_ = 0;
    bool knows_first_rate_ = false;
    int evaluations_ = 0;
};

}  // namespace cascade::test
