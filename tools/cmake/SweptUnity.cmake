# Several sources compiled as one: what they include is read once for all of them. Included by the top-level list file only.
#
# What is measured is the same either way: with all of eight scenes in profile `fast` the layers took 1.001 of the time when
# they were compiled so (`swept bench world --of fastest`, four runs in turns), and half of the time to compile. Off where
# one file is changed and compiled at a time. That a file does not lean on the standard headers of its neighbours is for
# tests/house.
option(SWEPT_UNITY "Compile several files at once" OFF)

# At most so many. Of 24 the release tree took 634 s to compile on two cores, of these (and with fewer programs of tests and
# fewer precompiled headers) 527 to 541; what is measured took 0.999 of the time (as above, three runs in turns). The compiler
# takes up to 0.8 GB for one of them.
set(SWEPT_UNITY_FILES 36)

# swept_unite(TARGET): in groups of about the same size. Sources that the target is given afterwards are compiled alone.
function(swept_unite target)
    set_target_properties(${target} PROPERTIES UNITY_BUILD ${SWEPT_UNITY} UNITY_BUILD_MODE GROUP)
    get_target_property(sources ${target} SOURCES)
    set(together "")
    foreach(source IN LISTS sources)
        get_source_file_property(group ${source} SWEPT_GROUP)
        get_source_file_property(is_alone ${source} SKIP_UNITY_BUILD_INCLUSION)
        if(group)
            set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
        elseif(NOT is_alone)
            list(APPEND together ${source})
        endif()
    endforeach()
    list(LENGTH together count)
    math(EXPR groups "(${count} + ${SWEPT_UNITY_FILES} - 1) / ${SWEPT_UNITY_FILES}")
    set(index 0)
    foreach(source IN LISTS together)
        math(EXPR group "${index} * ${groups} / ${count}")
        set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${group})
        math(EXPR index "${index} + 1")
    endforeach()
endfunction()

# swept_compile_alone(FILE...): files with names that mean something else in their neighbours.
function(swept_compile_alone)
    set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# swept_compile_apart(NAME FILE...): these together, and nothing else with them.
function(swept_compile_apart name)
    set_source_files_properties(${ARGN} PROPERTIES SWEPT_GROUP ${name})
endfunction()
