# SPDX-License-Identifier: MIT
#
# The promise: the package for the web installs from its tarball, its types hold, and its tests (bindings/js/) pass in Node.
#   BUILD: a build folder of emscripten. WORK: an own folder. SOURCE: the repository. SCENES: what print_scenes wrote. NPM, TSC. VERSION.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${said}")
  endif()
endfunction()

set(three ${SOURCE}/tests/gltf/node_modules/three)
if(NOT EXISTS ${three})
  message(FATAL_ERROR "three.js is missing; run: npm ci --prefix tests/gltf")
endif()
unset(ENV{SWIVEL_FORCE_ISA})
file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --build ${BUILD} --target swivel_wasm_package)
file(WRITE ${WORK}/package.json "{\"private\": true, \"type\": \"module\"}\n")
run(${NPM} install --offline --no-audit --no-fund ${BUILD}/tools/wasm/swivel-wasm-${VERSION}.tgz ${three})
file(GLOB tests ${SOURCE}/tests/bindings/js/*)
file(COPY ${tests} DESTINATION ${WORK})
run(${TSC} --noEmit --strict --target es2022 --module node16 --moduleResolution node16 types.ts)
run(${CMAKE_COMMAND} -E env SCENES=${SCENES} HEADER=${SOURCE}/include/swivel/swivel.h node --test)
