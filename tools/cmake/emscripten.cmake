# Toolchain: WebAssembly by Emscripten, as Debian packages it or as EMSDK points to it, with 128 bits side by side.
find_file(SWEPT_EMSCRIPTEN Emscripten.cmake REQUIRED NO_CMAKE_FIND_ROOT_PATH
          PATHS $ENV{EMSDK}/upstream/emscripten/cmake/Modules/Platform
                /usr/share/emscripten/cmake/Modules/Platform)
include(${SWEPT_EMSCRIPTEN})
set(CMAKE_CXX_FLAGS_INIT "-msimd128 -fno-exceptions")
# Programs (tests) run under Node.js, with the files of this machine and as much memory as they ask for.
set(CMAKE_EXE_LINKER_FLAGS_INIT "-sNODERAWFS=1 -sALLOW_MEMORY_GROWTH=1 -sTOTAL_STACK=1048576")
# What Emscripten 3.1.6 writes takes Node.js for a browser where it offers `fetch`, as it does from 18 on.
find_program(SWEPT_NODE NAMES node nodejs REQUIRED)
set(CMAKE_CROSSCOMPILING_EMULATOR ${SWEPT_NODE} --no-experimental-fetch)
