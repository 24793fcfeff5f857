#pragma once
#include <cstdint>
#include <optional>
#include <vector>

namespace gnomon::embed {

/// Values by handle: an index that is used again, and a version that is not. Id: a gnomon::Handle.
template <class Id, class T>
class Slots {
public:
    Id add(T value) {
        if (free_.empty()) {
            slots_.emplace_back();
            free_.push_back(static_cast<std::uint32_t>(slots_.size() - 1));
        }
        const std::uint32_t index = free_.back();
        free_.pop_back();
        slots_[index].value = std::move(value);
        return {index, slots_[index].version};
    }
    /// Removes a value. Returns false if the handle names none.
    bool remove(Id id) {
        if (!find(id)) return false;
        slots_[id.index].value.reset();
        ++slots_[id.index].version;
        free_.push_back(id.index);
        return true;
    }
    T* find(Id id) {
        const bool is = id.index < slots_.size() && slots_[id.index].version == id.version && slots_[id.index].value;
        return is ? &*slots_[id.index].value : nullptr;
    }
    const T* find(Id id) const { return const_cast<Slots*>(this)->find(id); }

    /// Calls visit(id, value) for each, by rising index.
    template <class Visit>
    void each(Visit&& visit) {
        for (std::uint32_t i = 0; i < slots_.size(); ++i)
            if (slots_[i].value) visit(Id{i, slots_[i].version}, *slots_[i].value);
    }
    /// Returns one more than the largest index that was ever used.
    std::uint32_t bound() const { return static_cast<std::uint32_t>(slots_.size()); }

private:
    struct Slot {
        std::optional<T> value;
        std::uint32_t version = 1;
    };
    std::vector<Slot> slots_;
    std::vector<std::uint32_t> free_;
};

}  // namespace gnomon::embed
