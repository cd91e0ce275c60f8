# cubecam_embed_shaders(TARGET DIR)
#
# Compiles every *.glsl, *.vert, *.tesc, *.tese, *.geom, *.frag and *.comp file below DIR into TARGET, as the table
# that cubecam::gl::embedded_shaders() returns (cpp/cubecam/gl/embedded.hpp), sorted by path. A shader's name in the
# table is its path from DIR. The table is written again when a shader changes, appears or disappears; the program
# reads no shader from disk at run time.
function(cubecam_embed_shaders target directory)
    set(patterns "")
    foreach(ending IN ITEMS glsl vert tesc tese geom frag comp)
        list(APPEND patterns "${directory}/*.${ending}")
    endforeach()
    file(GLOB_RECURSE shaders CONFIGURE_DEPENDS ${patterns})
    list(SORT shaders)

    set(script "${CMAKE_CURRENT_FUNCTION_LIST_DIR}/write_shader_table.cmake")
    set(output "${CMAKE_CURRENT_BINARY_DIR}/embedded_shaders.cpp")
    add_custom_command(OUTPUT "${output}"
        COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${output}" "-DDIRECTORY=${directory}" "-DSHADERS=${shaders}" -P "${script}"
        DEPENDS ${shaders} "${script}"
        COMMENT "Embedding the shaders"
        VERBATIM)
    target_sources(${target} PRIVATE "${output}")
endfunction()
