# An installed library whose headers do not compile, or that does not link, must be left out: configuring succeeds and
# reports it in one line. Configures the real project with a broken package instead of each library. Run by CTest:
#   cmake -DSOURCE=… -DWORK=… -DGENERATOR=Ninja -DPREFIX_PATH=… -P optional_dependencies.cmake
cmake_minimum_required(VERSION 3.25)
include(${CMAKE_CURRENT_LIST_DIR}/checks.cmake)
file(REMOVE_RECURSE "${WORK}")
set(prefix "${WORK}/prefix")

# Like libopenvdb-dev without libboost-dev.
foreach(header openvdb io/File math/Maps)
    file(WRITE "${prefix}/include/openvdb/${header}.h" "#include <nowhere/conversion_traits.hpp>\n")
endforeach()
file(WRITE "${prefix}/lib/libopenvdb.so" "")
# Compiles, but the library lacks what the header declares.
file(WRITE "${prefix}/include/hb.h" "struct hb_buffer_t; hb_buffer_t* hb_buffer_create(); void hb_buffer_destroy(hb_buffer_t*);\n")
file(WRITE "${prefix}/include/hb-ot.h" "")
file(WRITE "${prefix}/include/httplib.h" "#error this compiler is too old\n")
foreach(header mesh_edgebreaker_decoder mesh_sequential_decoder)
    file(WRITE "${prefix}/include/draco/compression/mesh/${header}.h" "#include <nowhere/draco_features.h>\n")
endforeach()
file(WRITE "${prefix}/include/draco/core/varint_decoding.h" "")
file(WRITE "${prefix}/include/meshoptimizer.h" "void meshopt_decodeFilterOct(void*, unsigned, unsigned);\n")
foreach(module harfbuzz cpp-httplib draco)
    string(REPLACE " " "\\ " folders "-I${prefix}/include")
    if(module STREQUAL draco)
        set(folders "-Iinclude ${folders}")  # like draco.pc in Debian 13: CMake rejects relative and missing folders
    endif()
    file(WRITE "${prefix}/lib/pkgconfig/${module}.pc"
        "Name: ${module}\nDescription: a broken package\nVersion: 9.0\nCflags: ${folders}\n")
endforeach()
# Compiles, but the library is not installed.
file(WRITE "${prefix}/include/OpenImageDenoise/oidn.hpp" "namespace oidn {
enum class DeviceType { CPU };
struct Device { void commit() {} };
inline Device newDevice(DeviceType) { return {}; }
}\n")
file(WRITE "${prefix}/include/pybind11/pybind11.h" "inline int version = PYBIND11_VERSION_THAT_IS_MISSING;\n")
foreach(header numpy stl)
    file(WRITE "${prefix}/include/pybind11/${header}.h" "")
endforeach()
foreach(package "OpenImageDenoise;OpenImageDenoise;${prefix}/lib/libnowhere.so" "pybind11;pybind11::module;"
        "meshoptimizer;meshoptimizer::meshoptimizer;")
    list(POP_FRONT package name target library)
    file(WRITE "${prefix}/lib/cmake/${name}/${name}Config.cmake" "
        add_library(${target} INTERFACE IMPORTED)
        target_include_directories(${target} INTERFACE \"${prefix}/include\" \"${prefix}/missing\")
        target_link_libraries(${target} INTERFACE \"${library}\")")
    set(compatible TRUE)
    if(name STREQUAL meshoptimizer)
        set(compatible FALSE)  # like the package itself, which is compatible with no other version
    endif()
    file(WRITE "${prefix}/lib/cmake/${name}/${name}ConfigVersion.cmake" "
        set(PACKAGE_VERSION 9.0)
        set(PACKAGE_VERSION_COMPATIBLE ${compatible})")
endforeach()

# configure(): stores the lines about libraries that are left out in `left_out`, and the names of compiled files in
# `commands`.
function(configure)
    execute_process(WORKING_DIRECTORY "${SOURCE}" RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output
        COMMAND ${CMAKE_COMMAND} --preset quickstart -G "${GENERATOR}" -B "${WORK}/build" -DCMAKE_UNITY_BUILD=OFF
            -DPHASETREE_INSTALL=OFF "-DCMAKE_PREFIX_PATH=${prefix};${PREFIX_PATH}")
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "Configuring with broken packages ended with ${status}\n${output}")
    endif()
    string(REGEX MATCHALL "-- Building without [^\n]*" left_out "${output}")
    file(READ "${WORK}/build/compile_commands.json" commands)
    set(left_out "${left_out}" PARENT_SCOPE)
    set(commands "${commands}" PARENT_SCOPE)
endfunction()

# expect_left_out(BEGINNING REASON INSTALL): one line must name the library, the reason and the package.
function(expect_left_out beginning reason install)
    set(lines ${left_out})
    list(FILTER lines INCLUDE REGEX "^-- Building without ${beginning} \\(.*\\): a test program fails to build: .*${reason}.*apt-get install .*${install}")
    list(LENGTH lines count)
    if(NOT count EQUAL 1)
        string(JOIN "\n" all ${left_out})
        message(FATAL_ERROR "${count} lines say that ${beginning} is left out because of ${reason}, among\n${all}")
    endif()
endfunction()

function(expect_not text part)
    string(FIND "${text}" "${part}" at)
    if(NOT at EQUAL -1)
        message(FATAL_ERROR "\"${part}\" is in ${text}")
    endif()
endfunction()

configure()
expect_left_out(OpenVDB "nowhere/conversion_traits.hpp" "libopenvdb-dev libboost-dev")
expect_left_out(HarfBuzz "hb_buffer_create" libharfbuzz-dev)
expect_left_out("Open Image Denoise 2" "libnowhere" libopenimagedenoise-dev)
expect_left_out(cpp-httplib "this compiler is too old" libcpp-httplib-dev)
expect_left_out(Draco "nowhere/draco_features.h" libdraco-dev)
expect_left_out(meshoptimizer "meshopt_decodeFilterOct" libmeshoptimizer-dev)
expect_left_out("pybind11[^(]*" "PYBIND11_VERSION_THAT_IS_MISSING" pybind11-dev)
list(LENGTH left_out count)
if(NOT count EQUAL 7)
    message(FATAL_ERROR "${count} lines: ${left_out}")
endif()
expect("${commands}" /no_openvdb.cpp /no_harfbuzz.cpp /no_draco.cpp /no_meshopt.cpp /no_open_image_denoise.cpp /no_server.cpp)
foreach(file /openvdb.cpp /vdb_structure.cpp /harfbuzz.cpp /draco.cpp /meshopt.cpp /open_image_denoise.cpp /server.cpp
        plugins/python/src "${prefix}")
    expect_not("${commands}" "${file}")
endforeach()

# A repaired package must be noticed without removing the cache.
file(WRITE "${prefix}/include/hb.h" "inline int hb_buffer_create() { return 1; }\ninline void hb_buffer_destroy(int) {}\n")
configure()
expect_not("${left_out}" HarfBuzz)
expect("${left_out}" OpenVDB cpp-httplib)
expect("${commands}" /harfbuzz.cpp)
expect_not("${commands}" /no_harfbuzz.cpp)
file(REMOVE_RECURSE "${WORK}")
