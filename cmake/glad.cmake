# cubecam_add_glad(TARGET)
#
# Gives TARGET the header <glad/gl.h> and the loader of OpenGL 4.5 core, which glad2 generates at build from its own
# copy of the specification (--reproducible: glad2 fetches nothing). With --mx each context has its own table of
# functions; without --loader glad2 opens no library: eglGetProcAddress fills the table.
#
# To use another extension, add its name to the list below.
set(cubecam_glad_extensions
    GL_KHR_debug                          # in the core since 4.3; names objects and collects messages
    GL_ARB_shader_viewport_layer_array    # gl_Layer from the vertex shader
    GL_AMD_vertex_shader_layer            # gl_Layer on older AMD drivers
    GL_ARB_texture_filter_anisotropic
    GL_EXT_texture_filter_anisotropic
    GL_NVX_gpu_memory_info)               # how much memory a size may take

function(cubecam_add_glad target)
    if(NOT TARGET cubecam_glad)
        find_package(Python 3.10 REQUIRED COMPONENTS Interpreter)
        execute_process(COMMAND "${Python_EXECUTABLE}" -c "import glad" RESULT_VARIABLE glad_missing
            OUTPUT_QUIET ERROR_QUIET)
        if(glad_missing)
            message(FATAL_ERROR "glad2 is missing: ${Python_EXECUTABLE} -m pip install glad2 "
                "(or point Python_EXECUTABLE at a Python that has it)")
        endif()

        set(folder "${CMAKE_CURRENT_BINARY_DIR}/glad")
        set(outputs "${folder}/src/gl.c" "${folder}/include/glad/gl.h" "${folder}/include/KHR/khrplatform.h")
        list(JOIN cubecam_glad_extensions "," extensions)
        add_custom_command(OUTPUT ${outputs}
            COMMAND "${Python_EXECUTABLE}" -m glad --quiet --reproducible --api gl:core=4.5
                --extensions "${extensions}" --out-path "${folder}" c --mx
            COMMENT "Generating the OpenGL loader"
            VERBATIM)

        add_library(cubecam_glad STATIC ${outputs})
        # SYSTEM: we do not correct the warnings of generated code.
        target_include_directories(cubecam_glad SYSTEM PUBLIC "${folder}/include")
        set_target_properties(cubecam_glad PROPERTIES
            C_VISIBILITY_PRESET hidden
            POSITION_INDEPENDENT_CODE ON)
        cubecam_harden(cubecam_glad)
    endif()
    target_link_libraries(${target} PUBLIC cubecam_glad)
endfunction()
