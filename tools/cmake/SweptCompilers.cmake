# What is asked of compilers, in the words of each: GCC and clang, cl of Visual Studio, and clang-cl, which is clang with the
# command line of cl. Included by the top-level list file only.
option(SWEPT_PLAIN_CPP "The libraries use nothing that only some compilers have, such as vectors: the same bits, slower" OFF)

# (Clang that has the command line of GCC sets MSVC as well where it compiles for Visual Studio.)
if(MSVC AND NOT CMAKE_CXX_COMPILER_FRONTEND_VARIANT STREQUAL "GNU")
    set(SWEPT_CL_OPTIONS ON)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL "MSVC" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 19.30)
    message(FATAL_ERROR "Swept2D: Visual Studio 2022 or later is needed. Compilers before it fuse multiply-add (other bits than "
                        "on other machines), and lack parts of C++20.")
endif()

# Emscripten, in builds of users, takes its machine for x86.
if(EMSCRIPTEN OR CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
    set(SWEPT_WASM ON)
endif()

# Multiply-add is not fused, so that all machines give the same bits. Asked for when it is used: what is built with cl may
# be used with clang-cl. There -ffp-contract=off is passed over, and /fp:precise means to fuse; with cl it means not to.
if(SWEPT_CL_OPTIONS)
    set(SWEPT_NO_FUSING $<IF:$<CXX_COMPILER_ID:MSVC>,/fp:precise,/clang:-ffp-contract=off>)
else()
    set(SWEPT_NO_FUSING -ffp-contract=off)
endif()

# Warnings of our own targets; never handed on to users.
function(swept_warnings target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "MSVC")
        target_compile_options(${target} PRIVATE /W4)
    elseif(SWEPT_CL_OPTIONS)
        target_compile_options(${target} PRIVATE /W4 -Wpedantic -Wconversion -Wshadow)  # -Wall would be each that there is
    else()
        target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    endif()
    if(SWEPT_WERROR)
        target_compile_options(${target} PRIVATE $<IF:$<BOOL:${SWEPT_CL_OPTIONS}>,/WX,-Werror>)
    endif()
endfunction()

# Off for programs, which say things: GCC 12 warns wrongly about `"literal" + std::to_string(i)` (its bug 105651).
function(swept_no_false_alarms target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
endfunction()

# How the code of the libraries is made. What users take over is public on purpose: an inline function compiled with fused
# multiply-add in a user's file could be the copy that the linker keeps for the library too, and then the same bits on every
# machine are lost.
function(swept_code_options target)
    target_compile_options(${target} PUBLIC ${SWEPT_NO_FUSING})
    if(SWEPT_PLAIN_CPP)
        target_compile_definitions(${target} PUBLIC SWEPT_PLAIN_CPP)
    endif()
    # Nobody reads errno after a root: without it a root is one instruction and no call. The same bits.
    if(NOT SWEPT_CL_OPTIONS)
        target_compile_options(${target} PRIVATE -fno-math-errno)
    elseif(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
        target_compile_options(${target} PRIVATE /clang:-fno-math-errno)
    endif()
    # GCC 12 leaves out the rounding of double to float and back where it puts two of them into one vector (basic blocks, not
    # loops): other bits than from any other compiler. The golden test found it.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
        target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize)
    endif()
    # Clang 14 for WebAssembly forgets when a number was loaded that it puts into both halves of a vector (v128.load64_splat):
    # calls and stores that change it may come first. Vectors of basic blocks are where it met that; a layer compiled as one
    # file or not only decides what is inlined. The golden test found it. Public for the reason given above.
    if(SWEPT_WASM)
        target_compile_options(${target} PUBLIC -fno-slp-vectorize)
    endif()
    # Comments of headers are UTF-8, which cl reads as the language of the system, where some characters take the next one
    # along. Its object files hold few sections, for kernels of several instruction sets, unless it is told.
    if(SWEPT_CL_OPTIONS)
        target_compile_options(${target} PUBLIC $<$<CXX_COMPILER_ID:MSVC>:/utf-8> PRIVATE /bigobj)
    endif()
endfunction()
