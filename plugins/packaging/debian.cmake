# cpack -G DEB, after configuring with -DCMAKE_INSTALL_PREFIX=/usr: one package with the command, the libraries and what is needed to link them.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME phasetree)
set(CPACK_PACKAGE_VENDOR phasetree)
set(CPACK_PACKAGE_CONTACT "phasetree <phasetree@users.noreply.github.com>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "multiphase signed distance fields as Embree geometry")
set(CPACK_PACKAGE_DESCRIPTION
"phasetree models objects of several materials as one tree of signed
distances and traces rays through them from phase to phase, so that glass,
water and sand touch without gaps, overlaps or priorities.
.
This package has the path tracer, the library that makes an Embree geometry
of such a tree, with a C99 interface and a C++ wrapper, the C++ library to
build trees with, and example scenes.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};${PROJECT_NAME};ALL;/")
set(CPACK_STRIP_FILES ON)
set(CPACK_MONOLITHIC_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_HOMEPAGE ${PROJECT_HOMEPAGE_URL})
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
find_program(PHASETREE_SHLIBDEPS dpkg-shlibdeps)
mark_as_advanced(PHASETREE_SHLIBDEPS)
# Of an Embree that no package brought no dependency can be told.
if(PHASETREE_SHLIBDEPS AND NOT embree_library_hints)
    set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
endif()
# The headers include theirs.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libembree-dev, libglm-dev, libfmt-dev, libtbb-dev, libhwy-dev, pkgconf")

file(WRITE "${CMAKE_CURRENT_BINARY_DIR}/triggers" "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA "${CMAKE_CURRENT_BINARY_DIR}/triggers")
# lintian misses a Debian changelog: there is none, as this is no distribution's package.
include(CPack)
