#pragma once

#include <map>
#include <memory>
#include <utility>

namespace cubecam {

/// A cache of GPU copies of scene objects. An entry does not keep its object alive; the next sweep
/// drops the entries of destroyed objects, since a scene does not know its renderers and cannot
/// notify them.
template <class Object, class Entry>
class WeakCache {
public:
    /// The entry of `object`, made by `make()` the first time.
    template <class Make>
    Entry& get(const std::shared_ptr<Object>& object, Make&& make) {
        const auto found = entries_.find(object.get());
        // The object of an entry may be destroyed, and a new object may have its address.
        if (found != entries_.end() && !found->second.object.expired()) return found->second.entry;
        return entries_.insert_or_assign(object.get(), Held{object, make()}).first->second.entry;
    }

    Entry* find(const std::shared_ptr<Object>& object) {
        const auto found = entries_.find(object.get());
        return found == entries_.end() || found->second.object.expired() ? nullptr
                                                                         : &found->second.entry;
    }

    /// Takes over the objects of another cache; `remake` makes this cache's entry from the old one.
    template <class Remake>
    void take_over(const WeakCache& old, Remake&& remake) {
        for (const auto& [address, held] : old.entries_) {
            entries_.insert_or_assign(address, Held{held.object, remake(held.entry)});
        }
    }

    void sweep() {
        std::erase_if(entries_, [](const auto& item) { return item.second.object.expired(); });
    }

private:
    struct Held {
        std::weak_ptr<Object> object;
        Entry entry;
    };
    std::map<const Object*, Held> entries_;  // no result depends on the order of addresses
};

}  // namespace cubecam
