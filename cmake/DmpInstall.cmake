# Install rules: one export set per component, so that a static user of core never needs KDL.
include(CMakePackageConfigHelpers)

set(dmp_cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/dmp)

function(dmp_install component)
  install(TARGETS dmp_${component} EXPORT dmp_${component}-targets COMPONENT ${component}
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT dmp_${component}-targets NAMESPACE dmp:: DESTINATION ${dmp_cmake_dir} COMPONENT ${component})
endfunction()

dmp_install(core)
if(DMP_KINEMATICS)
  dmp_install(kinematics)
endif()
install(DIRECTORY ${PROJECT_SOURCE_DIR}/cpp/include/dmp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT core)

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/dmp-config.cmake.in ${PROJECT_BINARY_DIR}/dmp-config.cmake
                              INSTALL_DESTINATION ${dmp_cmake_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/dmp-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/dmp-config.cmake ${PROJECT_BINARY_DIR}/dmp-config-version.cmake
        DESTINATION ${dmp_cmake_dir} COMPONENT core)
