# swept2d::f32 and swept2d::f64: all library layers of one precision. Included by the top-level list file, after the layers.

foreach(precision f32 f64)
    add_library(swept_${precision} INTERFACE)
    set_target_properties(swept_${precision} PROPERTIES EXPORT_NAME ${precision})
    add_library(swept2d::${precision} ALIAS swept_${precision})
    string(TOUPPER ${precision} upper)
    target_compile_definitions(swept_${precision} INTERFACE SWEPT_LINKS_${upper})  # both at once are refused (shapes/real.h)
    foreach(layer engine solver broadphase shapes)
        target_link_libraries(swept_${precision} INTERFACE swept_${layer}_${precision})
    endforeach()
    target_link_libraries(swept_${precision} INTERFACE swept_toi)
    set_property(GLOBAL APPEND PROPERTY SWEPT_EXPORTED_TARGETS swept_${precision})
endforeach()
