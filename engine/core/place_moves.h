#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Lists in which values come and go, and all others keep their order: only those between the changes move.
namespace gnomon {

/// Neighbouring values that a splice moves from one place to another.
struct PlaceMove {
    std::uint32_t from = 0, to = 0, count = 0;
};

/// Fills `moves` with what moves in a list of `count` values, by rising place. `removed`: places before, rising.
/// `added`: places after, rising and below the new number.
inline void list_moves(std::uint32_t count, std::span<const std::uint32_t> removed,
                       std::span<const std::uint32_t> added, std::vector<PlaceMove>& moves) {
    moves.clear();
    std::size_t gone = 0, came = 0;
    for (std::uint32_t from = 0, to = 0; from < count;) {
        if (gone < removed.size() && removed[gone] == from) {
            ++gone;
            ++from;
            continue;
        }
        for (; came < added.size() && added[came] == to; ++came) ++to;
        std::uint32_t kept = (gone < removed.size() ? removed[gone] : count) - from;
        if (came < added.size()) kept = std::min(kept, added[came] - to);
        if (from != to) moves.push_back({from, to, kept});
        from += kept;
        to += kept;
    }
}

/// Moves values as list_moves() listed, and resizes to `count`. Added places keep any value, to be written next.
template <class Value>
void apply_moves(std::span<const PlaceMove> moves, std::size_t count, std::vector<Value>& values) {
    values.resize(std::max(values.size(), count));
    const auto at = [&](std::size_t place) { return values.begin() + static_cast<std::ptrdiff_t>(place); };
    // Values keep their order, so that no move to the front writes where a move to the back has yet to read.
    for (const PlaceMove& move : moves)
        if (move.to < move.from) std::move(at(move.from), at(move.from + move.count), at(move.to));
    for (std::size_t left = moves.size(); left > 0; --left) {
        const PlaceMove& move = moves[left - 1];
        if (move.to > move.from)
            std::move_backward(at(move.from), at(move.from + move.count), at(move.to + move.count));
    }
    values.resize(count);
}

}  // namespace gnomon
