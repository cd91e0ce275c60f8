/// Work without Python's lock (GIL), also in threads that the interpreter leaves behind at its end.
#pragma once

#include <pybind11/pybind11.h>

namespace cubecam::bindings {

/// Lets other Python threads run while this object lives. Every binding uses this class in place of
/// pybind11's gil_scoped_release, for three reasons:
///  - A daemon thread that takes the lock back after the interpreter has begun to end never gets
///    it: Python 3.10 to 3.13 end the thread by an unwinding that must not pass a destructor, else
///    the process aborts; here, the thread sleeps until the process is gone, as in Python 3.14.
///  - While this object lives, `poll_interrupts()` handles signals in Python's main thread and
///    throws error_already_set if a handler raised, for example KeyboardInterrupt.
///  - Before the process runs its exit handlers (those of OpenGL drivers among them), threads
///    inside such work are stopped at their next `poll_interrupts()`.
class Unlocked {
public:
    Unlocked();
    ~Unlocked();

    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    friend class Locked;

    Unlocked* const outer_;
    PyThreadState* state_;
};

/// Takes the lock back for a while, inside the work of an Unlocked of the same thread: for a call
/// of a user's function. In a daemon thread that is too late, the constructor never returns.
class Locked {
public:
    Locked();
    ~Locked();

    Locked(const Locked&) = delete;
    Locked& operator=(const Locked&) = delete;

private:
    Unlocked* const inside_;
};

/// Makes `poll_interrupts()` of the core handle signals, and defines a function for tests.
void bind_interrupts(pybind11::module_& module);

}  // namespace cubecam::bindings
