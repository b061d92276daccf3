# dmp_require(NAME DEBIAN_PACKAGE): find_package with one clear line when the package is missing.
macro(dmp_require name debian_package)
  find_package(${name} QUIET)
  if(NOT ${name}_FOUND)
    message(FATAL_ERROR "dmp needs ${name}, which was not found. On Debian or Ubuntu: apt install ${debian_package}")
  endif()
endmacro()

# dmp_add_library(COMPONENT OUTPUT_NAME NAME): the target dmp_COMPONENT, alias dmp::COMPONENT, from the sources
# listed for it in cpp/src/sources.cmake.
function(dmp_add_library component)
  cmake_parse_arguments(ARG "" "OUTPUT_NAME" "" ${ARGN})
  include(${PROJECT_SOURCE_DIR}/cpp/src/sources.cmake)
  set(target dmp_${component})
  list(TRANSFORM DMP_${component}_SOURCES PREPEND "${PROJECT_SOURCE_DIR}/cpp/src/")
  add_library(${target} ${DMP_${component}_SOURCES})
  add_library(dmp::${component} ALIAS ${target})
  set_target_properties(${target} PROPERTIES
    OUTPUT_NAME ${ARG_OUTPUT_NAME} EXPORT_NAME ${component} DEFINE_SYMBOL "" INSTALL_RPATH "$ORIGIN"
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR}
    CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/cpp/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${PROJECT_SOURCE_DIR}/cpp/src)
  target_compile_definitions(${target} PRIVATE DMP_VERSION="${PROJECT_VERSION}")
  # No contraction to fused multiply-add: the library's own arithmetic has the same bits on every processor.
  # Nobody replaces the library's functions at run time, so they may be inlined within it.
  target_compile_options(${target} PRIVATE -ffp-contract=off -fno-semantic-interposition -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion)
  if(component STREQUAL core)
    dmp_precompile(${target} <Eigen/Core> <Eigen/Geometry> <string> <vector>)
  else()
    dmp_precompiled_by(${target} dmp_core)
  endif()
endfunction()
