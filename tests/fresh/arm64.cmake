# A toolchain file for CMake, used by arm64.sh. It compiles for arm64 with Debian's cross compiler against the packages
# in $PHASETREE_ARM64_ROOT, and runs the results in qemu.
set(root "$ENV{PHASETREE_ARM64_ROOT}")
set(triplet aarch64-linux-gnu)
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_C_COMPILER ${triplet}-gcc)
set(CMAKE_CXX_COMPILER ${triplet}-g++)
# GCC explains for each std::pair of doubles that its calling convention was different before version 10.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
set(CMAKE_SYSROOT "${root}")
set(CMAKE_FIND_ROOT_PATH "${root}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${root}")
set(ENV{PKG_CONFIG_LIBDIR} "${root}/usr/lib/${triplet}/pkgconfig:${root}/usr/share/pkgconfig")
# BLAS and LAPACK are in folders of their own. Installing their packages would create links to them, but the packages
# are only unpacked.
set(libraries "/usr/lib/${triplet}")
set(CMAKE_CROSSCOMPILING_EMULATOR
    "qemu-aarch64-static;-L;${root};-E;LD_LIBRARY_PATH=${libraries}/blas:${libraries}/lapack")
set(CMAKE_EXE_LINKER_FLAGS_INIT
    "-Wl,-rpath-link,${root}${libraries}/blas -Wl,-rpath-link,${root}${libraries}/lapack")
