#pragma once

#include <stdexcept>
#include <string>
#include <utility>

/// The exceptions that the library throws.
///
/// There are three kinds of failure, so that a caller (and Python above it) knows who caused one:
///  - the caller's mistakes: `std::invalid_argument` (Python's ValueError), `std::out_of_range`
///    (IndexError), `cubecam::TypeError` (TypeError); the text says "expected ..., got ...";
///  - the environment's failures: `Error` and what is below it;
///  - everything else is a defect of this library.
///
/// The library never prints, exits or aborts.
namespace cubecam {

/// Base of every failure that is not the caller's own mistake.
class Error : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// No OpenGL context can be created, or the existing one can no longer be used.
class ContextError : public Error {
public:
    using Error::Error;
};

/// The context can no longer be used, but a new one may be: another library ended its display, or
/// the GPU was reset. A Renderer makes a new context and does the call again.
class ContextLost : public ContextError {
public:
    explicit ContextLost(const std::string& text, bool reset = false)
        : ContextError(text), reset_(reset) {}

    /// Whether the GPU was reset. The handle of the context is then still valid.
    bool reset() const noexcept { return reset_; }

private:
    bool reset_;
};

/// A shader did not compile or link. `what()` holds the log, with file names instead of the
/// driver's string numbers, and the numbered source lines round each error.
class ShaderError : public Error {
public:
    explicit ShaderError(const std::string& text, std::string log = {})
        : Error(text), log_(std::move(log)) {}

    /// The driver's own log, unchanged.
    const std::string& log() const noexcept { return log_; }

private:
    std::string log_;
};

/// OpenGL reported an error; `code()` is the first one, such as GL_OUT_OF_MEMORY.
class GlError : public Error {
public:
    explicit GlError(const std::string& text, unsigned code = 0) : Error(text), code_(code) {}

    unsigned code() const noexcept { return code_; }

private:
    unsigned code_;
};

/// A value has the wrong type: TypeError in Python.
class TypeError : public std::logic_error {
public:
    using std::logic_error::logic_error;
};

}  // namespace cubecam
