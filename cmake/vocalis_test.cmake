# vocalis_test(FOLDER LINK targets... RANKS n... LABELS label...): tests tagged [serial] run on one rank only.
# Hidden tests, [.], must be left out by name beside another filter.
function(vocalis_test name)
  cmake_parse_arguments(ARG "" "" "LINK;RANKS;LABELS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp
       ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${name} ${sources})
  target_link_libraries(test_${name} PRIVATE vocalis_test_main ${ARG_LINK})
  target_compile_definitions(test_${name} PRIVATE VOCALIS_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  foreach(ranks IN LISTS ARG_RANKS)
    set(filter "")
    if(ranks GREATER 1)
      set(filter "~[serial]~[.]")
    endif()
    add_test(NAME ${name}_${ranks} COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:test_${name}> ${filter})
    set_tests_properties(${name}_${ranks} PROPERTIES PROCESSORS ${ranks} TIMEOUT 600 LABELS "${ARG_LABELS}"
                         ENVIRONMENT "${VOCALIS_TEST_ENVIRONMENT}")
  endforeach()
endfunction()

# vocalis_long_test(FOLDER RANKS n TAG tag): registers the hidden tests with this tag under the label `long`.
function(vocalis_long_test name)
  cmake_parse_arguments(ARG "" "RANKS;TAG" "" ${ARGN})
  add_test(NAME ${name}_${ARG_TAG} COMMAND ${MPIEXEC_EXECUTABLE} -n ${ARG_RANKS} $<TARGET_FILE:test_${name}> "[${ARG_TAG}]")
  set_tests_properties(${name}_${ARG_TAG} PROPERTIES PROCESSORS ${ARG_RANKS} TIMEOUT 7200 LABELS long
                       ENVIRONMENT "${VOCALIS_TEST_ENVIRONMENT}")
endfunction()
