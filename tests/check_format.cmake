# SPDX-License-Identifier: MIT
#
# The promise: C++ and C files are laid out as .clang-format says.
find_program(CLANG_FORMAT NAMES clang-format clang-format-14)
if(NOT CLANG_FORMAT)
  message(FATAL_ERROR "clang-format is missing; install the Debian package clang-format")
endif()
file(GLOB_RECURSE files RELATIVE ${SOURCE} ${SOURCE}/include/* ${SOURCE}/core/* ${SOURCE}/simd/* ${SOURCE}/batch/*
     ${SOURCE}/lecture/* ${SOURCE}/tools/* ${SOURCE}/bench/* ${SOURCE}/tests/* ${SOURCE}/examples/* ${SOURCE}/docs/*)
list(FILTER files INCLUDE REGEX "[.](h|hpp|c|cpp)$")
list(FILTER files EXCLUDE REGEX "node_modules/|/build/")
list(LENGTH files count)
if(count EQUAL 0)
  message(FATAL_ERROR "no files found below ${SOURCE}")
endif()
execute_process(COMMAND ${CLANG_FORMAT} --style=file --dry-run -Werror ${files} WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE result
                OUTPUT_QUIET ERROR_VARIABLE said)
if(NOT result EQUAL 0)
  string(REGEX MATCHALL "[^\n:]+:[0-9]+:[0-9]+: error:" wrong "${said}")
  list(TRANSFORM wrong REPLACE ":.*" "")
  list(REMOVE_DUPLICATES wrong)
  list(JOIN wrong " " wrong)
  message(FATAL_ERROR "not laid out as .clang-format says; run: clang-format -i ${wrong}")
endif()
message(STATUS "${count} files")
