# SPDX-License-Identifier: MIT
#
# The promise: cmake/hardening.cmake gives programs and libraries what tools/release/hardened asks for, and that script misses nothing that
# is left out.
#   SOURCE: the repository. WORK: an own folder. GENERATOR, CC, CXX.
cmake_minimum_required(VERSION 3.22)

file(REMOVE_RECURSE ${WORK})
set(configure -G ${GENERATOR} -S ${SOURCE}/tests/hardening -B ${WORK} -DCMAKE_BUILD_TYPE=Release -DCMAKE_C_COMPILER=${CC}
              -DCMAKE_CXX_COMPILER=${CXX} -DHARDENING=${SOURCE}/cmake/hardening.cmake)
foreach(step "${configure}" "--build;${WORK}")
  execute_process(COMMAND ${CMAKE_COMMAND} ${step} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed: cmake ${step}\n${said}")
  endif()
endforeach()

# must_say(FILE REGEX): what the script says of the file. An empty regex: it finds nothing.
function(must_say file regex)
  execute_process(COMMAND ${SOURCE}/tools/release/hardened ${WORK}/${file} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  string(REGEX MATCHALL "\n" lines "${said}")
  list(LENGTH lines count)
  if(regex AND (result EQUAL 0 OR NOT said MATCHES "${regex}" OR NOT count EQUAL 1))
    message(SEND_ERROR "of ${file}, which lacks one thing, tools/release/hardened says (${result}): ${said}")
  elseif(NOT regex AND NOT "${result}${said}" STREQUAL "0")
    message(SEND_ERROR "of ${file} tools/release/hardened says (${result}): ${said}")
  endif()
endfunction()
must_say(program "")
must_say(liblibrary.so "")
must_say(no_pie "lacks addresses .* -pie")
must_say(no_relro "lacks tables .* -z relro")
must_say(no_now "lacks binding .* -z now")
must_say(no_guard "lacks guards .* -fstack-protector-strong")
must_say(no_checks "lacks checks of calls of fprintf; .* -D_FORTIFY_SOURCE=3")
