# SPDX-License-Identifier: MIT
#
# The promise: programs that a newcomer reads first, in the README and in docs/index.md, are those that are built and run.
function(check_shown page program code)
  file(READ ${SOURCE}/${page} text)
  string(FIND "${text}" "```cpp\n${code}```" at)
  if(at EQUAL -1)
    message(SEND_ERROR "${page} does not show ${program} as it is; copy it there, without its comments for the build")
  endif()
endfunction()

file(READ ${SOURCE}/examples/hello.cpp hello)  # all but the comment at its head
string(REGEX REPLACE "^(//[^\n]*\n)+" "" hello "${hello}")
check_shown(README.md examples/hello.cpp "${hello}")

file(READ ${SOURCE}/docs/snippets/start.cpp start)  # between its marks
string(REGEX REPLACE "^.*// \\[shown\\]\n" "" start "${start}")
string(REGEX REPLACE "// \\[end\\]\n.*$" "" start "${start}")
check_shown(docs/index.md docs/snippets/start.cpp "${start}")
