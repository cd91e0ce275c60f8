# cubecam_compile_options(TARGET)
#
# Sets the compile options that every C++ target of this project has. Warnings apply to our C++ only: we do not
# correct generated C (glad) and imported headers (GLM, pybind11).
function(cubecam_compile_options target)
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES
        CXX_EXTENSIONS OFF
        C_VISIBILITY_PRESET hidden
        CXX_VISIBILITY_PRESET hidden
        VISIBILITY_INLINES_HIDDEN ON
        POSITION_INDEPENDENT_CODE ON
        UNITY_BUILD ${CUBECAM_UNITY}
        UNITY_BUILD_BATCH_SIZE 5)

    set(warnings -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -Wcast-align
        -Wunused -Wnull-dereference -Wdouble-promotion -Wimplicit-fallthrough)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        list(APPEND warnings -Wduplicated-cond -Wduplicated-branches -Wlogical-op -Wuseless-cast)
        # GCC 12 warns of std::string + "literal" itself (gcc.gnu.org PR105651).
        list(APPEND warnings -Wno-restrict)
    endif()
    if(CUBECAM_WERROR)
        list(APPEND warnings -Werror)
    endif()
    if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        target_compile_options(${target} PRIVATE "$<$<COMPILE_LANGUAGE:CXX>:${warnings}>")
        # A function that nothing calls is left out when a program is linked, whichever file it stands in.
        target_compile_options(${target} PRIVATE -ffunction-sections -fdata-sections)
        if(NOT APPLE)
            target_link_options(${target} PRIVATE "LINKER:--gc-sections")
        endif()
    endif()
    cubecam_harden(${target})
endfunction()

# cubecam_harden(TARGET)
#
# What distributions do against the abuse of a mistake in our C and C++: guards on the stack, checked sizes of copies, and
# addresses that are resolved at once and then read-only. Builds of other types, those with sanitizers too, do without:
# sanitizers check more, and replace the same functions.
function(cubecam_harden target)
    if(NOT UNIX OR APPLE OR NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
        return()
    endif()
    set(hardened "$<CONFIG:Release,RelWithDebInfo,MinSizeRel>")
    target_compile_options(${target} PRIVATE
        "$<${hardened}:-fstack-protector-strong;-fstack-clash-protection;-U_FORTIFY_SOURCE;-D_FORTIFY_SOURCE=2>")
    if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
        target_compile_options(${target} PRIVATE "$<${hardened}:-fcf-protection>")
    endif()
    target_link_options(${target} PRIVATE "$<${hardened}:LINKER:-z,relro;LINKER:-z,now;LINKER:-z,noexecstack>")
endfunction()
