#pragma once

#include <map>
#include <memory>
#include <utility>

namespace cubecam {

/// GPU copies of scene objects. They hold their object weakly and go, at the next sweep, when it
/// has gone: a scene knows no renderer, so it cannot tell one.
template <class Object, class Entry>
class WeakCache {
public:
    /// The entry of `object`, made by `make()` the first time.
    template <class Make>
    Entry& get(const std::shared_ptr<Object>& object, Make&& make) {
        const auto found = entries_.find(object.get());
        // An entry whose object has died may stand at the address of a new one.
        if (found != entries_.end() && !found->second.object.expired()) return found->second.entry;
        return entries_.insert_or_assign(object.get(), Held{object, make()}).first->second.entry;
    }

    Entry* find(const std::shared_ptr<Object>& object) {
        const auto found = entries_.find(object.get());
        return found == entries_.end() || found->second.object.expired() ? nullptr
                                                                         : &found->second.entry;
    }

    void sweep() {
        std::erase_if(entries_, [](const auto& item) { return item.second.object.expired(); });
    }

private:
    struct Held {
        std::weak_ptr<Object> object;
        Entry entry;
    };
    std::map<const Object*, Held> entries_;  // never walked in this order: addresses decide nothing
};

}  // namespace cubecam
