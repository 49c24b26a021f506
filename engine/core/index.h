// Typed indices: a MeshIndex cannot be used where a MaterialIndex is meant.
#pragma once

#include <cstdint>

namespace tarn {

template <class Tag>
struct Index {
    static constexpr std::uint32_t NONE = 0xffffffffu;
    std::uint32_t value = NONE;

    Index() = default;
    explicit constexpr Index(std::uint32_t v) : value(v) {}
    explicit constexpr Index(std::size_t v) : value(std::uint32_t(v)) {}
    explicit constexpr Index(int v) : value(std::uint32_t(v)) {}

    bool is_set() const { return value != NONE; }
    friend bool operator==(Index, Index) = default;
};

// table[index] for a typed index.
template <class Table, class Tag>
auto& at(Table& table, Index<Tag> index) {
    return table[index.value];
}

}  // namespace tarn
