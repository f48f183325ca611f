# SPDX-License-Identifier: MIT
#
# The promise: the linker cannot hand one instruction set's code to another. The two objects of an instruction set's kernels define
# one strong symbol each, their tables, and every function that other objects might define, too, carries the instruction set in its
# name.
#   NM: the tool; OBJECTS: name=object|object,...; DEBUG: 1 for a build without optimisation
string(REPLACE "," ";" isas "${OBJECTS}")
if(NOT isas)
  message(FATAL_ERROR "OBJECTS is empty")
endif()

foreach(entry IN LISTS isas)
  string(REGEX REPLACE "=.*" "" isa "${entry}")
  string(REGEX REPLACE "^[^=]*=" "" objects "${entry}")
  string(REPLACE "|" ";" objects "${objects}")
  execute_process(COMMAND ${NM} --defined-only ${objects} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${NM} ${objects} failed: ${errors}")
  endif()
  string(REGEX MATCHALL "[0-9a-f]+ [A-Zu] [^\n]+" symbols "${output}")
  string(LENGTH ${isa} length)
  set(table "_ZN6swivel${length}${isa}1[12](arm|limb)_kernelsE")
  set(table_count 0)
  set(shared_count 0)
  foreach(symbol IN LISTS symbols)
    string(REGEX REPLACE "^[0-9a-f]+ ([A-Zu]) (.*)$" "\\1;\\2" parts "${symbol}")
    list(GET parts 0 kind)
    list(GET parts 1 name)
    if(NOT kind MATCHES "[WVu]")
      if(name MATCHES "^${table}$")
        math(EXPR table_count "${table_count} + 1")
      else()
        message(SEND_ERROR "${isa}: a strong symbol besides the tables: ${name}")
      endif()
    # The namespace of the instruction set, or xsimd's architecture of that name, as a part of the mangled name.
    elseif(NOT name MATCHES "[0-9]${isa}|simd_${isa}" AND NOT "${isa} ${name}" MATCHES "^avx2 .*3avxE")
      # Without optimisation one-line functions of other libraries stay: xsimd's constant -0.0f, std::bit_cast, std::sqrt...
      if(NOT (DEBUG AND name MATCHES "^_ZN5xsimd9constants9minuszeroIfEE|^_ZSt[0-9]+(bit_castIfj|fabsf|sqrtf|signbitf|copysignf)"))
        message(SEND_ERROR "${isa}: a shared function without the instruction set in its name: ${name}")
      endif()
    else()
      math(EXPR shared_count "${shared_count} + 1")
    endif()
  endforeach()
  if(NOT table_count EQUAL 2)
    message(SEND_ERROR "${isa}: ${table_count} tables ${table} instead of two in ${objects}")
  endif()
  message(STATUS "${isa}: its tables and ${shared_count} functions of its own name")
endforeach()
