/// Tests what the trial of users' GLSL rests on: the hash, the messages, and the file of verdicts.

#include "check.hpp"

#include "cubecam/core/sha256.hpp"
#include "cubecam/trial/job.hpp"
#include "cubecam/trial/verdict_store.hpp"

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

using namespace cubecam;
using namespace cubecam::trial;

namespace {

std::string hexadecimal(const Sha256::Digest& digest) {
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (const std::uint8_t byte : digest) {
        text.push_back(digits[byte >> 4]);
        text.push_back(digits[byte & 15]);
    }
    return text;
}

Sha256::Digest hash_of(std::string_view text, std::size_t piece) {
    Sha256 hash;
    for (; !text.empty(); text.remove_prefix(std::min(piece, text.size()))) {
        hash.add(text.substr(0, piece));
    }
    return hash.finish();
}

/// The examples of FIPS 180-4 (csrc.nist.gov, "SHA256.pdf" and "SHA2_Additional.pdf").
void test_hash() {
    CHECK_EQUAL(hexadecimal(hash_of("", 1)),
                "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    CHECK_EQUAL(hexadecimal(hash_of("abc", 1)),
                "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    const std::string_view long_text = "abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq";
    CHECK_EQUAL(hexadecimal(hash_of(long_text, 64)),
                "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    const std::string million(1'000'000, 'a');
    for (const std::size_t piece : {1, 63, 64, 1000, 1'000'000}) {
        CHECK_EQUAL(hexadecimal(hash_of(million, piece)),
                    "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    }
}

void test_jobs() {
    Job job;
    job.stages = {{1, "void main() {}"}, {2, std::string("\0\n", 2)}};
    job.state.samples = 4;
    job.state.attributes[15] = {4, 5126, 0, 1, 2, 16, 64};
    job.textures.resize(3);
    job.textures[2].swizzle = {1, 2, 3, 4};
    job.samplers = {{"map", 6}, {"", 7}};
    const std::string bytes = encode(job);
    CHECK(encode(decode(bytes)) == bytes);
    const Job copy = decode(bytes);
    CHECK_EQUAL(copy.stages[1].text.size(), 2U);
    CHECK_EQUAL(copy.state.attributes[15].stride, 64U);
    CHECK_EQUAL(copy.textures[2].swizzle[3], 4U);
    CHECK_EQUAL(copy.samplers[0].name, "map");
    for (std::size_t size = 0; size <= bytes.size(); ++size) {
        bool refused = false;
        try {
            (void)decode(size < bytes.size() ? bytes.substr(0, size) : bytes + "x");
        } catch (const std::invalid_argument&) {
            refused = true;
        }
        CHECK(refused);
    }
}

Sha256::Digest number(std::uint32_t value) { return hash_of(std::to_string(value), 100); }

void test_store() {
    std::string folder = std::filesystem::temp_directory_path() / "cubecam-verdicts-XXXXXX";
    CHECK(mkdtemp(folder.data()) != nullptr);
    const std::string path = folder + "/new/verdicts";
    {
        VerdictStore store(path);
        CHECK(!store.find(number(0)));
        store.add(number(0), {Outcome::crashed, Step::link, SIGFPE});
        store.add(number(1), {Outcome::out_of_time, Step::draw, SIGALRM});  // a busy machine
        store.add(number(2), {Outcome::out_of_memory, Step::draw, 1});
        CHECK(store.find(number(1)) && store.find(number(2)));
    }
    CHECK_EQUAL(std::filesystem::file_size(path), VerdictStore::record_bytes);
    VerdictStore store(path);
    const auto found = store.find(number(0));
    CHECK(found && found->outcome == Outcome::crashed && found->step == Step::link);
    CHECK(found && found->signal == SIGFPE && !found->passed());
    CHECK(!store.find(number(1)) && !store.find(number(2)));
    // What another process adds is seen.
    VerdictStore other(path);
    other.add(number(3), {});
    CHECK(store.find(number(3)) && store.find(number(3))->passed());

    // The file stays small, and the newest verdicts stay in it.
    const std::uint32_t count = VerdictStore::most_records + 100;
    for (std::uint32_t i = 10; i < count + 10; ++i) store.add(number(i), {});
    const std::uintmax_t size = std::filesystem::file_size(path);
    CHECK(size <= VerdictStore::most_records * VerdictStore::record_bytes);
    CHECK(size >= VerdictStore::most_records / 2 * VerdictStore::record_bytes);
    VerdictStore last(path);
    CHECK(last.find(number(count + 9)) && !last.find(number(0)));
    CHECK_EQUAL(std::distance(std::filesystem::directory_iterator(folder + "/new"), {}), 1);
    std::filesystem::remove_all(folder);

    VerdictStore none("");
    none.add(number(0), {});
    CHECK(none.find(number(0)).has_value());
}

}  // namespace

int main() {
    test_hash();
    test_jobs();
    test_store();
    return test::result();
}
