#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstring>
#include <type_traits>
#include <vector>

namespace cubecam {

/// All values on which a picture depends, one after the other. Two pictures with equal keys are
/// equal, so the second is not drawn. Keys are compared byte by byte and never by a hash: a
/// collision would give a wrong picture.
class Key {
public:
    /// Adds a number, an enum, or a vector or matrix of GLM: these types have no padding, so equal
    /// values have equal bytes.
    template <class Value>
    void add(const Value& value) {
        static_assert(std::is_trivially_copyable_v<Value> && !std::is_pointer_v<Value>);
        static_assert(std::is_arithmetic_v<Value> || std::is_enum_v<Value> ||
                      requires { typename Value::value_type; });
        const auto at = bytes_.size();
        bytes_.resize(at + sizeof(Value));
        std::memcpy(bytes_.data() + at, &value, sizeof(Value));
    }

    void add(const Key& other) {
        bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end());
    }

    bool operator==(const Key&) const = default;

private:
    std::vector<std::byte> bytes_;
};

}  // namespace cubecam
