# Debian's mingw-w64 with POSIX threads; libpng and zstd are built into GEOIDX_WIN_PREFIX by scripts/cross.sh.
# Programs run under Wine.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)
set(CMAKE_FIND_ROOT_PATH $ENV{GEOIDX_WIN_PREFIX} /usr/x86_64-w64-mingw32)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(ENV{PKG_CONFIG_LIBDIR} $ENV{GEOIDX_WIN_PREFIX}/lib/pkgconfig)
set(CMAKE_CROSSCOMPILING_EMULATOR wine)
# Windows keeps stacks to 16 bytes: what GCC spills of wider vectors must not count on more (GCC bug 54412).
set(CMAKE_CXX_FLAGS_INIT -Wa,-muse-unaligned-vector-move)
