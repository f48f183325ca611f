# SPDX-License-Identifier: MIT
#
# The package scripts include this. It builds programs outside the tree, and checks the command lines of their compiler and linker.
#   CC, CXX: compilers. GENERATOR. EXPECTED: swivel's own build of arm.c, whose line every program must print.

# Runs a command and fills `output`. If the command fails, the script ends with everything that it said.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${said}")
  endif()
  set(output "${said}" PARENT_SCOPE)
endfunction()

# Configures and builds a project anew. `commands` becomes the lines that compiled and linked arm.c and arm.cpp. The remaining
# arguments go to the configuration.
function(build_host source build)
  file(REMOVE_RECURSE ${build})
  run(${CMAKE_COMMAND} -G ${GENERATOR} -S ${source} -B ${build} -DCMAKE_C_COMPILER=${CC} -DCMAKE_CXX_COMPILER=${CXX} ${ARGN})
  run(${CMAKE_COMMAND} --build ${build} --verbose)
  string(REGEX MATCHALL "[^\n]*/arm[.]c[^\n]*" commands "${output}")
  list(JOIN commands "\n" commands)
  set(commands "${commands}" PARENT_SCOPE)
endfunction()

# A program of the host must print the same line as swivel's own build, so its bits are the same.
run(${EXPECTED})
set(expected_line "${output}")
function(must_print_the_line program)
  run(${program})
  if(NOT output STREQUAL expected_line)
    message(SEND_ERROR "${program} prints\n${output}instead of\n${expected_line}")
  endif()
endfunction()

# Some words of the commands start as the first regex says. Each of them must match the second regex, `allowed`, as a whole. There must be
# at least one.
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

# Makes a regex that matches just this text.
function(quote text variable)
  string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" quoted "${text}")
  set(${variable} "${quoted}" PARENT_SCOPE)
endfunction()
