# SPDX-License-Identifier: MIT
#
# The promise: the page that swivel view writes opens from disk, solves as the library does, and can be used (page/).
#   BUILD: a build folder of emscripten. SWIVEL: the command, of which a copy goes beside the page's program.
#   SOURCE: the repository. WORK: an own folder. NODE, CHROMIUM.
function(run)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${WORK} RESULT_VARIABLE result OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT result EQUAL 0)
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "failed (${result}): ${command}\n${said}")
  endif()
endfunction()

foreach(folder tests/page tools/view)
  if(NOT EXISTS ${SOURCE}/${folder}/node_modules)
    message(FATAL_ERROR "npm packages are missing; run: tools/npm_packages ${folder}")
  endif()
endforeach()
file(MAKE_DIRECTORY ${WORK}/share/swivel)
file(COPY ${SWIVEL} DESTINATION ${WORK}/bin)
get_filename_component(command ${SWIVEL} NAME)
run(${CMAKE_COMMAND} --build ${BUILD} --target swivel_wasm_package swivel_view)
run(${NODE} ${SOURCE}/tools/view/bundle.mjs ${BUILD}/tools/wasm ${WORK}/share/swivel/view.html)
run(${CMAKE_COMMAND} -E env SWIVEL=${WORK}/bin/${command} CHROMIUM=${CHROMIUM} WORK=${WORK} ${NODE} ${SOURCE}/tests/page/all.mjs)
