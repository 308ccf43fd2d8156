// A table of functions. Those that are not in it are not linear.
#include "lang/program/linear_functions.h"

namespace cascade {

bool is_linear_in(const Node& call, std::size_t k) {
    const std::size_t last = call.operand_count - 1u;
    switch (call.function) {
        case Function::add:
        case Function::subtract:
        case Function::negate:
        case Function::multiply:
        case Function::vector:
        case Function::dot:
        case Function::cross:
        case Function::domain_mean:
        case Function::domain_sum:
        case Function::convolve:
        case Function::lap:
        case Function::isotropic:
        case Function::grad:
        case Function::div:
        case Function::curl:
        case Function::bordered: return true;
        case Function::divide:
        case Function::component:
        case Function::diffuse: return k == 0;
        case Function::if_: return k > 0;
        case Function::mix: return k < 2;
        case Function::advect: return k == last;
        default: return info(call.function).kind == FunctionKind::derivative;
    }
}

bool is_jointly_linear(Function function) {
    return function == Function::add || function == Function::subtract ||
           function == Function::vector || function == Function::if_ || function == Function::mix ||
           function == Function::bordered;
}

}  // namespace cascade
