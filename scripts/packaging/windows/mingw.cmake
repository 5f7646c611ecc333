# Compiles for Windows on x86-64 by MinGW-w64 (Debian: g++-mingw-w64-x86-64-posix): scripts/dev/build_windows.
set(CMAKE_SYSTEM_NAME Windows)
set(CMAKE_SYSTEM_PROCESSOR x86_64)
# Of MinGW's two libraries of threads, the one that has std::thread.
set(CMAKE_C_COMPILER x86_64-w64-mingw32-gcc-posix)
set(CMAKE_CXX_COMPILER x86_64-w64-mingw32-g++-posix)
set(CMAKE_RC_COMPILER x86_64-w64-mingw32-windres)

# GCC cannot align the stack to the 32 bytes that it takes for granted where it stores AVX registers (GCC bug 54412).
foreach(language C CXX)
  set(CMAKE_${language}_FLAGS_INIT -Wa,-muse-unaligned-vector-move)
endforeach()
# Windows 7 or later, as oneTBB needs.
add_compile_definitions(_WIN32_WINNT=0x0601)
# Programs and libraries need no files of MinGW's beside them.
set(CMAKE_EXE_LINKER_FLAGS_INIT -static)
set(CMAKE_SHARED_LINKER_FLAGS_INIT -static)
set(CMAKE_MODULE_LINKER_FLAGS_INIT -static)

# Packages are those that scripts/packaging/windows/dependencies prepared, and not this machine's.
if(GPU_SHADING_WINDOWS_DEPENDENCIES)
  list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES GPU_SHADING_WINDOWS_DEPENDENCIES)
  set(CMAKE_FIND_ROOT_PATH ${GPU_SHADING_WINDOWS_DEPENDENCIES} /usr/x86_64-w64-mingw32)
  set(ENV{PKG_CONFIG_LIBDIR} ${GPU_SHADING_WINDOWS_DEPENDENCIES}/lib/pkgconfig)
else()
  set(CMAKE_FIND_ROOT_PATH /usr/x86_64-w64-mingw32)
endif()
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
