# Several sources compiled as one: what they include is read once for all of them. Included by the top-level list file only.
#
# For tests, tools and scenes, which take longer to compile than to run; with sanitizers for the layers too. Never for the
# layers as they are measured, so that what is inlined where does not depend on it. Off where one file is changed and
# compiled at a time. That a file does not lean on the standard headers of its neighbours is for tests/house.
option(SWEPT_UNITY "Compile tests, tools and scenes several files at once" OFF)

# Larger pieces save little more, and two jobs have to find work.
set(SWEPT_UNITY_FILES 6)

# swept_unite(TARGET)
function(swept_unite target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${SWEPT_UNITY} UNITY_BUILD_BATCH_SIZE ${SWEPT_UNITY_FILES})
endfunction()

# swept_unite_layer(TARGET): with sanitizers only.
function(swept_unite_layer target)
    if(CMAKE_BUILD_TYPE STREQUAL None)
        swept_unite(${target})
    endif()
endfunction()

# swept_compile_alone(FILE...): files with names that mean something else in their neighbours.
function(swept_compile_alone)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
