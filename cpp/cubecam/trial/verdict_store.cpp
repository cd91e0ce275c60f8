#include "cubecam/trial/verdict_store.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace cubecam::trial {
namespace {

/// A file descriptor that is closed at the end.
class OpenFile {
public:
    OpenFile(const std::string& path, int flags)
        : descriptor_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0600)) {}
    ~OpenFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    int get() const { return descriptor_; }
    /// The state of a regular file that only this user can have written.
    std::optional<struct stat> own_state() const {
        struct stat state{};
        if (descriptor_ < 0 || fstat(descriptor_, &state) != 0) return std::nullopt;
        if (!S_ISREG(state.st_mode) || state.st_uid != geteuid()) return std::nullopt;
        if ((state.st_mode & (S_IWGRP | S_IWOTH)) != 0) return std::nullopt;
        return state;
    }

private:
    int descriptor_;
};

std::string store_path() {
    std::string folder;
    const char* cache = std::getenv("XDG_CACHE_HOME");
    if (cache != nullptr && *cache == '/') {  // the specification ignores relative paths
        folder = cache;
    } else if (const char* home = std::getenv("HOME"); home != nullptr && *home == '/') {
        folder = std::string(home) + "/.cache";
    } else {
        return {};
    }
    return folder + "/cubecam/shader_verdicts";
}

void make_folders(const std::string& path) {
    for (std::size_t end = path.find('/', 1); end != std::string::npos;
         end = path.find('/', end + 1)) {
        mkdir(path.substr(0, end).c_str(), 0700);
    }
}

/// FNV-1a.
std::uint32_t checksum(std::string_view bytes) {
    std::uint32_t sum = 2166136261U;
    for (const char byte : bytes) sum = (sum ^ static_cast<std::uint8_t>(byte)) * 16777619U;
    return sum;
}

constexpr std::size_t name_bytes = 24;
constexpr std::size_t checked_bytes = 28;

}  // namespace

VerdictStore& VerdictStore::of_process() {
    // It is never freed: renderers may be closed while the process ends.
    static auto* store = new VerdictStore(store_path());
    return *store;
}

std::size_t VerdictStore::NameHash::operator()(const Name& name) const noexcept {
    std::size_t hash = 0;
    std::memcpy(&hash, name.data(), sizeof(hash));
    return hash;
}

VerdictStore::Name VerdictStore::name_of(const Sha256::Digest& job) {
    Name name{};
    std::copy_n(job.begin(), name.size(), name.begin());
    return name;
}

std::string VerdictStore::record_of(const Name& name, const Verdict& verdict) {
    std::string record(reinterpret_cast<const char*>(name.data()), name.size());
    record.push_back(static_cast<char>(verdict.outcome));
    record.push_back(static_cast<char>(verdict.step));
    record.push_back(static_cast<char>(verdict.signal));
    record.push_back(0);
    const std::uint32_t sum = checksum(record);
    record.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
    return record;
}

void VerdictStore::take_records(std::string_view bytes) {
    for (; bytes.size() >= record_bytes; bytes.remove_prefix(record_bytes)) {
        std::uint32_t sum = 0;
        std::memcpy(&sum, bytes.data() + checked_bytes, sizeof(sum));
        if (sum != checksum(bytes.substr(0, checked_bytes))) continue;
        Name name{};
        std::memcpy(name.data(), bytes.data(), name_bytes);
        const auto number = [&](std::size_t at) {
            return static_cast<std::uint8_t>(bytes[name_bytes + at]);
        };
        if (number(0) > static_cast<std::uint8_t>(Outcome::out_of_memory)) continue;
        if (number(1) > static_cast<std::uint8_t>(Step::draw)) continue;
        known_[name] = {static_cast<Outcome>(number(0)), static_cast<Step>(number(1)), number(2)};
    }
}

/// Reads what the file got since the last time.
void VerdictStore::read_news() {
    if (path_.empty()) return;
    const OpenFile file(path_, O_RDONLY);
    const auto state = file.own_state();
    if (!state) return;
    const auto size = static_cast<std::uint64_t>(state->st_size);
    if (state->st_ino != file_ || size < read_) read_ = 0;
    file_ = state->st_ino;
    std::string bytes(std::min<std::size_t>(size - read_, 2 * most_records * record_bytes), '\0');
    const ssize_t got = pread(file.get(), bytes.data(), bytes.size(), static_cast<off_t>(read_));
    if (got <= 0) return;
    const std::size_t whole = static_cast<std::size_t>(got) / record_bytes * record_bytes;
    take_records(std::string_view(bytes).substr(0, whole));
    read_ += whole;
}

std::optional<Verdict> VerdictStore::find(const Sha256::Digest& job) {
    const std::lock_guard lock(mutex_);
    const Name name = name_of(job);
    for (const bool again : {false, true}) {
        if (again) read_news();
        const auto found = known_.find(name);
        if (found != known_.end()) return found->second;
    }
    return std::nullopt;
}

void VerdictStore::add(const Sha256::Digest& job, const Verdict& verdict) {
    const std::lock_guard lock(mutex_);
    const Name name = name_of(job);
    known_[name] = verdict;
    if (!path_.empty() && verdict.lasting()) append(record_of(name, verdict));
}

void VerdictStore::append(const std::string& record) {
    std::optional<struct stat> state;
    {
        const OpenFile file(path_, O_WRONLY | O_APPEND);
        state = file.own_state();
        const auto size = state ? static_cast<std::size_t>(state->st_size) : 0;
        if (state && size % record_bytes == 0 && size < most_records * record_bytes) {
            // A write that fails leaves a part of a record, and the next one writes the file again.
            (void)!::write(file.get(), record.data(), record.size());
            return;
        }
        if (!state && errno != ENOENT && file.get() < 0) return;
        if (!state && file.get() >= 0) return;  // somebody else's
    }
    write_again(record);
}

/// Writes the newest half of the file and one more record to a new file, which takes its place.
void VerdictStore::write_again(const std::string& record) {
    make_folders(path_);
    std::string bytes;
    {
        const OpenFile old(path_, O_RDONLY);
        if (const auto state = old.own_state()) {
            const std::size_t kept = most_records / 2 * record_bytes;
            auto from = static_cast<std::size_t>(state->st_size);
            from -= from % record_bytes;
            bytes.resize(std::min(from, kept));
            from -= bytes.size();
            const ssize_t got =
                pread(old.get(), bytes.data(), bytes.size(), static_cast<off_t>(from));
            bytes.resize(got > 0 ? static_cast<std::size_t>(got) / record_bytes * record_bytes : 0);
        }
    }
    bytes += record;
    const std::string made = path_ + "." + std::to_string(getpid());
    {
        const OpenFile file(made, O_WRONLY | O_CREAT | O_TRUNC);
        const bool whole =
            file.own_state().has_value() &&
            ::write(file.get(), bytes.data(), bytes.size()) == static_cast<ssize_t>(bytes.size());
        if (whole && ::rename(made.c_str(), path_.c_str()) == 0) return;
    }
    ::unlink(made.c_str());
}

}  // namespace cubecam::trial
