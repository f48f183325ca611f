# SPDX-License-Identifier: MIT
#
# The promise: a CPU of another family gives the same bits. This script builds the library for 64-bit ARM in BUILD. It runs print_digest
# under an emulator with each of ISAS, neon64 and scalar, and compares the digests with tools/corpus/golden.h.
#   BUILD: an own folder. XSIMD: the folder of xsimd's headers. OPTIMISATION: flags, on which the bits do not depend.
foreach(tool aarch64-linux-gnu-gcc aarch64-linux-gnu-g++ qemu-aarch64-static)
  find_program(found_${tool} ${tool})
  if(NOT found_${tool})
    message(FATAL_ERROR "${tool} is missing; install the Debian packages g++-aarch64-linux-gnu and qemu-user-static")
  endif()
endforeach()

# kGoldenDigests has lines such as "    0x0123456789abcdefu,  // ordinary".
set(golden "")
foreach(part ordinary hard limbs)
  file(STRINGS ${SOURCE}/tools/corpus/golden.h line REGEX "^ *0x[0-9a-f]+u, *// ${part}$")
  string(REGEX REPLACE ".*0x([0-9a-f]+)u.*" "\\1" digest "${line}")
  string(LENGTH "${digest}" digits)
  if(NOT digits EQUAL 16)
    message(FATAL_ERROR "no 16 digits of part ${part} in tools/corpus/golden.h: '${line}'")
  endif()
  string(APPEND golden " ${digest}")
endforeach()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN} failed (${result}):\n${output}")
  endif()
endfunction()

run(${CMAKE_COMMAND} -S ${SOURCE} -B ${BUILD} -DCMAKE_BUILD_TYPE=Release
    "-DCMAKE_CXX_FLAGS_RELEASE=${OPTIMISATION} -DNDEBUG" -DCMAKE_SYSTEM_NAME=Linux
    -DCMAKE_SYSTEM_PROCESSOR=aarch64 -DCMAKE_C_COMPILER=${found_aarch64-linux-gnu-gcc}
    -DCMAKE_CXX_COMPILER=${found_aarch64-linux-gnu-g++} -DSWIVEL_XSIMD_DIR=${XSIMD} -DBUILD_SHARED_LIBS=OFF
    -DSWIVEL_TBB=OFF -DSWIVEL_TESTS=OFF -DSWIVEL_TOOLS=OFF -DSWIVEL_BENCH=OFF -DSWIVEL_SANITIZE=OFF)
run(${CMAKE_COMMAND} --build ${BUILD} --target swivel --parallel 2)
file(GLOB corpus ${SOURCE}/tools/corpus/*.cpp)
run(${found_aarch64-linux-gnu-g++} -std=c++20 -O2 -ffp-contract=off -static -I${SOURCE} -I${BUILD}/public
    ${SOURCE}/tests/print_digest.cpp ${corpus} ${BUILD}/libswivel.a -o ${BUILD}/print_digest)

foreach(isa IN LISTS ISAS)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env SWIVEL_FORCE_ISA=${isa} ${found_qemu-aarch64-static} ${BUILD}/print_digest
                  RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE errors OUTPUT_STRIP_TRAILING_WHITESPACE)
  if(NOT result EQUAL 0 OR NOT output STREQUAL "${isa}${golden}")
    message(SEND_ERROR "${isa}: expected '${isa}${golden}', got '${output}' ${errors} (${result})")
  else()
    message(STATUS "${output}")
  endif()
endforeach()
