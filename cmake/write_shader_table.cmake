# cmake -DOUTPUT=<file.cpp> -DDIRECTORY=<folder> -DSHADERS=<files> -P write_shader_table.cmake
#
# Writes the table of embedded shaders. cubecam_embed_shaders runs this script at build.

# Compilers limit one string literal (the least is Microsoft's, 16 KiB); neighbouring literals are one string.
set(chunk_size 8000)

set(entries "")
foreach(shader IN LISTS SHADERS)
    file(RELATIVE_PATH name "${DIRECTORY}" "${shader}")
    file(READ "${shader}" text)
    string(FIND "${text}" ")glsl\"" delimiter)
    if(NOT delimiter EQUAL -1)
        message(FATAL_ERROR "${shader}: the text )glsl\" would end the string literal that holds the shader")
    endif()
    string(LENGTH "${text}" length)
    set(literals "")
    set(start 0)
    while(start LESS length)
        string(SUBSTRING "${text}" ${start} ${chunk_size} chunk)
        string(APPEND literals "R\"glsl(${chunk})glsl\"\n")
        math(EXPR start "${start} + ${chunk_size}")
    endwhile()
    if(length EQUAL 0)
        set(literals "\"\"\n")
    endif()
    string(STRIP "${literals}" literals)
    string(APPEND entries "    {\"${name}\", ${literals}},\n")
endforeach()

list(LENGTH SHADERS count)
if(count EQUAL 0)
    set(table "std::span<const ShaderSource> embedded_shaders() { return {}; }\n")
else()
    set(table "namespace {\n\nconstexpr ShaderSource shader_table[] = {\n${entries}};\n\n}  // namespace\n\n")
    string(APPEND table "std::span<const ShaderSource> embedded_shaders() { return shader_table; }\n")
endif()
file(WRITE "${OUTPUT}" "// Generated from shaders/ by cmake/write_shader_table.cmake.\n"
    "#include \"cubecam/gl/embedded.hpp\"\n\nnamespace cubecam::gl {\n\n${table}\n}  // namespace cubecam::gl\n")
