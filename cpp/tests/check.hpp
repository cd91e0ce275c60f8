#pragma once

#include <iostream>
#include <sstream>
#include <string>

/// A few lines instead of a framework: a failed check is printed, and the program then returns 1.
namespace cubecam::test {

inline int failures = 0;

inline void check(bool holds, const char* what, const char* file, int line) {
    if (holds) return;
    ++failures;
    std::cerr << file << ':' << line << ": expected " << what << '\n';
}

template <class Got, class Expected>
void check_equal(const Got& got, const Expected& expected, const char* what, const char* file,
                 int line) {
    if (got == expected) return;
    ++failures;
    std::cerr << file << ':' << line << ": " << what << ": expected " << expected << ", got " << got
              << '\n';
}

inline int result() { return failures == 0 ? 0 : 1; }

}  // namespace cubecam::test

#define CHECK(condition) ::cubecam::test::check((condition), #condition, __FILE__, __LINE__)
#define CHECK_EQUAL(got, expected)                                                                 \
    ::cubecam::test::check_equal((got), (expected), #got, __FILE__, __LINE__)
