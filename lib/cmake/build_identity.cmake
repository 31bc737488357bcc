# Writes version.cpp, which contains the build identity of phasetree. Every build whose sources have changed runs it:
#   cmake -DSOURCE=… -DBINARY=… -DOUTPUT=…/version.cpp -DVERSION=0.9.0 -DCOMPILER="GNU 12.2.0" -DPROCESSOR=x86_64
#         [-DGIT=git] -P build_identity.cmake
# DEPENDENCIES=FILE also writes a list of everything that was read, for ninja and make. TEMPLATE=FILE replaces
# src/version.cpp.in.
#
# The identity is a hash of the compiler, the processor architecture, and the content of all files that affect the
# results of the libraries and the command. It does not depend on git: a checkout, an archive and a modified copy of
# either have the same identity exactly if these files are equal. The compiler is included because it evaluates
# functions of constants itself and has its own standard library. The architecture is included because the functions of
# the C library differ: atan2f and log1pf, for example, round differently on arm64. Flags are not included, because
# results must not depend on optimisation, and flags may contain paths.
cmake_minimum_required(VERSION 3.25)

# The folders and the kinds of files that the build compiles, embeds or reads. Documents are not included.
set(folders lib tracer plugins/embree)
set(kinds c h cpp hpp inl in cmake css html js map ocio)
set(names "CMakeLists.txt")

# These files in the folders; and all folders, whose modification times change when a file is added or removed.
set(files CMakeLists.txt)
set(read "")
list(JOIN kinds "|" pattern)
foreach(folder ${folders})
    list(APPEND read "${SOURCE}/${folder}")
    file(GLOB_RECURSE found LIST_DIRECTORIES true "${SOURCE}/${folder}/*")
    foreach(path ${found})
        cmake_path(IS_PREFIX BINARY "${path}" is_built)
        if(is_built)
            continue()
        elseif(IS_DIRECTORY "${path}")
            list(APPEND read "${path}")
        elseif(path MATCHES "/([^/.][^/]*\\.(${pattern})|${names})$")
            file(RELATIVE_PATH path "${SOURCE}" "${path}")
            list(APPEND files "${path}")
        endif()
    endforeach()
endforeach()
list(SORT files)

set(text "${COMPILER}\n${PROCESSOR}\n")
foreach(file ${files})
    file(SHA256 "${SOURCE}/${file}" hash)
    string(APPEND text "${hash} ${file}\n")
    list(APPEND read "${SOURCE}/${file}")
endforeach()
string(SHA256 IDENTITY "${text}")
string(SUBSTRING "${IDENTITY}" 0 12 IDENTITY)

# git(RESULT ARGUMENT…): the output of git, or nothing if it fails.
function(git result)
    execute_process(COMMAND "${GIT}" --no-optional-locks -C "${SOURCE}" ${ARGN}
        OUTPUT_VARIABLE output ERROR_QUIET RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        set(output "")
    endif()
    set(${result} "${output}" PARENT_SCOPE)
endfunction()

# The commit. `git archive` writes it to commit.txt; in a checkout, git provides it.
file(STRINGS "${CMAKE_CURRENT_LIST_DIR}/commit.txt" COMMIT REGEX "^[0-9a-f]+$")
if(COMMIT STREQUAL "" AND GIT)
    # git sets this when it runs a hook.
    unset(ENV{GIT_DIR})
    unset(ENV{GIT_WORK_TREE})
    unset(ENV{GIT_INDEX_FILE})
    # If the sources are a folder of another repository, its commits do not identify them.
    git(place rev-parse --show-prefix --git-path logs/HEAD)
    if(place MATCHES "^\n([^\n]+)\n$")
        cmake_path(ABSOLUTE_PATH CMAKE_MATCH_1 BASE_DIRECTORY "${SOURCE}" OUTPUT_VARIABLE log)
        if(EXISTS "${log}")
            list(APPEND read "${log}")
        endif()
        set(paths CMakeLists.txt)
        foreach(folder ${folders})
            foreach(kind ${kinds})
                list(APPEND paths "${folder}/*.${kind}")
            endforeach()
            list(APPEND paths "${folder}/${names}" "${folder}/*/${names}")
        endforeach()
        git(COMMIT log -1 --format=%H -- ${paths})
        git(changes status --porcelain -- ${paths})
    endif()
endif()
string(SUBSTRING "${COMMIT}" 0 12 COMMIT)
if(NOT "${changes}" STREQUAL "")
    string(APPEND COMMIT " with changes")
endif()

if(NOT TEMPLATE)
    set(TEMPLATE "${CMAKE_CURRENT_LIST_DIR}/../src/version.cpp.in")
endif()
# Does not touch the file if its content is unchanged.
configure_file("${TEMPLATE}" "${OUTPUT}" @ONLY)
if(DEPENDENCIES)
    list(TRANSFORM read REPLACE "([ #])" "\\\\\\1")
    list(JOIN read " \\\n  " read)
    file(WRITE "${DEPENDENCIES}" "${OUTPUT}: \\\n  ${read}\n")
endif()
