// A stand-in for libEGL that passes every call on, except that a test can make the driver behave as
// drivers behave that this machine does not have: GPUs that are reset, contexts that end, devices
// that do not start. CUBECAM_EGL_LIBRARY names the compiled library; tests/gl/fakes.py drives it.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <string>
#include <vector>

namespace {

using Proc = void (*)();

constexpr std::int32_t none = 0x3038;
constexpr std::int32_t extensions = 0x3055;
constexpr std::int32_t robust_access = 0x31B2;
constexpr std::int32_t reset_strategy = 0x31BD;
constexpr std::int32_t track_references = 0x3352;
constexpr unsigned gl_renderer = 0x1F01;
constexpr unsigned max_texture_image_units = 0x8872;
constexpr unsigned max_framebuffer_width = 0x9315;
constexpr unsigned max_framebuffer_height = 0x9316;
constexpr unsigned max_viewport_dims = 0x0D3A;
constexpr unsigned free_memory_nvx = 0x9049;
constexpr unsigned free_memory_ati = 0x87FC;
constexpr unsigned link_status = 0x8B82;
constexpr unsigned active_uniforms = 0x8B86;
constexpr unsigned pixel_pack_buffer_binding = 0x88ED;

// What a test sets, by fake_set.
int reset_answers = 0;       // so many queries report a reset
int resets = 0;              // so many contexts report one reset each
int reset_status = 0x8254;   // GL_INNOCENT_CONTEXT_RESET
int current_fails = 0;       // so many eglMakeCurrent of a context fail
int current_error = 0x300E;  // EGL_CONTEXT_LOST
int no_contexts = 0;         // eglCreateContext fails
int refuses_counting = 0;    // displays that count their users are listed, and refused
// What a test reads, by fake_get.
int robust_contexts = 0;
int contexts_destroyed = 0;
int direct_reads = 0;
int buffered_reads = 0;
int pack_buffers = 0;
int flushes = 0;
int counted_displays = 0;
int plain_displays = 0;

// 1: from now on the handle of the context made before the last one means the last one, as where a
// driver gave the memory of an ended context to a new one.
int one_handle = 0;
void* made[2] = {};  // the last two contexts
void* ended = nullptr;
void* its_heir = nullptr;

std::int32_t pending_error = 0;
char fake_device = 0;

void* library() {
    static void* handle = dlopen("libEGL.so.1", RTLD_NOW | RTLD_LOCAL);
    return handle;
}

template <class Function>
Function real(const char* name, Function) {
    return reinterpret_cast<Function>(dlsym(library(), name));
}

const char* variable(const char* name) {
    const char* value = std::getenv(name);
    return value != nullptr && *value != '\0' ? value : nullptr;
}

template <class Function>
Function real_gl(const char* name) {
    using Get = Proc (*)(const char*);
    return reinterpret_cast<Function>(
        reinterpret_cast<Get>(dlsym(library(), "eglGetProcAddress"))(name));
}

void* meant(void* context) {
    if (one_handle == 1) {
        ended = made[0];
        its_heir = made[1];
        one_handle = 2;
    }
    return one_handle != 0 && context == ended && context != nullptr ? its_heir : context;
}

unsigned graphics_reset_status() {
    // Each context reports one reset, and then that it is over.
    static void* reported = nullptr;
    using Current = void* (*)();
    void* now = reinterpret_cast<Current>(dlsym(library(), "eglGetCurrentContext"))();
    if (resets > 0 && reported != now) {
        --resets;
        reported = now;
        return static_cast<unsigned>(reset_status);
    }
    if (reset_answers <= 0) return 0;
    --reset_answers;
    return static_cast<unsigned>(reset_status);
}

const unsigned char* get_string(unsigned name) {
    const char* renderer = variable("FAKE_RENDERER");
    if (name == gl_renderer && renderer != nullptr) {
        return reinterpret_cast<const unsigned char*>(renderer);
    }
    return real_gl<const unsigned char* (*)(unsigned)>("glGetString")(name);
}

void get_integer(unsigned name, int* value) {
    const char* units = variable("FAKE_UNITS");
    if (name == max_texture_image_units && units != nullptr) {
        *value = std::atoi(units);
        return;
    }
    // Zink looks up larger textures than it draws into.
    const char* drawn = variable("FAKE_LARGEST_DRAWN");
    if ((name == max_framebuffer_height || name == max_framebuffer_width) && drawn != nullptr) {
        *value = std::atoi(drawn);
        return;
    }
    const char* seen = variable("FAKE_LARGEST_VIEWPORT");
    if (name == max_viewport_dims && seen != nullptr) {
        value[0] = value[1] = std::atoi(seen);
        return;
    }
    const bool memory = name == free_memory_nvx || name == free_memory_ati;
    if (memory && variable("FAKE_RENDERER") != nullptr) return;  // that GPU does not tell
    real_gl<void (*)(unsigned, int*)>("glGetIntegerv")(name, value);
}

bool is_sampler(unsigned type) {
    return (type >= 0x8B5D && type <= 0x8B64) || (type >= 0x8DC0 && type <= 0x8DD8) ||
           (type >= 0x9108 && type <= 0x910D) || (type >= 0x900C && type <= 0x900F);
}

/// Fails as a driver with few texture units fails.
void get_program(unsigned program, unsigned name, int* value) {
    const auto get = real_gl<void (*)(unsigned, unsigned, int*)>("glGetProgramiv");
    get(program, name, value);
    const char* units = variable("FAKE_UNITS");
    if (name != link_status || units == nullptr || *value == 0) return;
    const auto uniform = real_gl<void (*)(unsigned, unsigned, int, int*, int*, unsigned*, char*)>(
        "glGetActiveUniform");
    int count = 0;
    int samplers = 0;
    get(program, active_uniforms, &count);
    for (int i = 0; i < count; ++i) {
        char text[64];
        int size = 0;
        unsigned type = 0;
        uniform(program, static_cast<unsigned>(i), sizeof(text), nullptr, &size, &type, text);
        if (is_sampler(type)) samplers += size;
    }
    if (samplers > std::atoi(units)) *value = 0;
}

void read_pixels(int x, int y, int width, int height, unsigned format, unsigned type, void* to) {
    int bound = 0;
    real_gl<void (*)(unsigned, int*)>("glGetIntegerv")(pixel_pack_buffer_binding, &bound);
    ++(bound != 0 ? buffered_reads : direct_reads);
    real_gl<void (*)(int, int, int, int, unsigned, unsigned, void*)>("glReadPixels")(
        x, y, width, height, format, type, to);
}

void flush() {
    ++flushes;
    real_gl<void (*)()>("glFlush")();
}

void* map_buffer(unsigned buffer, std::intptr_t offset, std::intptr_t length, unsigned access) {
    ++pack_buffers;
    return real_gl<void* (*)(unsigned, std::intptr_t, std::intptr_t, unsigned)>(
        "glMapNamedBufferRange")(buffer, offset, length, access);
}

unsigned query_devices(std::int32_t most, void** devices, std::int32_t* count) {
    const auto list =
        real_gl<unsigned (*)(std::int32_t, void**, std::int32_t*)>("eglQueryDevicesEXT");
    if (variable("FAKE_GPU") == nullptr) return list(most, devices, count);
    if (devices == nullptr) {
        const unsigned done = list(0, nullptr, count);
        ++*count;
        return done;
    }
    devices[0] = &fake_device;
    const unsigned done = list(most - 1, devices + 1, count);
    ++*count;
    return done;
}

const char* query_device_string(void* device, std::int32_t name) {
    if (device == &fake_device) return name == extensions ? "EGL_EXT_device_drm" : nullptr;
    // A device that does not say that it is a software device.
    if (name == extensions && variable("FAKE_PLAIN_DEVICE") != nullptr) return "";
    return real_gl<const char* (*)(void*, std::int32_t)>("eglQueryDeviceStringEXT")(device, name);
}

void* get_platform_display(unsigned platform, void* device, const std::int32_t* attributes) {
    if (device == &fake_device) {
        pending_error = 0x3003;  // EGL_BAD_ALLOC
        return nullptr;
    }
    if (attributes != nullptr && attributes[0] == track_references) {
        if (refuses_counting != 0) {
            pending_error = 0x3004;  // EGL_BAD_ATTRIBUTE
            return nullptr;
        }
        ++counted_displays;
        attributes = nullptr;  // Mesa has no such displays
    } else {
        ++plain_displays;
    }
    return real_gl<void* (*)(unsigned, void*, const std::int32_t*)>("eglGetPlatformDisplayEXT")(
        platform, device, attributes);
}

}  // namespace

extern "C" {

int* fake_number(const char* name) {
    struct Number {
        const char* name;
        int* place;
    };
    static const Number numbers[] = {
        {"reset_answers", &reset_answers},       {"resets", &resets},
        {"reset_status", &reset_status},         {"current_fails", &current_fails},
        {"current_error", &current_error},       {"no_contexts", &no_contexts},
        {"refuses_counting", &refuses_counting}, {"counted_displays", &counted_displays},
        {"plain_displays", &plain_displays},     {"one_handle", &one_handle},
        {"robust_contexts", &robust_contexts},   {"contexts_destroyed", &contexts_destroyed},
        {"direct_reads", &direct_reads},         {"buffered_reads", &buffered_reads},
        {"pack_buffers", &pack_buffers},         {"flushes", &flushes}};
    for (const Number& number : numbers) {
        if (std::strcmp(number.name, name) == 0) return number.place;
    }
    return nullptr;
}

Proc eglGetProcAddress(const char* name) {
    struct Wrapped {
        const char* name;
        Proc function;
    };
    static const Wrapped wrapped[] = {
        {"glGetGraphicsResetStatus", reinterpret_cast<Proc>(graphics_reset_status)},
        {"glGetString", reinterpret_cast<Proc>(get_string)},
        {"glGetIntegerv", reinterpret_cast<Proc>(get_integer)},
        {"glGetProgramiv", reinterpret_cast<Proc>(get_program)},
        {"glReadPixels", reinterpret_cast<Proc>(read_pixels)},
        {"glFlush", reinterpret_cast<Proc>(flush)},
        {"glMapNamedBufferRange", reinterpret_cast<Proc>(map_buffer)},
        {"eglQueryDevicesEXT", reinterpret_cast<Proc>(query_devices)},
        {"eglQueryDeviceStringEXT", reinterpret_cast<Proc>(query_device_string)},
        {"eglGetPlatformDisplayEXT", reinterpret_cast<Proc>(get_platform_display)}};
    for (const Wrapped& one : wrapped) {
        if (std::strcmp(one.name, name) == 0) return one.function;
    }
    return real_gl<Proc>(name);
}

std::int32_t eglGetError() {
    if (pending_error != 0) {
        const std::int32_t error = pending_error;
        pending_error = 0;
        return error;
    }
    return real("eglGetError", &eglGetError)();
}

unsigned eglMakeCurrent(void* display, void* draw, void* read, void* context) {
    if (context != nullptr && current_fails > 0) {
        --current_fails;
        pending_error = current_error;
        return 0;
    }
    return real("eglMakeCurrent", &eglMakeCurrent)(display, draw, read, meant(context));
}

/// llvmpipe makes no robust contexts: the attributes are counted, and left out.
void* eglCreateContext(void* display, void* config, void* shared, const std::int32_t* attributes) {
    if (no_contexts != 0) {
        pending_error = 0x3003;  // EGL_BAD_ALLOC
        return nullptr;
    }
    std::vector<std::int32_t> kept;
    bool robust = false;
    for (; *attributes != none; attributes += 2) {
        if (attributes[0] == robust_access || attributes[0] == reset_strategy) {
            robust = true;
            continue;
        }
        kept.insert(kept.end(), attributes, attributes + 2);
    }
    kept.push_back(none);
    if (robust) ++robust_contexts;
    made[0] = made[1];
    made[1] = real("eglCreateContext", &eglCreateContext)(display, config, shared, kept.data());
    return made[1];
}

unsigned eglDestroyContext(void* display, void* context) {
    ++contexts_destroyed;
    return real("eglDestroyContext", &eglDestroyContext)(display, meant(context));
}

void* eglGetDisplay(void* native) { return real("eglGetDisplay", &eglGetDisplay)(native); }
unsigned eglInitialize(void* display, std::int32_t* major, std::int32_t* minor) {
    return real("eglInitialize", &eglInitialize)(display, major, minor);
}
const char* eglQueryString(void* display, std::int32_t name) {
    const char* text = real("eglQueryString", &eglQueryString)(display, name);
    if (display == nullptr && name == extensions && variable("FAKE_COUNTED") != nullptr) {
        static const std::string longer = std::string(text) + " EGL_KHR_display_reference";
        return longer.c_str();
    }
    return text;
}
unsigned eglBindAPI(unsigned api) { return real("eglBindAPI", &eglBindAPI)(api); }
unsigned eglQueryAPI() { return real("eglQueryAPI", &eglQueryAPI)(); }
unsigned eglChooseConfig(void* display, const std::int32_t* attributes, void** configs,
                         std::int32_t most, std::int32_t* count) {
    return real("eglChooseConfig", &eglChooseConfig)(display, attributes, configs, most, count);
}
void* eglCreatePbufferSurface(void* display, void* config, const std::int32_t* attributes) {
    return real("eglCreatePbufferSurface", &eglCreatePbufferSurface)(display, config, attributes);
}
unsigned eglDestroySurface(void* display, void* surface) {
    return real("eglDestroySurface", &eglDestroySurface)(display, surface);
}
void* eglGetCurrentContext() { return real("eglGetCurrentContext", &eglGetCurrentContext)(); }
void* eglGetCurrentSurface(std::int32_t which) {
    return real("eglGetCurrentSurface", &eglGetCurrentSurface)(which);
}
void* eglGetCurrentDisplay() { return real("eglGetCurrentDisplay", &eglGetCurrentDisplay)(); }

}  // extern "C"
