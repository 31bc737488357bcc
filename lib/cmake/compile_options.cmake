# Compile options of all targets.
#
# -ffp-contract=off: a label must not depend on whether the compiler fused a multiplication with an addition, so that
# the scalar evaluator, every SIMD width and the generated GLSL agree bit for bit.
#
# -fno-tree-slp-vectorize: with this optimisation, which -O3 includes, GCC 12.2 on x86-64 drops conversions from double
# to float and back. The pieces of a Bézier curve (outline_pieces.hpp) then have other bits than with -O2, with Clang or
# on arm64.

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_C_STANDARD 99)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_CXX_VISIBILITY_PRESET hidden)
set(CMAKE_C_VISIBILITY_PRESET hidden)
set(CMAKE_VISIBILITY_INLINES_HIDDEN ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo" FORCE)
endif()

option(PHASETREE_WERROR "Treat warnings as errors" ${PROJECT_IS_TOP_LEVEL})
set(PHASETREE_SANITIZE "" CACHE STRING "Sanitizers to build with: address;undefined or thread")

find_program(PHASETREE_CCACHE ccache)
if(PHASETREE_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
    set(CMAKE_CXX_COMPILER_LAUNCHER "${PHASETREE_CCACHE}")
    set(CMAKE_C_COMPILER_LAUNCHER "${PHASETREE_CCACHE}")
endif()

add_library(phasetree_options INTERFACE)
# GCC 12 reports overlapping copies in std::string that do not exist (its bug 105651).
set(quiet "")
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    set(quiet $<$<COMPILE_LANGUAGE:CXX>:-Wno-restrict>)
endif()
# The code deliberately combines booleans with | and & where a branch would cost more.
if(CMAKE_CXX_COMPILER_ID MATCHES "Clang")
    list(APPEND quiet $<$<COMPILE_LANGUAGE:CXX>:-Wno-bitwise-instead-of-logical>)
endif()

# A unity build compiles several files of a target at a time, so a local name would be reported to hide one of another
# file.
if(CMAKE_UNITY_BUILD)
    list(APPEND quiet $<$<COMPILE_LANGUAGE:CXX>:-Wno-shadow>)
endif()

target_compile_options(phasetree_options INTERFACE
    -ffp-contract=off
    $<$<CXX_COMPILER_ID:GNU>:-fno-tree-slp-vectorize>
    $<$<COMPILE_LANGUAGE:CXX>:-Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion -Wshadow>
    ${quiet}
    $<$<BOOL:${PHASETREE_WERROR}>:-Werror>)

# phasetree_compile_quickly(TARGET): compile with -O1, for code that takes longer to optimise than to run. It is meant
# for code that reads, checks, describes or writes scenes, options and messages, once per node, parameter or option of
# the input. Code that runs once per ray, cell, sample, pixel, triangle or voxel is compiled with -O3. Options of single
# files would exclude these files from unity builds, so such code has its own targets. The CMakeLists.txt of lib, tracer
# and plugins/python choose it by folder or file.
function(phasetree_compile_quickly target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
    # Most of the remaining time is spent on parsing headers.
    set_target_properties(${target} PROPERTIES UNITY_BUILD_BATCH_SIZE 16)
endfunction()

if(PHASETREE_SANITIZE)
    list(JOIN PHASETREE_SANITIZE "," sanitizers)
    add_compile_options(-fsanitize=${sanitizers} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${sanitizers})
endif()

# Instruments all code for the fuzzers, which alone link libFuzzer; see tests/fuzz.
option(PHASETREE_FUZZ "Build the libFuzzer programs of tests/fuzz; Clang only" OFF)
if(PHASETREE_FUZZ)
    add_compile_options(-fsanitize=fuzzer-no-link)
endif()

# Counts with gcov how often each line in these folders runs; see tests/coverage.sh. Everything else is compiled as
# usual.
set(PHASETREE_COVERAGE "" CACHE STRING "Folders to measure line coverage of: lib/src/io;tracer/src/scene …")
if(PHASETREE_COVERAGE)
    add_link_options(--coverage)
endif()
# phasetree_count_lines(TARGET): counts the lines of those of its sources that are in one of the folders.
function(phasetree_count_lines target)
    get_target_property(sources ${target} SOURCES)
    foreach(folder ${PHASETREE_COVERAGE})
        foreach(source ${sources})
            get_filename_component(path ${source} ABSOLUTE)
            string(FIND "${path}" "${PROJECT_SOURCE_DIR}/${folder}/" place)
            if(place EQUAL 0)
                set_property(SOURCE ${source} APPEND PROPERTY COMPILE_OPTIONS --coverage -fprofile-update=atomic -O0)
            endif()
        endforeach()
    endforeach()
endfunction()
