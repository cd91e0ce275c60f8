#pragma once

#include "cubecam/core/sha256.hpp"
#include "cubecam/trial/verdict.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace cubecam::trial {

/// The verdicts of this user's sources, which a file keeps for later processes:
/// $XDG_CACHE_HOME/cubecam/shader_verdicts, or the same in ~/.cache.
///
/// The file is a list of records of one size, each with a checksum; new ones are appended by one
/// write, so that processes may share it. Wrong records are skipped, and a file that is full or
/// broken is written again. A file that cannot be read or written, or that somebody else may have
/// written, is the same as none: verdicts then last as long as the process.
class VerdictStore {
public:
    /// @param path of the file; empty: there is none
    explicit VerdictStore(std::string path) : path_(std::move(path)) {}

    /// The store of this process and user.
    static VerdictStore& of_process();

    std::optional<Verdict> find(const Sha256::Digest& job);
    /// The file gets lasting verdicts only.
    void add(const Sha256::Digest& job, const Verdict& verdict);

    static constexpr std::size_t record_bytes = 32;
    static constexpr std::size_t most_records = 32'768;

private:
    using Name = std::array<std::uint8_t, 24>;  ///< the beginning of a job's hash
    struct NameHash {
        std::size_t operator()(const Name& name) const noexcept;
    };
    using Known = std::unordered_map<Name, Verdict, NameHash>;

    static Name name_of(const Sha256::Digest& job);
    static std::string record_of(const Name& name, const Verdict& verdict);
    void take_records(std::string_view bytes);
    void read_news();
    void append(const std::string& record);
    void write_again(const std::string& record);

    std::mutex mutex_;
    const std::string path_;
    std::uint64_t read_ = 0;  ///< bytes of the file so far
    std::uint64_t file_ = 0;  ///< which file that was
    Known known_;
};

}  // namespace cubecam::trial
