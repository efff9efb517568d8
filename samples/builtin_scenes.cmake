# The built-in scenes without their reader and renderer, which need more of a system: what programs for other machines have
# of the samples (tests/portability). Double only, compiled once, whatever precision the engine behind has.
add_library(swept_builtin_scenes STATIC)
foreach(file scene_builder scene_geometry scene_names
             built_in/builtin_scenes built_in/scenes_belts built_in/scenes_continuous built_in/scenes_falling
             built_in/scenes_ground built_in/scenes_jointed built_in/scenes_machines)
    target_sources(swept_builtin_scenes PRIVATE ${CMAKE_CURRENT_LIST_DIR}/${file}.cpp)
endforeach()
swept_warnings(swept_builtin_scenes)
swept_optimise_little(swept_builtin_scenes)  # read once, and long to compile
swept_no_false_alarms(swept_builtin_scenes)
target_compile_features(swept_builtin_scenes PUBLIC cxx_std_20)
set_target_properties(swept_builtin_scenes PROPERTIES CXX_EXTENSIONS OFF)
target_compile_options(swept_builtin_scenes PUBLIC ${SWEPT_NO_FUSING})
target_include_directories(swept_builtin_scenes PUBLIC ${SWEPT_INCLUDE_DIR})
target_link_libraries(swept_builtin_scenes PRIVATE swept_shapes_f64)
