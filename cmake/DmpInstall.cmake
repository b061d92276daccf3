# Install rules: one export set and one pkg-config file per component, so that a user of core never needs KDL.
include(CMakePackageConfigHelpers)

set(dmp_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dmp)
set(dmp_pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

# Both package descriptions find the prefix from where they lie: an installed tree may be moved.
file(RELATIVE_PATH dmp_prefix_from_pkgconfig /prefix/${dmp_pkgconfig_dir} /prefix)
if(IS_ABSOLUTE "${CMAKE_INSTALL_LIBDIR}" OR IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
  message(FATAL_ERROR "CMAKE_INSTALL_LIBDIR and CMAKE_INSTALL_INCLUDEDIR must be relative to the prefix.")
endif()

# A static library leaves its own dependencies to the user's linker.
get_target_property(dmp_library_type dmp_core TYPE)
if(dmp_library_type STREQUAL "STATIC_LIBRARY")
  set(dmp_is_static ON)
  set(dmp_kinematics_requires "dmp = ${PROJECT_VERSION}, orocos-kdl, urdfdom")
else()
  set(dmp_is_static OFF)
  set(dmp_kinematics_requires "dmp = ${PROJECT_VERSION}")
endif()

function(dmp_install component package)
  install(TARGETS dmp_${component} EXPORT dmp_${component}-targets COMPONENT ${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT dmp_${component}-targets NAMESPACE dmp:: DESTINATION ${dmp_cmake_dir} COMPONENT ${component})
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${package}.pc.in ${PROJECT_BINARY_DIR}/${package}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${package}.pc DESTINATION ${dmp_pkgconfig_dir} COMPONENT ${component})
endfunction()

dmp_install(core dmp)
if(DMP_KINEMATICS)
  dmp_install(kinematics dmp_kinematics)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cpp/include/dmp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT core)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dmp-config.cmake.in ${PROJECT_BINARY_DIR}/dmp-config.cmake
                              INSTALL_DESTINATION ${dmp_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dmp-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dmp-config.cmake ${PROJECT_BINARY_DIR}/dmp-config-version.cmake
        DESTINATION ${dmp_cmake_dir} COMPONENT core)
