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
    endif()
endfunction()
