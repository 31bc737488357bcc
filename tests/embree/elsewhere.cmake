# Configures this project with an Embree outside the system's folders, as if the user had built it, and checks what
# would be installed: programs must find that Embree by themselves, and packages must tell others where it is. Builds
# nothing. Run by CTest:
#   cmake -DSOURCE=… -DWORK=… -DMAJOR=3 -DGENERATOR=Ninja -DLIBRARY=… -DINCLUDE=… -P elsewhere.cmake
cmake_minimum_required(VERSION 3.25)

# Outside the project, because CMake removes folders inside it from the run path.
set(temporary "$ENV{TMPDIR}")
if(NOT IS_DIRECTORY "${temporary}")
    set(temporary /tmp)
endif()
string(RANDOM LENGTH 12 name)
set(prefix "${temporary}/phasetree-${name}")

function(fail)
    file(REMOVE_RECURSE "${prefix}")
    message(FATAL_ERROR ${ARGN})
endfunction()

function(expect file)
    file(READ "${file}" text)
    foreach(part ${ARGN})
        if(NOT text MATCHES "${part}")
            fail("\"${part}\" is not in ${file}:\n${text}")
        endif()
    endforeach()
endfunction()

# The installed Embree, in that folder.
file(GLOB files "${LIBRARY}/libembree${MAJOR}.so*")
foreach(file ${files})
    get_filename_component(file_name "${file}" NAME)
    file(REAL_PATH "${file}" real)
    file(MAKE_DIRECTORY "${prefix}/lib")
    file(CREATE_LINK "${real}" "${prefix}/lib/${file_name}" SYMBOLIC)
endforeach()
file(MAKE_DIRECTORY "${prefix}/include" "${prefix}/package")
file(CREATE_LINK "${INCLUDE}/embree${MAJOR}" "${prefix}/include/embree${MAJOR}" SYMBOLIC)
file(WRITE "${prefix}/package/embree-config.cmake" "
    add_library(embree SHARED IMPORTED)
    set_target_properties(embree PROPERTIES
        IMPORTED_LOCATION_RELEASE \"${prefix}/lib/libembree${MAJOR}.so\"
        IMPORTED_LOCATION \"${prefix}/lib/libembree${MAJOR}.so\"
        INTERFACE_INCLUDE_DIRECTORIES \"${prefix}/include\")
    set(embree_FOUND TRUE)")
file(WRITE "${prefix}/package/embree-config-version.cmake" "
    set(PACKAGE_VERSION ${MAJOR}.99)
    if(PACKAGE_FIND_VERSION_MAJOR EQUAL ${MAJOR})
        set(PACKAGE_VERSION_COMPATIBLE TRUE)
    endif()")

file(REMOVE_RECURSE "${WORK}")
execute_process(COMMAND ${CMAKE_COMMAND} -G "${GENERATOR}" -S "${SOURCE}" -B "${WORK}" -DCMAKE_BUILD_TYPE=Release
    -DPHASETREE_EMBREE_VERSION=${MAJOR} -Dembree_DIR=${prefix}/package -DPHASETREE_BUILD_TESTS=OFF
    RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors)
if(NOT status EQUAL 0)
    fail("cmake ended with ${status}\n${output}\n${errors}")
endif()

string(REPLACE "." "\\." folder "${prefix}")
set(packaging "${WORK}/plugins/packaging")
file(GLOB_RECURSE scripts "${WORK}/*/cmake_install.cmake")
set(install "")
foreach(script ${scripts})
    file(READ "${script}" text)
    string(APPEND install "${text}\n")
endforeach()
file(WRITE "${WORK}/install.cmake" "${install}")
expect("${WORK}/install.cmake"
    # CMake 3.31 checks the files in a loop, earlier versions one by one.
    "libphasetree_embree${MAJOR}\\.so[^\n]*\"\n( *\\)\n[^\n]*\n[^\n]*\n[^\n]*RPATH_CHECK\n[^\n]*\n)?[^\n]*RPATH \"${folder}/lib\""
    "/bin/phasetree\"\n[^\n]*RPATH \"${folder}/lib\"")
expect("${packaging}/libraries/phasetreeConfig.cmake"
    "find_path\\(PHASETREE_[^\n]*HINTS \"${folder}/include\"" "find_library\\(PHASETREE_[^\n]*HINTS \"${folder}/lib\"")
expect("${packaging}/libraries/phasetree-embree${MAJOR}.pc" "Cflags:[^\n]* -I${folder}/include" "Libs:[^\n]* -L${folder}/lib -lembree")
# cpack reports that a package cannot depend on it.
expect("${packaging}/cpack.cmake" "set\\(embree_folders \"${folder}/lib\"\\)")
file(REMOVE_RECURSE "${prefix}" "${WORK}")
