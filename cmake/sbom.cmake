# cubecam_write_sbom()
#
# Writes the list of what is compiled into the extension module (software bill of materials, CycloneDX 1.6) and installs it
# into the wheel's .dist-info/sboms/ (PEP 770). Versions are those of this build. The list has no serial number and no date,
# so that equal sources give equal bytes.
function(cubecam_write_sbom)
    if(NOT DEFINED SKBUILD_METADATA_DIR)
        return()  # a build that makes no wheel
    endif()
    set(sbom_pybind11 "${pybind11_VERSION}")
    set(sbom_glm "${glm_VERSION}")
    if(NOT sbom_glm)
        set(sbom_glm "${cubecam_glm_tag}")
    endif()
    execute_process(COMMAND "${Python_EXECUTABLE}" -c "import importlib.metadata as m; print(m.version('glad2'))"
        OUTPUT_VARIABLE sbom_glad OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE failed)
    if(failed OR NOT sbom_pybind11 OR NOT sbom_glm)
        message(FATAL_ERROR "expected the versions of pybind11, GLM and glad2 for the bill of materials, "
            "got '${sbom_pybind11}', '${sbom_glm}', '${sbom_glad}'")
    endif()
    set(file "${CMAKE_CURRENT_BINARY_DIR}/cubecam.cdx.json")
    configure_file("${PROJECT_SOURCE_DIR}/cmake/sbom.cdx.json.in" "${file}" @ONLY)
    install(FILES "${file}" DESTINATION "${SKBUILD_METADATA_DIR}/sboms")
endfunction()
