# SPDX-License-Identifier: MIT
#
# The promise: the README's program is examples/hello.cpp, which is built and run, but for the comment at its head.
file(READ ${SOURCE}/README.md readme)
file(READ ${SOURCE}/examples/hello.cpp hello)
string(REGEX REPLACE "^(//[^\n]*\n)+" "" hello "${hello}")
string(FIND "${readme}" "```cpp\n${hello}```" at)
if(at EQUAL -1)
  message(FATAL_ERROR "README.md does not show examples/hello.cpp as it is; copy it there, without the comment at its head")
endif()
