#pragma once
#include <cstdint>
#include <functional>

namespace gnomon::ecs {

/// An opaque, versioned entity id. A destroyed id never compares equal to a living one:
/// its index may be reused, its version is not.
struct Entity {
    std::uint32_t index = 0xffffffffu;
    std::uint32_t version = 0;
    bool operator==(const Entity&) const = default;
};

/// The id of no entity. Never alive.
inline constexpr Entity kNull{};

}  // namespace gnomon::ecs

template <>
struct std::hash<gnomon::ecs::Entity> {
    std::size_t operator()(const gnomon::ecs::Entity& e) const noexcept {
        return std::hash<std::uint64_t>{}(std::uint64_t{e.version} << 32 | e.index);
    }
};
