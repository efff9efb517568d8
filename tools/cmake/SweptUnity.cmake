# Several sources compiled as one: what they include is read once for all of them. Included by the top-level list file only.
#
# What is measured is the same either way: with all of eight scenes in profile `fast` the layers took 1.001 of the time when
# they were compiled so (`swept bench world --of fastest`, four runs in turns), and half of the time to compile. Off where
# one file is changed and compiled at a time. That a file does not lean on the standard headers of its neighbours is for
# tests/house.
option(SWEPT_UNITY "Compile several files at once" OFF)

# Of half as many the release tree takes 276 files to compile instead of 242, each of which reads its precompiled headers (0.4
# to 1.1 s by GCC 12) and those of its layer (up to 3 s). Two jobs have to find work to the end.
set(SWEPT_UNITY_FILES 24)

# swept_unite(TARGET)
function(swept_unite target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${SWEPT_UNITY} UNITY_BUILD_BATCH_SIZE ${SWEPT_UNITY_FILES})
endfunction()

# swept_compile_alone(FILE...): files with names that mean something else in their neighbours.
function(swept_compile_alone)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
