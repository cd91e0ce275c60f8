/// The names of a picture's sampling.
#pragma once

#include "choice.hpp"

#include "cubecam/cubemap/cubemap_resample.hpp"

#include <cstddef>
#include <string>
#include <string_view>

namespace cubecam::bindings {

inline constexpr NameTable<Sampling, 2> sampling_names{
    {{"centers", Sampling::centers}, {"borders", Sampling::borders}}};
using SamplingName = Choice<sampling_names>;

inline Sampling parse_sampling(std::string_view name) {
    const std::size_t place = place_of_name(sampling_names, name);
    if (place < sampling_names.size()) return sampling_names[place].second;
    throw py::value_error("sampling: expected " + quoted_names(sampling_names) + ", got '" +
                          shortened(name) + "'");
}

}  // namespace cubecam::bindings
