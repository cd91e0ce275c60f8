#include "unlocked.hpp"

#include "cubecam/core/interrupts.hpp"
#include "cubecam/gl/large_texture.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <pthread.h>
#include <sys/syscall.h>
#include <thread>
#include <unistd.h>
#include <unwind.h>
#include <utility>

namespace py = pybind11;

namespace cubecam::bindings {

namespace {

/// The innermost Unlocked of this thread; null while this thread may hold the lock.
thread_local constinit Unlocked* innermost = nullptr;

/// How many threads work without the lock.
constinit std::atomic<int> running{0};

/// Set when the interpreter is gone and the process is about to run its exit handlers.
constinit std::atomic<bool> process_ends{false};

/// The thread that handles Python's signals, as pthread_self() gives it.
constinit std::atomic<unsigned long> signal_thread{0};

/// Sleeps until the process is gone. Nothing on this thread's stack is destroyed: whatever the
/// thread holds stays valid for the threads that still run.
[[noreturn]] void sleep_for_ever() noexcept {
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
    for (;;) pause();
}

/// What a test wants to be called at each look for signals; null if nothing.
constinit PyObject* test_function = nullptr;

PyThreadState* leave_lock() {
    ++running;  // first: the end of the interpreter must not come in between
    return PyEval_SaveThread();
}

/// Whether Python ends the threads that ask for its lock.
bool interpreter_ends() noexcept {
#if PY_VERSION_HEX >= 0x030D0000
    return Py_IsFinalizing() != 0 || Py_IsInitialized() == 0;
#else
    return _Py_IsFinalizing() != 0 || Py_IsInitialized() == 0;
#endif
}

void take_lock(PyThreadState* state) noexcept {
    --running;  // first, since Python 3.14 itself lets the thread sleep for ever
    // At the interpreter's end Python 3.10 to 3.13 call pthread_exit() here: see the end of this
    // file.
    PyEval_RestoreThread(state);
}

/// Whether Python handles signals in this thread: the thread that Python names, and after a fork
/// the only thread of the process.
bool handles_signals() {
    return pthread_self() == signal_thread.load(std::memory_order_relaxed) ||
           syscall(SYS_gettid) == getpid();
}

void check_interrupts() {
    if (innermost == nullptr) return;
    if (process_ends.load(std::memory_order_relaxed)) {
        --running;
        sleep_for_ever();
    }
    if (!handles_signals()) return;
    const Locked locked;
    if (test_function != nullptr) py::reinterpret_borrow<py::object>(test_function)();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// Python calls this after its own end, before the exit handlers of libraries.
void stop_other_threads() {
    process_ends = true;
    // An OpenGL driver that is inside a call while its exit handlers run may end the process by a
    // signal. Work reaches its next poll soon; no thread is waited for longer than this.
    const auto latest = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    while (running.load() + gl::threads_making_textures() > 0 &&
           std::chrono::steady_clock::now() < latest) {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

/// In a forked child there is no thread but this one, which forked while it held the lock.
void forget_other_threads() { running = 0; }

}  // namespace

Unlocked::Unlocked() : outer_(innermost), state_(leave_lock()) {
    innermost = this;
    start_interrupt_pause();
}

Unlocked::~Unlocked() {
    take_lock(state_);
    innermost = outer_;
}

Locked::Locked() : inside_(innermost) {
    take_lock(inside_->state_);
    innermost = nullptr;
}

Locked::~Locked() {
    inside_->state_ = leave_lock();
    innermost = inside_;
}

void bind_interrupts(py::module_& module) {
    const py::object main = py::module_::import("threading").attr("main_thread")();
    signal_thread = main.attr("ident").cast<unsigned long>();
    static const int at_exit = Py_AtExit(&stop_other_threads);
    static const int at_fork = pthread_atfork(nullptr, nullptr, &forget_other_threads);
    (void)at_exit;  // of no more than 32 functions, this one may be too many: the end is then as
                    // before
    (void)at_fork;
    set_interrupt_check(&check_interrupts);
    module.def(
        "_interrupt_pause",
        [](int milliseconds) { return interrupts::pause_ms.exchange(std::max(0, milliseconds)); },
        py::arg("milliseconds"),
        "For tests: the time between two looks for signals in a long call; returns the one "
        "before.");
    module.def(
        "_at_interrupt_check",
        [](const py::object& function) {
            PyObject* const next = function.is_none() ? nullptr : function.inc_ref().ptr();
            py::reinterpret_steal<py::object>(std::exchange(test_function, next));
        },
        py::arg("function"),
        "For tests: a function without arguments that is called at each look for signals in a "
        "long call of the main thread; None: no function.");
}

}  // namespace cubecam::bindings

// The linker puts this function in the place of __gxx_personality_v0 (option --wrap), which the
// unwinder calls for each C++ frame of this module, the innermost first. A daemon thread may lose
// the lock for ever not only in Unlocked, but wherever a binding calls Python: a user's function, a
// generator, `__array__`, `__index__`. Python 3.10 to 3.13 then unwind the thread, and destructors
// on the way would change reference counts without the lock: the thread sleeps instead, before the
// first of them runs.
extern "C" {

// The names are the linker's.
// NOLINTBEGIN(bugprone-reserved-identifier)
_Unwind_Reason_Code __real___gxx_personality_v0(int version, _Unwind_Action actions,
                                                _Unwind_Exception_Class kind,
                                                _Unwind_Exception* exception,
                                                _Unwind_Context* context);

_Unwind_Reason_Code __wrap___gxx_personality_v0(int version, _Unwind_Action actions,
                                                _Unwind_Exception_Class kind,
                                                _Unwind_Exception* exception,
                                                _Unwind_Context* context) {
    if ((actions & _UA_FORCE_UNWIND) != 0 && cubecam::bindings::interpreter_ends()) {
        cubecam::bindings::sleep_for_ever();
    }
    return __real___gxx_personality_v0(version, actions, kind, exception, context);
}
// NOLINTEND(bugprone-reserved-identifier)

}  // extern "C"
