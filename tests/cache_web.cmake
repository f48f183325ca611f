# SPDX-License-Identifier: MIT
#
# The promise: WebAssembly in Node computes the poses of a cache again, bit for bit (cache/replay.test.mjs).
#   BUILD: a build folder of emscripten. SWIVEL: the command. SOURCE: the repository.
if(NOT EXISTS ${SOURCE}/tests/cache/node_modules)
  message(FATAL_ERROR "npm packages are missing; run: tools/npm_packages tests/cache")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BUILD} --target swivel_wasm_package swivel_view OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
find_file(clip NAMES 01_01.bvh cmu_01_01_forward_jump.bvh PATHS $ENV{SWIVEL_TEST_DATA}/bvh /usr/share/assimp/models/BVH NO_DEFAULT_PATH REQUIRED)
execute_process(COMMAND ${CMAKE_COMMAND} -E env SWIVEL=${SWIVEL} CLIP=${clip} PACKAGE=${BUILD}/tools/wasm/package MODULE=${BUILD}/tools/wasm/swivel_view.wasm
                        node --test ${SOURCE}/tests/cache/replay.test.mjs
                RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${said}")
endif()
