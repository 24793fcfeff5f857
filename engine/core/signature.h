#pragma once
#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

namespace gnomon {

/// Hash of a sequence of 64-bit words. Each step is one-to-one in the state and in the word, and two multiplications
/// mix every bit into all others. Different sequences collide with probability 2^-64.
class Signature {
public:
    void add(std::uint64_t word) {
        value_ = std::rotl(value_ ^ word * kWordFactor, kRotation) * kStepFactor + kStepOffset;
    }
    void add(double number) { add(std::bit_cast<std::uint64_t>(number)); }
    void add(float number) { add(std::uint64_t{std::bit_cast<std::uint32_t>(number)}); }

    void add(std::span<const std::byte> bytes) {
        add(std::uint64_t{bytes.size()});
        for (std::size_t i = 0; i < bytes.size(); i += sizeof(std::uint64_t)) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + i, std::min(sizeof word, bytes.size() - i));
            add(word);
        }
    }

    /// Returns the hash of all words so far; never 0.
    std::uint64_t value() const {
        std::uint64_t v = (value_ ^ value_ >> 31) * kWordFactor;
        v = (v ^ v >> 29) * kStepFactor;
        v ^= v >> 32;
        return v == 0 ? 1 : v;
    }

private:
    // Odd constants without pattern: 2^64 over the golden ratio, and digits of pi. The rotation moves the best mixed
    // bits to where the next multiplication spreads them.
    static constexpr std::uint64_t kWordFactor = 0x9e3779b97f4a7c15ull, kStepFactor = 0x243f6a8885a308d3ull,
                                   kStepOffset = 0x13198a2e03707345ull;
    static constexpr int kRotation = 29;
    std::uint64_t value_ = kStepOffset;
};

}  // namespace gnomon
