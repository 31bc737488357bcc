# cpack -G DEB: one package with the command, the libraries and what is needed to link them, installed in /usr. Other
# generators (cpack -G TGZ) pack what `cmake --install` puts into a folder, and that folder may be anywhere.
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
# The headers include theirs.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libembree-dev, libglm-dev, libfmt-dev, libtbb-dev, libhwy-dev, pkgconf")

# What packages of others' programs depend on that link these libraries; and who tells the dynamic linker of them.
set(shlibs "")
foreach(major ${PHASETREE_EMBREE_MAJORS})
    string(APPEND shlibs "libphasetree_embree${major} ${PROJECT_VERSION_MAJOR} phasetree (>= ${PROJECT_VERSION})\n")
endforeach()
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/shlibs" "${shlibs}")
file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/shlibs;${CMAKE_CURRENT_BINARY_DIR}/triggers")

# What is particular to a generator is said when cpack runs; it is then, too, that the programs must be there.
configure_file(cpack.cmake.in cpack.cmake @ONLY)
set(CPACK_PROJECT_CONFIG_FILE "${CMAKE_CURRENT_BINARY_DIR}/cpack.cmake")
include(CPack)
