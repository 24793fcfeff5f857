#pragma once
#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <typeindex>
#include <utility>
#include <vector>

namespace gnomon::stand_in {

enum class Entity : std::uint32_t {};

class Registry;

/// Listeners of one signal, by the object that listens.
struct Listeners {
    std::vector<std::pair<const void*, std::function<void(Registry&, Entity)>>> all;
    void tell(Registry& registry, Entity entity) const {
        for (const auto& [who, hear] : all) hear(registry, entity);
    }
};

/// What a registry hands out to connect to a signal.
class Sink {
public:
    explicit Sink(Listeners& listeners) : listeners_(&listeners) {}
    template <auto Method, class Object>
    void connect(Object& object) {
        listeners_->all.emplace_back(&object, [&object](Registry& r, Entity e) { (object.*Method)(r, e); });
    }
    void disconnect(const void* object) {
        std::erase_if(listeners_->all, [&](const auto& one) { return one.first == object; });
    }

private:
    Listeners* listeners_;
};

/// The part of EnTT's registry that EnttBridge uses: the same names, signals in the same order.
class Registry {
public:
    using entity_type = Entity;

    Entity create() {
        const Entity entity{next_++};
        alive_.insert(entity);
        return entity;
    }
    bool valid(Entity entity) const { return alive_.count(entity) != 0; }
    void destroy(Entity entity) {
        for (const auto& take : takers_) take(entity);
        alive_.erase(entity);
    }
    template <class T>
    void emplace(Entity entity, T value) {
        Pool<T>& pool = of<T>();
        pool.values[entity] = value;
        pool.constructed.tell(*this, entity);
    }
    template <class T, class Change>
    void patch(Entity entity, Change&& change) {
        change(of<T>().values.at(entity));
        of<T>().updated.tell(*this, entity);
    }
    template <class T>
    void remove(Entity entity) {
        Pool<T>& pool = of<T>();
        if (pool.values.count(entity) == 0) return;
        pool.destroyed.tell(*this, entity);  // before the value is gone, as in EnTT
        pool.values.erase(entity);
    }
    template <class T>
    T* try_get(Entity entity) {
        const auto at = of<T>().values.find(entity);
        return at == of<T>().values.end() ? nullptr : &at->second;
    }
    template <class T>
    Sink on_construct() {
        return Sink(of<T>().constructed);
    }
    template <class T>
    Sink on_update() {
        return Sink(of<T>().updated);
    }
    template <class T>
    Sink on_destroy() {
        return Sink(of<T>().destroyed);
    }

private:
    template <class T>
    struct Pool {
        std::map<Entity, T> values;
        Listeners constructed, updated, destroyed;
    };
    template <class T>
    Pool<T>& of() {
        std::shared_ptr<void>& pool = pools_[typeid(T)];
        if (!pool) {
            pool = std::make_shared<Pool<T>>();
            takers_.push_back([this](Entity e) { remove<T>(e); });
        }
        return *static_cast<Pool<T>*>(pool.get());
    }
    std::uint32_t next_ = 0;
    std::set<Entity> alive_;
    std::map<std::type_index, std::shared_ptr<void>> pools_;
    std::vector<std::function<void(Entity)>> takers_;
};

}  // namespace gnomon::stand_in
