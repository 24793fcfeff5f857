#pragma once
#include <cstdint>

namespace gnomon {

/// Device memory that only saves time, so that it can be freed at any moment for a picture that needs the room.
class SpareMemory {
public:
    virtual std::uint64_t bytes() const = 0;
    /// Returns the bytes that it would take, were there room for all.
    virtual std::uint64_t wanted_bytes() const = 0;
    /// Frees all of it at once; submitted work may still read it.
    virtual void release() = 0;

protected:
    ~SpareMemory() = default;
};

}  // namespace gnomon
