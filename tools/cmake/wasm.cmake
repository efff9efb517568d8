# Toolchain: 32-bit WebAssembly with WASI, by clang 14, wasi-libc and libc++ as Debian packages them. No threads, no exceptions.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_CXX_COMPILER clang++-14)
set(CMAKE_CXX_COMPILER_TARGET wasm32-wasi)
set(CMAKE_AR llvm-ar-14)
set(CMAKE_RANLIB llvm-ranlib-14)
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fno-exceptions")
# A stack of a megabyte, below all data: where it ends the program ends, too. The linker's own choice is 64 KiB, above them.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,-z,stack-size=1048576 -Wl,--stack-first")
set(CMAKE_EXECUTABLE_SUFFIX_CXX .wasm)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

find_program(SWEPT_NODE NAMES node nodejs REQUIRED)
set(CMAKE_CROSSCOMPILING_EMULATOR ${SWEPT_NODE} --no-warnings ${CMAKE_CURRENT_LIST_DIR}/run_wasm.mjs)
