#include "cubecam/gl/device_choice.hpp"

#include "cubecam/core/error.hpp"
#include "cubecam/gl/device_probe.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>
#include <stdexcept>

namespace cubecam::gl {

namespace {

std::string lower_case(std::string text) {
    for (char& c : text) {
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    }
    return text;
}

std::optional<int> to_index(const std::string& text) {
    int value = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || stop != end || value < 0) return std::nullopt;
    return value;
}

std::string list_in_words(const std::vector<DeviceInfo>& devices) {
    if (devices.empty()) {
        std::string problem;
        egl::query_devices(&problem);
        return "EGL lists no device (" + problem + ")";
    }
    std::string text = "there are: ";
    for (const DeviceInfo& device : devices) {
        if (&device != &devices.front()) text += "; ";
        text += describe(device);
    }
    return text;
}

/// Adds the candidates of "auto", "gpu" and "software", filtered and sorted by what EGL reports
/// about a device before its driver starts.
void add_by_kind(CandidateList& list) {
    std::string problem;
    const std::vector<egl::Device> devices = egl::query_devices(&problem);
    if (!problem.empty()) list.attempts.push_back("devices: " + problem);
    for (std::size_t i = 0; i < devices.size(); ++i) {
        DeviceInfo info = probe_extensions(devices[i], static_cast<int>(i));
        const bool wanted =
            list.kind == DeviceKind::any || info.software == (list.kind == DeviceKind::software);
        if (wanted) list.candidates.push_back({egl::Platform::device, devices[i], std::move(info)});
    }
    if (!devices.empty() && list.candidates.empty()) {
        const char* wanted = list.kind == DeviceKind::gpu ? "a GPU" : "a software device";
        list.attempts.push_back(std::string("devices: none is ") + wanted + "; " +
                                list_in_words(list_devices()));
    }
    std::stable_sort(
        list.candidates.begin(), list.candidates.end(),
        [](const Candidate& a, const Candidate& b) { return a.info.software < b.info.software; });
    for (const egl::Platform platform : {egl::Platform::surfaceless, egl::Platform::fallback}) {
        Candidate candidate;
        candidate.platform = platform;
        candidate.info.platform = egl::platform_name(platform);
        list.candidates.push_back(std::move(candidate));
    }
}

void add_by_index(CandidateList& list, int index) {
    const std::vector<egl::Device> devices = egl::query_devices();
    if (index < 0 || index >= static_cast<int>(devices.size())) {
        const std::string range =
            devices.empty() ? "" : "expected 0 to " + std::to_string(devices.size() - 1) + "; ";
        throw ContextError("no " + list.choice + ": " + range + list_in_words(list_devices()));
    }
    const egl::Device device = devices[static_cast<std::size_t>(index)];
    list.candidates.push_back({egl::Platform::device, device, probe_extensions(device, index)});
}

void add_by_name(CandidateList& list, const std::string& name) {
    const std::vector<DeviceInfo> infos = list_devices();
    const std::vector<egl::Device> devices = egl::query_devices();
    const std::string wanted = lower_case(name);
    // nvidia-smi and CUDA_VISIBLE_DEVICES write GPU- before a UUID.
    const std::string uuid = wanted.starts_with("gpu-") ? wanted.substr(4) : wanted;
    for (std::size_t i = 0; i < std::min(infos.size(), devices.size()); ++i) {
        if (lower_case(infos[i].uuid) == uuid ||
            lower_case(infos[i].name).find(wanted) != std::string::npos) {
            list.candidates.push_back({egl::Platform::device, devices[i], infos[i]});
        }
    }
    if (list.candidates.empty()) {
        throw ContextError(
            "no " + list.choice +
            ": expected \"auto\", \"gpu\", \"software\", an index, a UUID or a part of a name; " +
            list_in_words(infos));
    }
}

}  // namespace

CandidateList list_candidates(const DeviceChoice& choice) {
    CandidateList list;
    if (const int* index = std::get_if<int>(&choice)) {
        list.choice = "device " + std::to_string(*index);
        add_by_index(list, *index);
        return list;
    }

    std::string name = std::get<std::string>(choice);
    if (name.empty()) {
        throw std::invalid_argument("device: expected \"auto\", \"gpu\", \"software\", an index, a "
                                    "UUID or a part of a name, got an empty string");
    }
    std::string origin;
    if (lower_case(name) == "auto") {
        if (const char* variable = std::getenv("CUBECAM_DEVICE");
            variable != nullptr && *variable != '\0') {
            name = variable;
            origin = " (from CUBECAM_DEVICE)";
        }
    }
    list.choice = "device \"" + name + "\"" + origin;

    const std::string word = lower_case(name);
    if (word == "auto" || word == "gpu" || word == "software") {
        list.kind = word == "gpu"        ? DeviceKind::gpu
                    : word == "software" ? DeviceKind::software
                                         : DeviceKind::any;
        add_by_kind(list);
        return list;
    }
    // A part of a name may also consist of digits ("4090"): it is an index only if there is such a
    // device.
    const std::optional<int> index = to_index(name);
    if (index && *index < static_cast<int>(egl::query_devices().size())) {
        add_by_index(list, *index);
    } else {
        add_by_name(list, name);
    }
    return list;
}

}  // namespace cubecam::gl
