#pragma once
#include <cstdint>

namespace gnomon {

/// Device memory that only saves time: whoever needs the room for a picture may have it given back, at any time.
class SpareMemory {
public:
    virtual std::uint64_t bytes() const = 0;
    /// All of it, at once; what is submitted already may still read it.
    virtual void release() = 0;

protected:
    ~SpareMemory() = default;
};

}  // namespace gnomon
