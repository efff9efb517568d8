# How a layer becomes its targets. Included by the top-level list file only.

# Users write <swept/engine/world.h>; inside the tree that is the source root seen through a link.
set(SWEPT_INCLUDE_DIR ${PROJECT_BINARY_DIR}/include)
file(MAKE_DIRECTORY ${SWEPT_INCLUDE_DIR})
swept_link_folder(${PROJECT_SOURCE_DIR} ${SWEPT_INCLUDE_DIR}/swept)

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
    swept_code_options(${target})
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
    if(MSVC)  # whose standard library is another one in Debug, so that games link either
        set_target_properties(${target} PROPERTIES DEBUG_POSTFIX d)
    endif()
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
