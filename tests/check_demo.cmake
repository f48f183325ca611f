# SPDX-License-Identifier: MIT
# tools/demo gives its arguments on, and its standard output is the command's alone. Here it runs among stand-ins, which build nothing.
set(stage ${WORK}/check_demo)
file(REMOVE_RECURSE ${stage})
configure_file(${SOURCE}/tools/demo ${stage}/tools/demo COPYONLY)
file(WRITE ${stage}/tools/packages "build_packages=(one)\n")
file(WRITE ${stage}/build/release/build.ninja "")
function(stand_in path lines)
  file(WRITE ${stage}/${path} "#!/bin/sh\n${lines}\n")
  file(CHMOD ${stage}/${path} PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endfunction()
stand_in(tools/setup "echo setting up")
stand_in(bin/cmake "echo building")
stand_in(build/release/bin/swivel "echo swivel $*")

# expect(WORDS OUTPUT OPENS): OPENS: whether it says where the page is.
function(expect words output opens)
  execute_process(COMMAND ${CMAKE_COMMAND} -E env "PATH=${stage}/bin:$ENV{PATH}" ${stage}/tools/demo ${words}
                  OUTPUT_VARIABLE out ERROR_VARIABLE err RESULT_VARIABLE code)
  string(REGEX MATCH "swivel view --out build/demo.html --quiet\nopen +file://" opened "${err}")
  if(NOT err MATCHES "Building swivel \\(at first some minutes\\)")
    message(SEND_ERROR "tools/demo ${words}: does not say that it builds: '${err}'")
  endif()
  if(NOT code EQUAL 0 OR NOT out STREQUAL "${output}\n" OR (opens AND NOT opened) OR (opened AND NOT opens))
    message(SEND_ERROR "tools/demo ${words}: exit code ${code}, output '${out}', errors '${err}'; expected '${output}'")
  endif()
endfunction()
stand_in(tools/view/build "echo built")
expect("" "swivel demo" TRUE)
expect("--json" "swivel demo --json" TRUE)
expect("--view;mine.html" "swivel demo --view mine.html" FALSE)
expect("--view=mine.html" "swivel demo --view=mine.html" FALSE)
stand_in(tools/view/build "echo no npm\nexit 1")
expect("--json" "swivel demo --json" FALSE)

# Help builds nothing.
execute_process(COMMAND ${CMAKE_COMMAND} -E env "PATH=${stage}/bin:$ENV{PATH}" ${stage}/tools/demo --json --help
                OUTPUT_VARIABLE out ERROR_VARIABLE err RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR NOT out MATCHES "^usage: tools/demo .*\nswivel demo --help\n$" OR NOT err STREQUAL "")
  message(SEND_ERROR "tools/demo --json --help: exit code ${code}, output '${out}', errors '${err}'")
endif()
