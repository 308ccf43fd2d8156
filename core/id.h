// Ids, which are numbers that identify objects of one kind, and lists that are indexed by ids. An
// id of one kind converts neither to another kind nor to a plain number.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <ranges>
#include <utility>
#include <vector>

namespace cascade {

/// `Tag` is a type that only distinguishes kinds: `using NodeId = Id<struct NodeTag>`.
template <typename Tag>
class Id {
public:
    constexpr Id() = default;
    constexpr explicit Id(std::size_t index) : index_(static_cast<std::uint32_t>(index)) {}
    constexpr std::uint32_t index() const { return index_; }
    constexpr Id& operator++() {
        ++index_;
        return *this;
    }
    friend constexpr auto operator<=>(Id, Id) = default;

private:
    std::uint32_t index_ = 0;
};

/// The ids with the numbers 0 … count − 1.
template <typename Key>
auto ids_below(std::size_t count) {
    return std::views::iota(std::size_t{0}, count) |
           std::views::transform([](std::size_t index) { return Key(index); });
}

/// A list indexed by ids.
template <typename Key, typename Value>
class IdVector : public std::vector<Value> {
public:
    using Base = std::vector<Value>;
    using Base::Base;
    explicit IdVector(Base list) : Base(std::move(list)) {}

    typename Base::reference operator[](Key id) { return Base::operator[](id.index()); }
    typename Base::const_reference operator[](Key id) const { return Base::operator[](id.index()); }
    /// The id of the next value to be added.
    Key next() const { return Key(Base::size()); }
    auto ids() const { return ids_below<Key>(Base::size()); }
    auto ids_backwards() const { return ids() | std::views::reverse; }
};

}  // namespace cascade

template <typename Tag>
struct std::hash<cascade::Id<Tag>> {
    std::size_t operator()(cascade::Id<Tag> id) const noexcept { return id.index(); }
};
