// Groups of functions to which several rules apply.
#pragma once

#include "lang/vocabulary/functions.h"

namespace cascade {

/// Whether the function is a sum or a difference.
inline bool is_sum(Function function) {
    return function == Function::add || function == Function::subtract;
}
/// Whether the function raises its first operand to the power of its second.
inline bool is_power(Function function) { return info(function).behaviour == Behaviour::raises; }
/// Whether the function moves its last operand with a velocity.
inline bool carries(Function function) {
    return function == Function::advect || function == Function::transport;
}
/// Whether the function makes a tensor, or diffuses by the tensor of its last three operands.
inline bool has_tensor(Function function) {
    return info(function).result == ResultKind::tensor || function == Function::diffuse;
}

}  // namespace cascade
