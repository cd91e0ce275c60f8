# Provides glm::glm: the installed GLM if there is one, otherwise the release below.
#
# This file downloads the archive itself first: on a machine without a network FetchContent alone would wait for
# minutes, and its message would not name the package to install.
find_package(glm CONFIG QUIET)

if(NOT TARGET glm::glm)
    set(glm_tag 1.0.1)
    set(cubecam_glm_tag ${glm_tag})
    set(glm_sha256 9f3174561fd26904b23f0db5e560971cbf9b3cbda0b280f04d5c379d03bf234c)
    set(glm_url "https://github.com/g-truc/glm/archive/refs/tags/${glm_tag}.tar.gz")
    set(glm_archive "${CMAKE_BINARY_DIR}/glm-${glm_tag}.tar.gz")

    set(glm_known "")
    if(EXISTS "${glm_archive}")
        file(SHA256 "${glm_archive}" glm_known)
    endif()
    if(NOT glm_known STREQUAL glm_sha256)
        message(STATUS "GLM is not installed; fetching ${glm_tag}")
        file(DOWNLOAD "${glm_url}" "${glm_archive}" TIMEOUT 30 INACTIVITY_TIMEOUT 10 STATUS glm_status)
        list(POP_FRONT glm_status glm_code glm_reason)
        if(glm_code EQUAL 0)
            file(SHA256 "${glm_archive}" glm_known)
            if(NOT glm_known STREQUAL glm_sha256)
                set(glm_code 1)
                set(glm_reason "expected SHA-256 ${glm_sha256}, got ${glm_known}")
            endif()
        endif()
        if(NOT glm_code EQUAL 0)
            file(REMOVE "${glm_archive}")
            message(FATAL_ERROR
                "GLM is not installed and fetching ${glm_url} failed: ${glm_reason}.\n"
                "Install it: libglm-dev on Debian and Ubuntu, glm-devel on Fedora, glm on Arch and Homebrew.")
        endif()
    endif()

    include(FetchContent)
    # SOURCE_SUBDIR names a folder that does not exist: GLM consists of headers only, and its own CMake file would
    # install them into our wheel.
    FetchContent_Declare(glm_release URL "${glm_archive}" URL_HASH SHA256=${glm_sha256}
        DOWNLOAD_EXTRACT_TIMESTAMP ON SOURCE_SUBDIR headers-only)
    FetchContent_MakeAvailable(glm_release)
    add_library(glm::glm INTERFACE IMPORTED GLOBAL)
    target_include_directories(glm::glm INTERFACE "${glm_release_SOURCE_DIR}")
endif()
