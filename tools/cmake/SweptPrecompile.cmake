# The standard headers, read once for all targets that are compiled alike: they are most of what a file of ours takes to
# compile. Included by the top-level list file only.
#
# Off where the project is part of another. That a file includes the headers of what it uses, precompiled or not, is for
# tests/house.
option(SWEPT_PRECOMPILE "Precompile the standard headers" ${PROJECT_IS_TOP_LEVEL})

set(SWEPT_STANDARD_HEADERS <algorithm> <array> <cmath> <functional> <limits> <memory> <optional> <span> <string> <vector>)

# swept_add_prelude(NAME): a target with nothing to compile but its precompiled header, for those that share it. The options
# that it is given have to be theirs; a macro that they define it must not.
function(swept_add_prelude name)
    set(nothing ${CMAKE_CURRENT_BINARY_DIR}/prelude.cpp)
    file(CONFIGURE OUTPUT ${nothing} CONTENT "// Compiled for its precompiled header only.\n")
    add_library(${name} OBJECT EXCLUDE_FROM_ALL ${nothing})
    target_compile_features(${name} PUBLIC cxx_std_20)
    target_precompile_headers(${name} PRIVATE ${ARGN})
    swept_precompile_options(${name})
endfunction()

# swept_share_prelude(TARGET PRELUDE), where there is that prelude
function(swept_share_prelude target prelude)
    if(SWEPT_PRECOMPILE AND TARGET ${prelude})
        target_precompile_headers(${target} REUSE_FROM ${prelude})
        swept_precompile_options(${target})
    endif()
endfunction()

function(swept_precompile_options target)
    if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
        target_compile_options(${target} PRIVATE -fpch-preprocess)  # for ccache
    endif()
endfunction()
