#pragma once
#include <algorithm>
#include <cassert>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "gnomon/components.h"

/// Entity registry with sparse sets, versioned ids, views and change lists.
namespace gnomon::ecs {

/// What happened to a component of an entity.
enum class ChangeKind : std::uint8_t { added, changed, removed };

/// Entry of a component type's log.
struct Change {
    Entity entity;                          // may be dead by now
    ChangeKind kind = ChangeKind::changed;  // what happened
    bool operator==(const Change&) const = default;
};

/// Position of a reader in a component type's log, one per reader and type. A default cursor has read nothing.
struct ChangeCursor {
    std::uint64_t next = 0;  // sequence number of the first entry that is not yet read
};

/// Minimum length of a log. A log keeps the newest entries, as many as there are components of its type or this many.
inline constexpr std::size_t kLeastKept = 256;

/// Entries since the reader's cursor. `complete` is false if older entries are already dropped. The reader must then
/// look at every component again, which is no more than it missed.
struct Changes {
    std::span<const Change> entries;  // oldest first
    bool complete = true;             // false: older entries are gone
};

namespace detail {

class StorageBase {
public:
    virtual ~StorageBase() = default;
    virtual void erase(Entity e) = 0;

    bool contains(Entity e) const {
        return e.index < sparse_.size() && sparse_[e.index] != kAbsent && entities_[sparse_[e.index]] == e;
    }
    const std::vector<Entity>& entities() const { return entities_; }

    /// Appends an entry. Capacity grows with the number of components only: once they exist, changes do not allocate.
    void log(Entity e, ChangeKind kind) {
        const std::size_t kept = std::max(kLeastKept, entities_.size());
        if (log_.capacity() < 2 * kept) log_.reserve(std::max(2 * kept, 2 * log_.capacity()));
        if (log_.size() == log_.capacity()) drop(log_.size() - kept);
        log_.push_back({e, kind});
    }
    Changes since(ChangeCursor& cursor) const {
        const std::uint64_t end = first_ + log_.size();
        const bool complete = cursor.next >= first_;
        const std::uint64_t from = std::clamp(cursor.next, first_, end);
        cursor.next = end;
        return {std::span(log_).subspan(static_cast<std::size_t>(from - first_)), complete};
    }
    void discard_log() { drop(log_.size()); }

protected:
    static constexpr std::uint32_t kAbsent = 0xffffffffu;
    std::vector<std::uint32_t> sparse_;  // dense position by entity index
    std::vector<Entity> entities_;       // dense, in storage order

private:
    void drop(std::size_t oldest) {
        log_.erase(log_.begin(), log_.begin() + static_cast<std::ptrdiff_t>(oldest));
        first_ += oldest;
    }
    std::vector<Change> log_;
    std::uint64_t first_ = 0;  // sequence number of log_[0]
};

template <class T>
class Storage final : public StorageBase {
public:
    T& emplace(Entity e, T value) {
        if (contains(e)) {
            T& old = values_[sparse_[e.index]];
            old = std::move(value);
            log(e, ChangeKind::changed);
            return old;
        }
        if (e.index >= sparse_.size()) sparse_.resize(e.index + 1u, kAbsent);
        sparse_[e.index] = static_cast<std::uint32_t>(entities_.size());
        entities_.push_back(e);
        values_.push_back(std::move(value));
        log(e, ChangeKind::added);
        return values_.back();
    }
    T& at(Entity e) { return values_[sparse_[e.index]]; }
    const T& at(Entity e) const { return values_[sparse_[e.index]]; }

    void erase(Entity e) override {
        if (!contains(e)) return;
        const std::uint32_t hole = sparse_[e.index];
        const std::uint32_t last = static_cast<std::uint32_t>(entities_.size()) - 1u;
        if (hole != last) {
            entities_[hole] = entities_[last];
            values_[hole] = std::move(values_[last]);
            sparse_[entities_[hole].index] = hole;
        }
        entities_.pop_back();
        values_.pop_back();
        sparse_[e.index] = kAbsent;
        log(e, ChangeKind::removed);
    }

private:
    std::vector<T> values_;
};

inline std::uint32_t next_type_number() {
    static std::uint32_t next = 0;  // numbers component types; no state of any registry
    return next++;
}
template <class T>
std::uint32_t type_number() {
    static const std::uint32_t number = next_type_number();
    return number;
}

}  // namespace detail

/// Owns entities and their components. Not thread-safe. Component references stay valid until a component of the same
/// type is added or removed. Null or dead entities are a programmer error (assert), except where stated.
class Registry {
public:
    /// Makes an entity without components.
    Entity create() {
        if (!free_.empty()) {
            const std::uint32_t index = free_.back();
            free_.pop_back();
            return {index, versions_[index]};
        }
        versions_.push_back(0);
        return {static_cast<std::uint32_t>(versions_.size()) - 1u, 0};
    }

    /// Removes every component and logs each removal. Does nothing for a dead entity.
    void destroy(Entity e) {
        if (!alive(e)) return;
        for (auto& storage : storages_)
            if (storage) storage->erase(e);
        ++versions_[e.index];
        free_.push_back(e.index);
    }

    /// Returns whether the entity exists.
    bool alive(Entity e) const { return e.index < versions_.size() && versions_[e.index] == e.version; }
    /// Returns the number of entities that exist.
    std::size_t alive_count() const { return versions_.size() - free_.size(); }

    /// Adds the component, or replaces it and logs a change.
    template <class T>
    T& emplace(Entity e, T value = {}) {
        assert(alive(e));
        return storage<T>().emplace(e, std::move(value));
    }

    /// Returns whether the entity is alive and has a T.
    template <class T>
    bool has(Entity e) const {
        const auto* s = find<T>();
        return s && s->contains(e);
    }

    /// Returns nullptr if the entity is dead or has no T. Use patch() to write.
    template <class T>
    const T* get(Entity e) const {
        const auto* s = find<T>();
        return s && s->contains(e) ? &s->at(e) : nullptr;
    }

    /// Calls edit(T&) and logs a change. Returns false if the entity has no T.
    template <class T, class Edit>
    bool patch(Entity e, Edit&& edit) {
        auto& s = storage<T>();
        if (!s.contains(e)) return false;
        std::forward<Edit>(edit)(s.at(e));
        s.log(e, ChangeKind::changed);
        return true;
    }

    /// Removes the component. Returns true if the entity had one.
    template <class T>
    bool remove(Entity e) {
        auto& s = storage<T>();
        if (!s.contains(e)) return false;
        s.erase(e);
        return true;
    }

    /// Calls visit(Entity, const T&, const Rest&...) for each entity that has them all, in the order of T's storage.
    /// `visit` must not add or remove components of these types.
    template <class T, class... Rest, class Visit>
    void each(Visit&& visit) const {
        const auto* first = find<T>();
        if (!first) return;
        for (const Entity e : first->entities()) {
            if ((has<Rest>(e) && ...)) visit(e, first->at(e), *get<Rest>(e)...);
        }
    }

    /// Returns the entities with a T, in storage order: order of addition, disturbed by removal.
    template <class T>
    std::span<const Entity> entities_with() const {
        const auto* s = find<T>();
        return s ? std::span<const Entity>(s->entities()) : std::span<const Entity>{};
    }

    /// Returns the entries of T's log since `cursor` and moves it to the end. The span is valid until the next change
    /// of a T. Readers are independent: each has its own cursor.
    template <class T>
    Changes changes(ChangeCursor& cursor) {
        return storage<T>().since(cursor);
    }

    /// Drops all logs. Readers that have not caught up get `complete == false`. Optional, because logs are bounded.
    void discard_changes() {
        for (auto& storage : storages_)
            if (storage) storage->discard_log();
    }

private:
    template <class T>
    detail::Storage<T>& storage() {
        const std::uint32_t n = detail::type_number<T>();
        if (n >= storages_.size()) storages_.resize(n + 1u);
        if (!storages_[n]) storages_[n] = std::make_unique<detail::Storage<T>>();
        return static_cast<detail::Storage<T>&>(*storages_[n]);
    }
    template <class T>
    const detail::Storage<T>* find() const {
        const std::uint32_t n = detail::type_number<T>();
        return n < storages_.size() ? static_cast<const detail::Storage<T>*>(storages_[n].get()) : nullptr;
    }

    std::vector<std::uint32_t> versions_;
    std::vector<std::uint32_t> free_;
    std::vector<std::unique_ptr<detail::StorageBase>> storages_;
};

}  // namespace gnomon::ecs
