# Builds only the libraries for other renderers, with the two commands of plugins/embree/README.md. This must not search
# for any of the path tracer's libraries, and an external program must compile and run with what it installs. The
# libraries themselves are copied from the build under test, which makes them from the same sources, so that nothing is
# compiled twice. Run by CTest:
#   cmake -DSOURCE=… -DBUILD=… -DWORK=… -DMAJOR=3 -DGENERATOR=Ninja -P plugin_only.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/checks.cmake)
file(REMOVE_RECURSE "${WORK}")

# Makes a search for any of these libraries an error.
set(without "")
foreach(package OpenImageIO OpenColorIO CLI11 doctest benchmark)
    list(APPEND without -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
execute_process(WORKING_DIRECTORY "${SOURCE}" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE errors
    COMMAND ${CMAKE_COMMAND} --preset plugin -G "${GENERATOR}" -B "${WORK}/build" ${without}
        -DCMAKE_UNITY_BUILD=OFF  # so that compile_commands.json lists every file
        "-DCMAKE_PREFIX_PATH=${PREFIX_PATH}" "-Dembree_DIR=${EMBREE_DIR}")
if(NOT status EQUAL 0)
    message(FATAL_ERROR "cmake --preset plugin ended with ${status}\n${output}\n${errors}")
endif()
file(READ "${WORK}/build/compile_commands.json" commands)
foreach(word OpenImageIO OpenColorIO CLI11 doctest "${SOURCE}/tracer/" "${SOURCE}/tests/" "${SOURCE}/benchmarks/")
    string(FIND "${commands}" "${word}" at)
    if(NOT at EQUAL -1)
        message(FATAL_ERROR "${word} is in ${WORK}/build/compile_commands.json")
    endif()
endforeach()
file(STRINGS "${WORK}/build/CMakeCache.txt" sought REGEX "OpenColorIO|ocio_")
if(sought)
    list(FILTER sought EXCLUDE REGEX "CMAKE_DISABLE_FIND_PACKAGE")
endif()
if(sought)
    message(FATAL_ERROR "OpenColorIO was looked for: ${sought}")
endif()

file(COPY "${BUILD}/lib/libphasetree.a" DESTINATION "${WORK}/build/lib")
file(GLOB folders RELATIVE "${BUILD}/plugins/embree" "${BUILD}/plugins/embree/embree?")
foreach(folder ${folders})
    file(GLOB libraries "${BUILD}/plugins/embree/${folder}/libphasetree_${folder}.so*")
    file(COPY ${libraries} DESTINATION "${WORK}/build/plugins/embree/${folder}")
endforeach()
run(${CMAKE_COMMAND} --build "${WORK}/build" --target phasetree-reference-pages)
set(prefix "${WORK}/prefix")
run(${CMAKE_COMMAND} --install "${WORK}/build" --prefix "${prefix}")
file(GLOB_RECURSE installed RELATIVE "${prefix}" "${prefix}/*")
expect("${installed}" libphasetree_embree${MAJOR}.so libphasetree.a man3/phasetreeDecodeHit.3 examples/phases.c)
if(installed MATCHES "bin/|man1|\\.ocio")
    message(FATAL_ERROR "something of the command is installed: ${installed}")
endif()

# An external program, in C.
file(WRITE "${WORK}/consumer/CMakeLists.txt" "
    cmake_minimum_required(VERSION 3.25)
    project(consumer LANGUAGES C)
    find_package(phasetree REQUIRED COMPONENTS embree${MAJOR})
    add_executable(phases \"${prefix}/share/doc/phasetree/examples/phases.c\")
    target_link_libraries(phases PRIVATE phasetree::embree${MAJOR} m)")
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S "${WORK}/consumer" -B "${WORK}/consumer/build" "-DCMAKE_C_FLAGS=${FLAGS}"
    "-DCMAKE_PREFIX_PATH=${prefix};${PREFIX_PATH}")
run(${CMAKE_COMMAND} --build "${WORK}/consumer/build")
run("${WORK}/consumer/build/phases" "${prefix}/share/phasetree/scenes/hourglass.json")
expect("${output}" "glass -> sand")
file(REMOVE_RECURSE "${WORK}")
