/// Functions that define the Python class of a kind of material: its __init__ and its properties
/// follow from the fields of the kind.
#pragma once

#include "choice.hpp"
#include "cube_source.hpp"
#include "map_source.hpp"
#include "objects.hpp"
#include "placed_map.hpp"
#include "shader_inputs.hpp"
#include "surface_options.hpp"
#include "values.hpp"
#include "vectors.hpp"

#include "cubecam/materials/material.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

namespace cubecam::bindings {

/// The conversion of a parameter from Python and back, by its type. `Given` is the type that a
/// caller passes, `to` checks and converts it, `from` gives the value of a property, and `initial`
/// gives the default that a signature shows.
template <class Value>
struct Conversion {
    static_assert(
        sizeof(Value) == 0,
        "expected a field of the type glm::vec4 or glm::vec3 (a colour), float, int, bool, "
        "std::optional<float>, MapSource, PlacedMap, CubeSource or UserSource; another "
        "type needs a Conversion in cpp/bindings/material_kind.hpp");
};

template <>
struct Conversion<glm::vec4> {
    using Given = ColorLike;
    static glm::vec4 to(const Given& value, const char* name) { return to_rgba(value, name); }
    static py::array_t<float> from(const glm::vec4& value) { return color_array(value); }
    /// A tuple such as (1, 1, 1): whole numbers are ints, and an alpha of 1 is left out.
    static py::object initial(const glm::vec4& value) {
        py::list numbers;
        for (int i = 0; i < (value.a == 1.0F ? 3 : 4); ++i) {
            const double number = shortest(value[i]);
            if (number == static_cast<double>(static_cast<int>(number))) {
                numbers.append(static_cast<int>(number));
            } else {
                numbers.append(number);
            }
        }
        return py::tuple(numbers);
    }
};

template <>
struct Conversion<float> {
    using Given = Strict<float>;
    static float to(const Given& value, const char*) { return value; }
    static double from(float value) { return shortest(value); }
    static py::object initial(float value) { return py::float_(shortest(value)); }
};

template <>
struct Conversion<bool> {
    using Given = Flag;
    static bool to(const Given& value, const char*) { return value; }
    static bool from(bool value) { return value; }
    static py::object initial(bool value) { return py::bool_(value); }
};

template <>
struct Conversion<std::optional<float>> {
    using Given = Argument<std::optional<float>>;
    static std::optional<float> to(const Given& value, const char*) { return value; }
    static std::optional<double> from(std::optional<float> value) {
        return value ? std::optional(shortest(*value)) : std::nullopt;
    }
    static py::object initial(std::optional<float> value) { return py::cast(from(value)); }
};

template <>
struct Conversion<glm::vec3> {
    using Given = ColorLike;
    static glm::vec3 to(const Given& value, const char* name) { return to_rgb(value, name); }
    static py::array_t<float> from(const glm::vec3& value) { return color_array(value); }
    static py::object initial(const glm::vec3& value) {
        return Conversion<glm::vec4>::initial(glm::vec4(value, 1.0F));
    }
};

template <>
struct Conversion<int> {
    using Given = Int;
    static int to(const Given& value, const char*) { return value; }
    static int from(int value) { return value; }
    static py::object initial(int value) { return py::int_(value); }
};

/// A choice among the names of a table.
template <class Value, const auto& table>
struct ChoiceConversion {
    using Given = Choice<table>;
    static Value to(const Given& value, const char* name) { return parse_name(name, value, table); }
    static Given from(Value value) {
        return Given(name_of(table[static_cast<std::size_t>(value)]));
    }
    static py::object initial(Value value) { return py::cast(from(value)); }
};

/// The same, or None.
template <class Value, const auto& table>
struct OptionalChoiceConversion {
    using Given = std::optional<Choice<table>>;
    static std::optional<Value> to(const Given& value, const char* name) {
        if (!value) return std::nullopt;
        return parse_name(name, std::string_view(*value), table);
    }
    static Given from(std::optional<Value> value) {
        if (!value) return std::nullopt;
        return Choice<table>(name_of(table[static_cast<std::size_t>(*value)]));
    }
    static py::object initial(std::optional<Value> value) { return py::cast(from(value)); }
};

template <>
struct Conversion<std::optional<AlphaMode>>
    : OptionalChoiceConversion<AlphaMode, alpha_mode_names> {};

template <>
struct Conversion<MapSource> {
    using Given = MapLike;
    static MapSource to(const Given& value, const char* name) { return to_map_source(value, name); }
    static MapNow from(const MapSource& value) { return from_map_source(value); }
    static py::object initial(const MapSource&) { return py::none(); }
};

template <>
struct Conversion<PlacedMap> {
    using Given = PlacedMapLike;
    static PlacedMap to(const Given& value, const char* name) { return to_placed_map(value, name); }
    static PlacedMapNow from(const PlacedMap& value) { return from_placed_map(value); }
    static py::object initial(const PlacedMap&) { return py::none(); }
};

template <>
struct Conversion<CubeSource> {
    using Given = CubeLike;
    static CubeSource to(const Given& value, const char* name) {
        return to_cube_source(value, name);
    }
    static CubeLike from(const CubeSource& value) { return from_cube_source(value); }
    static py::object initial(const CubeSource&) { return py::none(); }
};

template <>
struct Conversion<UserSource> {
    using Given = SourceLike;
    static UserSource to(const Given& value, const char* name) {
        return to_user_source(value, name);
    }
    static std::optional<std::string> from(const UserSource& value) {
        return value.text.empty() ? std::nullopt : std::optional(value.text);
    }
    static py::object initial(const UserSource&) { return py::none(); }
};

template <class Kind>
using MaterialClass = Class<MaterialOf<Kind>, Material>;

template <class Kind, class Value>
void def_field(MaterialClass<Kind>& made, const Field<Kind, Value>& field) {
    using Convert = Conversion<Value>;
    made.def_property(
        field.name,
        [field](const MaterialOf<Kind>& self) { return Convert::from(self.kind().*field.member); },
        [field](MaterialOf<Kind>& self, const typename Convert::Given& given) {
            const Value value = Convert::to(given, field.name);
            self.edit_kind([&](Kind& kind) { kind.*field.member = value; });
        },
        field.doc);
}

/// Defines the __init__ of a kind whose parameters are its fields.
template <class Kind, std::size_t... index>
void def_fields_init(MaterialClass<Kind>& made, std::index_sequence<index...>) {
    const Kind initial;
    constexpr auto make =
        +[](const typename Conversion<kinds::FieldType<Kind, index>>::Given&... given) {
            return Kind{Conversion<kinds::FieldType<Kind, index>>::to(
                given, std::get<index>(Kind::fields).name)...};
        };
    def_init(made, make, py::kw_only(),
             (py::arg(std::get<index>(Kind::fields).name) =
                  Conversion<kinds::FieldType<Kind, index>>::initial(
                      initial.*std::get<index>(Kind::fields).member))...);
}

/// Defines the Python class of a kind: its name, __init__ and a property for each field. Pickling,
/// __repr__ and the surface options are those of cubecam.Material.
template <MaterialKind Kind>
MaterialClass<Kind> bind_material_kind(py::module_& module, const char* doc) {
    auto made = declare<MaterialOf<Kind>, Material>(module, Kind::name, doc);
    def_fields_init(made, std::make_index_sequence<kinds::field_count<Kind>>());
    for_each_field<Kind>([&made](const auto& field) { def_field(made, field); });
    return made;
}

/// Registers the binding of a material when the module is loaded. Each binding file of a material
/// has an object of this class; `bind_material` calls the bindings in the order of their names.
class MaterialBinding {
public:
    using Bind = void (*)(py::module_& module);

    MaterialBinding(const char* name, Bind bind) { all().emplace_back(name, bind); }

    static std::vector<std::pair<std::string, Bind>>& all();
};

}  // namespace cubecam::bindings
