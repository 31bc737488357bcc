# Installs to a fresh prefix, then builds and runs the examples from there as an external project would, and checks the
# exported symbols of the installed libraries. Run by CTest:
#   cmake -DBUILD=… -DWORK=… -DMAJOR=3 -DCONFIG=Release -DGENERATOR=Ninja -P installed.cmake
cmake_minimum_required(VERSION 3.25)

include(${CMAKE_CURRENT_LIST_DIR}/../packaging/checks.cmake)

file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")
run(${CMAKE_COMMAND} --install "${BUILD}" --prefix "${prefix}" --config "${CONFIG}")

# Required files.
file(GLOB_RECURSE installed RELATIVE "${prefix}" "${prefix}/*")
expect("${installed}" include/phasetree/phasetree_embree.h include/phasetree/phasetree_embree.hpp include/phasetree/embree/hit.h
    include/phasetree/model/handle.hpp libphasetree_embree${MAJOR}.so libphasetree.a cmake/phasetree/phasetreeConfig.cmake
    pkgconfig/phasetree-embree${MAJOR}.pc share/phasetree/scenes/hourglass.json
    share/man/man3/phasetreeDecodeHit.3 share/doc/phasetree/reference.html)
if(EXISTS "${prefix}/bin/phasetree")
    expect("${installed}" share/man/man1/phasetree.1 share/phasetree/phasetree.ocio)
    run("${prefix}/bin/phasetree" --version)
    expect("${output}" "phasetree ")
endif()

# The scene reference shows pictures and examples.
set(reference "${prefix}/share/phasetree/scenes/reference")
file(GLOB pages "${reference}/*.md")
set(count 0)
foreach(page ${pages})
    file(READ "${page}" text)
    string(REGEX MATCHALL "\\([a-z./_-]+\\.(jpg|json)\\)" links "${text}")
    foreach(link ${links})
        string(REGEX REPLACE "^\\((.*)\\)$" "\\1" file "${link}")
        if(NOT EXISTS "${reference}/${file}")
            message(FATAL_ERROR "${page} links ${file}, which is not installed")
        endif()
        math(EXPR count "${count} + 1")
    endforeach()
endforeach()
if(count LESS 300)
    message(FATAL_ERROR "the scene reference has only ${count} links to pictures and examples")
endif()

# Only the interface is exported.
file(GLOB_RECURSE library "${prefix}/*/libphasetree_embree${MAJOR}.so")
run(nm -D --defined-only "${library}")
string(REGEX MATCHALL "[^\n]+" symbols "${output}")
list(LENGTH symbols count)
if(count LESS 30)
    message(FATAL_ERROR "only ${count} symbols are exported:\n${output}")
endif()
foreach(symbol ${symbols})
    if(NOT symbol MATCHES " T phasetree[A-Z][A-Za-z]+$")
        message(FATAL_ERROR "${library} exports \"${symbol}\"")
    endif()
endforeach()

# With CMake. The sanitizers of this build, if any, must also be in those programs.
set(examples "${prefix}/share/doc/phasetree/examples")
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S "${examples}" -B "${WORK}/examples" -DCMAKE_PREFIX_PATH=${prefix} -DEMBREE=${MAJOR}
    -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_C_FLAGS=-Wall -Wextra -Werror ${FLAGS}" "-DCMAKE_CXX_FLAGS=-g0 ${FLAGS}")
run(${CMAKE_COMMAND} --build "${WORK}/examples" --parallel 2)
run("${WORK}/examples/phases" "${prefix}/share/phasetree/scenes/hourglass.json" 0 0.01 10 0 0 -1)
expect("${output}" "vacuum -> wood" "vacuum -> sand" "wood -> vacuum")
run("${WORK}/examples/measure" "${prefix}/share/phasetree/scenes/hourglass.json")
expect("${output}" "glass: volume 0." "sand: volume 0." "in one piece: ")
run("${WORK}/examples/built")
expect("${output}" "from water, glass is 0.450 away")
run("${WORK}/examples/tree")
expect("${output}" "z =  0.200: from phase 0 to phase 2")
foreach(name renderer stock)
    run("${WORK}/examples/${name}" "${WORK}/${name}.ppm")
    file(SIZE "${WORK}/${name}.ppm" size)
    if(NOT size EQUAL 460815)
        message(FATAL_ERROR "${name}.ppm has ${size} bytes")
    endif()
endforeach()
# The tutorial's renderer is a project of its own.
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S "${examples}/small_renderer" -B "${WORK}/small_renderer" -DCMAKE_PREFIX_PATH=${prefix}
    -DEMBREE=${MAJOR} -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS=-g0 -Wall -Wextra -Werror ${FLAGS}")
run(${CMAKE_COMMAND} --build "${WORK}/small_renderer")
run("${WORK}/small_renderer/small_renderer" "${prefix}/share/phasetree/scenes/hourglass.json" "${WORK}/small_renderer.ppm")
file(SIZE "${WORK}/small_renderer.ppm" size)
if(NOT size EQUAL 307215)
    message(FATAL_ERROR "small_renderer.ppm has ${size} bytes")
endif()
# An error is reported and does not crash the program.
execute_process(COMMAND "${WORK}/examples/phases" /no/such.json RESULT_VARIABLE status ERROR_VARIABLE errors)
if(NOT status EQUAL 1)
    message(FATAL_ERROR "phases of a missing file ended with ${status}")
endif()
expect("${errors}" "/no/such.json")

# Without a choice, the newest installed Embree is used.
file(GLOB_RECURSE majors "${prefix}/*/phasetree-embree?.cmake")
list(SORT majors ORDER DESCENDING)
list(GET majors 0 newest)
string(REGEX REPLACE ".*embree([34])\\.cmake$" "phasetree::embree\\1" newest "${newest}")
run(${CMAKE_COMMAND} -G "${GENERATOR}" -S "${examples}" -B "${WORK}/examples-default" -DCMAKE_PREFIX_PATH=${prefix})
expect("${output}" "The examples use ${newest}\n")

# With pkg-config.
find_program(pkg_config pkg-config)
find_program(compiler NAMES cc gcc clang)
if(pkg_config AND compiler)
    file(GLOB_RECURSE description "${prefix}/*/phasetree-embree${MAJOR}.pc")
    get_filename_component(folder "${description}" DIRECTORY)
    set(ENV{PKG_CONFIG_PATH} "${folder}")
    run("${pkg_config}" --cflags --libs phasetree-embree${MAJOR})
    separate_arguments(arguments UNIX_COMMAND "${output} ${FLAGS}")
    get_filename_component(libraries "${library}" DIRECTORY)
    run("${compiler}" -std=c99 "${examples}/phases.c" -o "${WORK}/phases" ${arguments} -lm -Wl,-rpath,${libraries}
        ${RPATH})
    run("${WORK}/phases" "${prefix}/share/phasetree/scenes/hourglass.json")
    expect("${output}" "glass -> sand")
    run("${compiler}" -std=c99 -Wall -Wextra -pedantic -Werror "${examples}/measure.c" -o "${WORK}/measure" ${arguments}
        -lm -Wl,-rpath,${libraries} ${RPATH})
    run("${compiler}" -std=c99 -Wall -Wextra -pedantic -Werror -c "${CMAKE_CURRENT_LIST_DIR}/names_0_9.c" -o
        "${WORK}/names_0_9.o" ${arguments})
endif()
