#pragma once
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace gnomon::oracle {

/// Answers to a fixed number of yes-or-no questions, each found at its first use. Any number of threads may use them.
class Answers {
public:
    explicit Answers(std::size_t count) : known_(count) {}
    template <class Find>
    bool get(std::size_t question, const Find& find) {
        constexpr std::uint8_t kUnknown = 0, kNo = 1, kYes = 2;
        std::atomic<std::uint8_t>& known = known_[question];
        std::uint8_t answer = known.load(std::memory_order_relaxed);
        if (answer == kUnknown) known.store(answer = find() ? kYes : kNo, std::memory_order_relaxed);
        return answer == kYes;
    }

private:
    std::vector<std::atomic<std::uint8_t>> known_;
};

}  // namespace gnomon::oracle
