#include "cubecam/trial/job.hpp"

#include <cstring>
#include <stdexcept>
#include <type_traits>

namespace cubecam::trial {
namespace {

static_assert(sizeof(State) ==
              sizeof(std::uint32_t) * (2 * most_outputs + 7 * most_attributes + 23));
static_assert(sizeof(Texture) == sizeof(std::uint32_t) * 15);

class JobWriter {
public:
    template <class Value>
    void add(const Value& value) {
        static_assert(std::has_unique_object_representations_v<Value>);
        bytes.append(reinterpret_cast<const char*>(&value), sizeof(Value));
    }
    void add(const std::string& text) {
        add(static_cast<std::uint32_t>(text.size()));
        bytes += text;
    }
    std::string bytes;
};

class JobReader {
public:
    explicit JobReader(std::string_view bytes) : bytes_(bytes) {}

    template <class Value>
    Value take() {
        Value value{};
        std::memcpy(&value, take(sizeof(Value)).data(), sizeof(Value));
        return value;
    }
    std::string take_text() { return std::string(take(take<std::uint32_t>())); }
    bool empty() const { return bytes_.empty(); }

private:
    std::string_view take(std::size_t size) {
        if (size > bytes_.size()) {
            throw std::invalid_argument("expected a whole job, got " +
                                        std::to_string(bytes_.size()) + " bytes of " +
                                        std::to_string(size));
        }
        const std::string_view taken = bytes_.substr(0, size);
        bytes_.remove_prefix(size);
        return taken;
    }

    std::string_view bytes_;
};

}  // namespace

std::string encode(const Job& job) {
    JobWriter to;
    to.add(static_cast<std::uint32_t>(job.stages.size()));
    for (const Stage& stage : job.stages) {
        to.add(stage.type);
        to.add(stage.text);
    }
    to.add(job.state);
    to.add(static_cast<std::uint32_t>(job.textures.size()));
    for (const Texture& texture : job.textures) to.add(texture);
    to.add(static_cast<std::uint32_t>(job.samplers.size()));
    for (const Sampler& sampler : job.samplers) {
        to.add(sampler.name);
        to.add(sampler.unit);
    }
    return std::move(to.bytes);
}

Job decode(std::string_view bytes) {
    JobReader from(bytes);
    Job job;
    for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
        Stage stage;
        stage.type = from.take<std::uint32_t>();
        stage.text = from.take_text();
        job.stages.push_back(std::move(stage));
    }
    job.state = from.take<State>();
    for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
        job.textures.push_back(from.take<Texture>());
    }
    for (auto left = from.take<std::uint32_t>(); left > 0; --left) {
        Sampler sampler;
        sampler.name = from.take_text();
        sampler.unit = from.take<std::uint32_t>();
        job.samplers.push_back(std::move(sampler));
    }
    if (!from.empty()) throw std::invalid_argument("expected a job, got more bytes than it has");
    return job;
}

}  // namespace cubecam::trial
