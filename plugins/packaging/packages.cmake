# cpack -G DEB: a single package with the command, the libraries and the files needed to link them, installed in /usr.
# Other generators (cpack -G TGZ) pack what `cmake --install` installs, for use in any folder.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME phasetree)
set(CPACK_PACKAGE_VENDOR phasetree)
set(CPACK_PACKAGE_CONTACT "${PHASETREE_CONTACT}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "multiphase signed distance fields as Embree geometry")
set(CPACK_PACKAGE_DESCRIPTION
"phasetree models objects of several materials as one tree of signed
distances and traces rays through them from phase to phase, so that glass,
water and sand touch without gaps, overlaps or priorities.
.
This package has the path tracer, the library that makes an Embree geometry
of such a tree, with a C99 interface and a C++ wrapper, the C++ library to
build trees with, and example scenes.")
if(NOT TARGET phasetree-command)
    string(REPLACE "the path tracer, the library" "the library" CPACK_PACKAGE_DESCRIPTION "${CPACK_PACKAGE_DESCRIPTION}")
endif()
set(CPACK_STRIP_FILES ON)
set(CPACK_MONOLITHIC_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Their headers are included by ours.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libembree-dev, libglm-dev, libfmt-dev, libtbb-dev, libhwy-dev, pkgconf")

# The dependencies of other packages that link these libraries, and the trigger that updates the dynamic linker's cache.
set(shlibs "")
foreach(major ${PHASETREE_EMBREE_MAJORS})
    string(APPEND shlibs "libphasetree_embree${major} ${PROJECT_VERSION_MAJOR} phasetree (>= ${PROJECT_VERSION})\n")
endforeach()
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/shlibs" "${shlibs}")
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/shlibs;${CMAKE_CURRENT_BINARY_DIR}/triggers")

# Settings for individual generators are made when cpack runs, which is also when the programs must be installed.
configure_file(cpack.cmake.in cpack.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_BINARY_DIR}/cpack.cmake")
include(CPack)
