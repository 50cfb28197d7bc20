# Fails where a folder includes one that does not stand on a lower floor:  cmake -P cmake/check_floors.cmake
get_filename_component(root ${CMAKE_CURRENT_LIST_DIR}/.. ABSOLUTE)
set(floors core/base=0 core/la=1 core/mesh=1 core/fem=2 core/io=3 contact=4 transfer=4 fsi_solver=5 acoustic_solver=5
    coupling=6)
foreach(entry IN LISTS floors)
  string(REGEX MATCH "^(.*)=(.*)$" entry ${entry})
  set(folder ${CMAKE_MATCH_1})
  set(floor_${folder} ${CMAKE_MATCH_2})
  execute_process(COMMAND grep -rnoE "^ *# *include *\"[^\"]*" ${folder} WORKING_DIRECTORY ${root} OUTPUT_VARIABLE found)
  string(REGEX MATCHALL "[^\n]+" found "${found}")
  foreach(line IN LISTS found)
    string(REGEX MATCH "^([^:]*:[0-9]+):.*\"((core/)?[a-z_]+)?/?" line "${line}")
    set(other ${CMAKE_MATCH_2})
    if(NOT other STREQUAL folder AND NOT (DEFINED floor_${other} AND floor_${other} LESS floor_${folder}))
      message(FATAL_ERROR "${CMAKE_MATCH_1}: ${folder} must not include ${other}: that is not on a lower floor "
                          "(include by the path from the root)")
    endif()
  endforeach()
endforeach()
