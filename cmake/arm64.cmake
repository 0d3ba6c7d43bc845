# Toolchain file: builds Tern for arm64 on another machine, against the libraries in the folder TERN_SYSROOT. cmake/arm64.sh
# makes that folder and calls CMake with this file.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR aarch64)
if(NOT TERN_SYSROOT)
  set(TERN_SYSROOT $ENV{TERN_SYSROOT})
endif()
set(CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TERN_SYSROOT)
set(CMAKE_SYSROOT ${TERN_SYSROOT})
set(CMAKE_CXX_COMPILER aarch64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
# Libraries and headers are the sysroot's; programs, as lcm-gen, are this machine's.
set(CMAKE_FIND_ROOT_PATH ${TERN_SYSROOT})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
# ipopt.pc lies in usr/lib/pkgconfig.
set(ENV{PKG_CONFIG_SYSROOT_DIR} ${TERN_SYSROOT})
set(ENV{PKG_CONFIG_LIBDIR}
  ${TERN_SYSROOT}/usr/lib/aarch64-linux-gnu/pkgconfig:${TERN_SYSROOT}/usr/lib/pkgconfig:${TERN_SYSROOT}/usr/share/pkgconfig)
set(ENV{PKG_CONFIG_PATH} "")
# Debian's libblas and liblapack lie in folders of their own, found through alternatives on a running system.
add_link_options(-Wl,-rpath-link,${TERN_SYSROOT}/usr/lib/aarch64-linux-gnu/blas
                 -Wl,-rpath-link,${TERN_SYSROOT}/usr/lib/aarch64-linux-gnu/lapack)
