# What `cmake --install` lays down, and the package that find_package(swept2d) finds. Included by the top-level list file.
#
# Everything is in the component `swept2d`, so that the library can be installed without building the rest:
#     cmake --install build --component swept2d --prefix <where>
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(exported GLOBAL PROPERTY SWEPT_EXPORTED_TARGETS)
# What needs oneTBB is exported on its own, so that the rest is found without it.
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/swept2d)
if(TARGET swept_tbb)
    list(REMOVE_ITEM exported swept_tbb)
    install(TARGETS swept_tbb EXPORT swept2d_tbb_targets
            ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT swept2d
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT swept2d
            INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
    install(EXPORT swept2d_tbb_targets NAMESPACE swept2d:: DESTINATION ${package_dir} COMPONENT swept2d)
endif()
install(TARGETS ${exported} EXPORT swept2d_targets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT swept2d
        LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT swept2d
        INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# The headers that users may include, and what these include: of the engine its face alone. All others stay here.
foreach(layer shapes broadphase toi engine)
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/${layer}/*.h)
    install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/swept/${layer} COMPONENT swept2d)
endforeach()

install(EXPORT swept2d_targets NAMESPACE swept2d:: DESTINATION ${package_dir} COMPONENT swept2d)

# A layer that links a foreign library names its package in this property, and the package finds it for its users.
get_property(foreign_packages GLOBAL PROPERTY SWEPT_FOREIGN_PACKAGES)
set(SWEPT_FIND_DEPENDENCIES "")
foreach(package IN LISTS foreign_packages)
    string(APPEND SWEPT_FIND_DEPENDENCIES "find_dependency(${package})\n")
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/swept2d-config.cmake.in
                              ${PROJECT_BINARY_DIR}/swept2d-config.cmake
                              INSTALL_DESTINATION ${package_dir})
# Before 1.0 a new minor version may break users.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/swept2d-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/swept2d-config.cmake ${PROJECT_BINARY_DIR}/swept2d-config-version.cmake
        DESTINATION ${package_dir} COMPONENT swept2d)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT swept2d)
