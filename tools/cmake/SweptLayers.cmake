# How a layer becomes its targets. Included by the top-level list file only.

# Users write <swept/engine/world.h>; inside the tree that is the source root seen through a link.
set(SWEPT_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${SWEPT_INCLUDE_DIR})
file(CREATE_LINK ${PROJECT_SOURCE_DIR} ${SWEPT_INCLUDE_DIR}/swept SYMBOLIC)

# Emscripten, in builds of users, takes its machine for x86.
if(EMSCRIPTEN OR CMAKE_SYSTEM_PROCESSOR STREQUAL wasm32)
    set(SWEPT_WASM ON)
endif()

# Warnings of our own targets; never handed on to users.
function(swept_warnings target)
    target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wconversion -Wshadow)
    if(SWEPT_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()

# Off for programs, which say things: GCC 12 warns wrongly about `"literal" + std::to_string(i)` (its bug 105651).
function(swept_no_false_alarms target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
    endif()
endfunction()

# For what takes longer to compile with full optimisation than it ever runs: tools, the reader of scenes. What is measured,
# or works hard in a test, is not among it. `None` is what the presets with sanitizers are built as, with -O1.
function(swept_optimise_little target)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1> $<$<CONFIG:None>:-O0>)
    swept_unite(${target})
endfunction()

# What every library target of ours is compiled with; the options that users take over are public.
function(swept_layer_options target)
    swept_warnings(${target})
    target_compile_features(${target} PUBLIC cxx_std_20)
    set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
    if(NOT SWEPT_WASM)  # where it goes through tables for nothing
        set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
    endif()
    # Public on purpose: an inline function compiled with fused multiply-add in a user's file could be the copy that the
    # linker keeps for the library too, and then the same bits on every machine are lost.
    target_compile_options(${target} PUBLIC -ffp-contract=off)
    # Nobody reads errno after a root: without it a root is one instruction and no call. The same bits.
    target_compile_options(${target} PRIVATE -fno-math-errno)
    # GCC 12 leaves out the rounding of double to float and back where it puts two of them into one vector (basic blocks, not
    # loops): other bits than from any other compiler. The golden test found it.
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -fno-tree-slp-vectorize)
    endif()
    # Clang 14 for WebAssembly forgets when a number was loaded that it puts into both halves of a vector (v128.load64_splat):
    # calls and stores that change it may come first. Vectors of basic blocks are where it met that; a layer compiled as one
    # file or not only decides what is inlined. The golden test found it. Public for the reason given above.
    if(SWEPT_WASM)
        target_compile_options(${target} PUBLIC -fno-slp-vectorize)
    endif()
endfunction()

# What they share of precompiled headers; with sanitizers (`None`) some are not optimised, see below.
if(SWEPT_PRECOMPILE)
    swept_add_prelude(swept_layer_prelude ${SWEPT_STANDARD_HEADERS})
    swept_layer_options(swept_layer_prelude)
    if(CMAKE_BUILD_TYPE STREQUAL None)
        swept_add_prelude(swept_plain_layer_prelude ${SWEPT_STANDARD_HEADERS})
        swept_layer_options(swept_plain_layer_prelude)
        target_compile_options(swept_plain_layer_prelude PRIVATE -O0)
    endif()
endif()

# swept_configure_library(TARGET EXPORT-NAME [PLAIN]): common to every library target of ours. PLAIN: not optimised with
# sanitizers.
function(swept_configure_library target export_name)
    swept_layer_options(${target})
    if("PLAIN" IN_LIST ARGN AND CMAKE_BUILD_TYPE STREQUAL None)
        target_compile_options(${target} PRIVATE -O0)
        swept_share_prelude(${target} swept_plain_layer_prelude)
    else()
        swept_share_prelude(${target} swept_layer_prelude)
    endif()
    swept_unite(${target})
    set_target_properties(${target} PROPERTIES EXPORT_NAME ${export_name})
    target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${SWEPT_INCLUDE_DIR}> $<INSTALL_INTERFACE:include>)
    if(NOT PROJECT_IS_TOP_LEVEL AND NOT SWEPT_INSTALL)
        set_target_properties(${target} PROPERTIES EXCLUDE_FROM_ALL ON)  # of both precisions a game links one
    endif()
    add_library(swept2d::${export_name} ALIAS ${target})
    set_property(GLOBAL APPEND PROPERTY SWEPT_EXPORTED_TARGETS ${target})
endfunction()

# swept_add_layer(NAME SOURCES file... [NEEDS layer...] [NEEDS_ONCE target...])
# Compiles a layer twice, as swept_NAME_f32 and swept_NAME_f64. NEEDS_ONCE names targets that exist once (swept_toi).
function(swept_add_layer name)
    cmake_parse_arguments(LAYER "" "" "SOURCES;NEEDS;NEEDS_ONCE" ${ARGN})
    foreach(precision f32 f64)
        set(target swept_${name}_${precision})
        add_library(${target} STATIC ${LAYER_SOURCES})
        set(options "")
        if(precision STREQUAL f64 AND NOT name STREQUAL shapes)  # which works for all of toi/
            set(options PLAIN)  # they run little with sanitizers, but for the long run: compiled in half the time
        endif()
        swept_configure_library(${target} ${name}_${precision} ${options})
        if(precision STREQUAL f64)
            target_compile_definitions(${target} PUBLIC SWEPT_F64)
        endif()
        foreach(needed IN LISTS LAYER_NEEDS)
            target_link_libraries(${target} PUBLIC swept_${needed}_${precision})
        endforeach()
        target_link_libraries(${target} PUBLIC ${LAYER_NEEDS_ONCE})
    endforeach()
endfunction()
