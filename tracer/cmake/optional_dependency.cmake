# Optional libraries. An installed library is used only if a small program that includes the same headers as our sources
# compiles and links. A package may lack a dependency of its headers: Debian's libopenvdb-dev, for example, includes
# Boost's headers but does not depend on libboost-dev.

# phasetree_optional_dependency(VARIABLE
#     NAME name             its name in messages
#     LOSS text             what does not work without it
#     INSTALL text          how to install it
#     REQUIRES variable…    variables that find_package and the like set to true if they found it
#     FOLDERS folder…       the sources that use it
#     HEADERS regex         the beginning of the paths of its headers
#     USE statements        C++ that needs the library when it is linked
#     LIBRARIES target…     imported targets to compile and link with
#     [OPTIONS option…]     compiler options
#     [LINK_OPTIONS option…])
#
# Sets the cache variable VARIABLE. If it is false, prints one line with the reason and how to install the library. Only
# success is cached, so a later configure run notices a library that has been installed or repaired.
function(phasetree_optional_dependency variable)
    cmake_parse_arguments(PARSE_ARGV 1 arg "" "NAME;LOSS;INSTALL;HEADERS;USE"
        "REQUIRES;FOLDERS;LIBRARIES;OPTIONS;LINK_OPTIONS")
    set(reason "")
    foreach(found ${arg_REQUIRES})
        if(NOT ${found})
            set(reason "not found")
        endif()
    endforeach()
    if(NOT reason)
        phasetree_drop_missing_folders(${arg_LIBRARIES})
        phasetree_included_headers(headers "${arg_HEADERS}" ${arg_FOLDERS})
        string(JOIN "\n" program ${headers} "int main() {" "    ${arg_USE}" "}")
        phasetree_probe_key(key "${program}" "${arg_LIBRARIES}" "${arg_OPTIONS}" "${arg_LINK_OPTIONS}")
        if(NOT "${${variable}_PROBED}" STREQUAL key)
            phasetree_probe(reason "${variable}" "${program}" "${arg_LIBRARIES}" "${arg_OPTIONS}" "${arg_LINK_OPTIONS}")
        endif()
    endif()
    if(reason)
        unset(${variable}_PROBED CACHE)
        set(${variable} FALSE CACHE INTERNAL "")
        message(STATUS "Building without ${arg_NAME} (${arg_LOSS}): ${reason} (${arg_INSTALL})")
    else()
        set(${variable}_PROBED "${key}" CACHE INTERNAL "")
        set(${variable} TRUE CACHE INTERNAL "")
    endif()
endfunction()

# Collects the #include lines for such headers from all sources below the folders, without duplicates.
function(phasetree_included_headers result regex)
    set(headers "")
    foreach(folder ${ARGN})
        file(GLOB_RECURSE files "${folder}/*.cpp" "${folder}/*.hpp")
        foreach(file ${files})
            file(STRINGS "${file}" lines REGEX "^#include <${regex}")
            list(APPEND headers ${lines})
        endforeach()
    endforeach()
    if(NOT headers)
        message(FATAL_ERROR "No source below ${ARGN} includes <${regex}…>")
    endif()
    list(REMOVE_DUPLICATES headers)
    set(${result} "${headers}" PARENT_SCOPE)
endfunction()

# Removes include directories that do not exist from imported targets, because CMake would stop with an error. Debian 13's
# draco.pc has `includedir=include`; the headers are in /usr/include, where the compiler finds them anyway.
function(phasetree_drop_missing_folders)
    foreach(library ${ARGN})
        if(NOT TARGET ${library})
            continue()
        endif()
        get_target_property(is_imported ${library} IMPORTED)
        get_target_property(folders ${library} INTERFACE_INCLUDE_DIRECTORIES)
        if(is_imported AND folders)
            set(existing "")
            foreach(folder ${folders})
                if(folder MATCHES "^\\$<" OR (IS_ABSOLUTE "${folder}" AND EXISTS "${folder}"))
                    list(APPEND existing "${folder}")
                endif()
            endforeach()
            set_property(TARGET ${library} PROPERTY INTERFACE_INCLUDE_DIRECTORIES ${existing})
        endif()
        get_target_property(needed ${library} INTERFACE_LINK_LIBRARIES)
        if(needed)
            phasetree_drop_missing_folders(${needed})
        endif()
    endforeach()
endfunction()

# Everything that affects the outcome of a probe, except changes to the library's own files.
function(phasetree_probe_key result program libraries options link_options)
    set(inputs "${program}" "${options}" "${link_options}" "${CMAKE_CXX_COMPILER}" "${CMAKE_CXX_COMPILER_VERSION}"
        "${CMAKE_CXX_FLAGS}")
    foreach(library ${libraries})
        foreach(property INTERFACE_INCLUDE_DIRECTORIES INTERFACE_LINK_LIBRARIES IMPORTED_LOCATION)
            get_target_property(value ${library} ${property})
            list(APPEND inputs "${library}" "${value}")
        endforeach()
    endforeach()
    string(SHA1 key "${inputs}")
    set(${result} "${key}" PARENT_SCOPE)
endfunction()

# Compiles and links the program. The result is empty, or the first error.
function(phasetree_probe result variable program libraries options link_options)
    set(source "${CMAKE_CURRENT_BINARY_DIR}/probes/${variable}.cpp")
    file(WRITE "${source}" "${program}\n")
    set(locale "$ENV{LC_ALL}")
    set(ENV{LC_ALL} C)
    try_compile(works SOURCES "${source}" COMPILE_DEFINITIONS ${options} LINK_OPTIONS ${link_options}
        LINK_LIBRARIES ${libraries} OUTPUT_VARIABLE output
        CXX_STANDARD 20 CXX_STANDARD_REQUIRED ON CXX_EXTENSIONS OFF)
    set(ENV{LC_ALL} "${locale}")
    set(reason "")
    if(NOT works)
        # "collect2: error: ld returned 1" follows the linker's own message.
        foreach(regex "[^\n]*error: [^\n]*" "[^\n]*(undefined|cannot find|relocation)[^\n]*" "[^\n]+\n?$")
            string(REGEX MATCH "${regex}" error "${output}")
            if(error AND NOT error MATCHES "^collect2|linker command failed")
                break()
            endif()
        endforeach()
        string(REPLACE "${source}" "the program" error "${error}")
        string(REGEX REPLACE "^Run Build Command.* && " "" error "${error}")  # ninja's own errors follow it
        string(STRIP "${error}" error)
        set(reason "a test program fails to build: ${error}")
    endif()
    unset(works CACHE)
    set(${result} "${reason}" PARENT_SCOPE)
endfunction()
