# What keeps a developer's builds short; no file that is installed depends on it.

# dmp_precompile(TARGET HEADER...): parses these headers once for all sources of TARGET.
function(dmp_precompile target)
  if(DMP_PRECOMPILE AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    target_precompile_headers(${target} PRIVATE ${ARGN})
  endif()
endfunction()

# dmp_precompiled_by(TARGET OTHER): TARGET takes what was precompiled for OTHER, with the same options.
function(dmp_precompiled_by target other)
  if(DMP_PRECOMPILE AND NOT CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache")
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()

# dmp_compile_quickly(TARGET): a test or an example calls the optimized library; optimizing its own code takes the
# compiler twice as long and gains nothing.
function(dmp_compile_quickly target)
  target_compile_options(${target} PRIVATE $<$<CONFIG:Release,Checked>:-O0>)
endfunction()

# dmp_test_of_core(TEST EXECUTABLE): the target core_tests builds it and `ctest -L core` runs it, without the arm's library.
function(dmp_test_of_core test executable)
  if(NOT TARGET core_tests)
    add_custom_target(core_tests)
  endif()
  add_dependencies(core_tests ${executable})
  set_tests_properties(${test} PROPERTIES LABELS core)
endfunction()
