// Combines several functions into one: `std::visit(Overloaded{[](int) {…}, [](Text) {…}},
// variant)`.
#pragma once

namespace cascade {

template <typename... Cases>
struct Overloaded : Cases... {
    using Cases::operator()...;
};
template <typename... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

}  // namespace cascade
