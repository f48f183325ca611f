# SPDX-License-Identifier: MIT
#
# Building programs outside the tree, and looking at what their compiler and linker are told. Included by the package scripts.
#   CC, CXX: compilers; GENERATOR; EXPECTED: swivel's own build of arm.c, whose line every program must print

# Runs a command; ends the script with all it said if it fails. Fills `output`.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${said}")
  endif()
  set(output "${said}" PARENT_SCOPE)
endfunction()

# Configures and builds a project anew; `commands` becomes what compiled and linked arm.c and arm.cpp, line by line. Remaining
# arguments: for the configuration.
function(build_host source build)
  file(REMOVE_RECURSE ${build})
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${source} -B ${build} -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  run(${CMAKE_COMMAND} --build ${build} --verbose)
  string(REGEX MATCHALL "[^\n]*/arm[.]c[^\n]*" commands "${output}")
  list(JOIN commands "\n" commands)
  set(commands "${commands}" PARENT_SCOPE)
endfunction()

# A program of the host's prints the line of swivel's own build: the same bits.
run(${EXPECTED})
set(expected_line "${output}")
function(must_print_the_line program)
  run(${program})
  if(NOT output STREQUAL expected_line)
    message(SEND_ERROR "${program} prints\n${output}instead of\n${expected_line}")
  endif()
endfunction()

# Words of the commands that start as one regex says must each match another, `allowed`, wholly. There must be some.
function(must_say_only what commands words allowed)
  string(REGEX MATCHALL "[ \n](${words})[^ \n]*" found "${commands}")
  if(NOT found)
    message(SEND_ERROR "no word of ${what} starts as ${words}:\n${commands}")
  endif()
  list(TRANSFORM found STRIP)
  list(REMOVE_DUPLICATES found)
  foreach(option IN LISTS found)
    if(NOT option MATCHES "^(${allowed})$")
      message(SEND_ERROR "${what} says ${option}")
    endif()
  endforeach()
endfunction()

# A regex for a text as it is.
function(quote text variable)
  string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" quoted "${text}")
  set(${variable} "${quoted}" PARENT_SCOPE)
endfunction()
