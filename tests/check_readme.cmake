# SPDX-License-Identifier: MIT
#
# The promise: the README shows the program that the tests build and run.
file(READ ${SOURCE}/examples/hello.cpp hello)  # all but the comment at its head
string(REGEX REPLACE "^(//[^\n]*\n)+" "" hello "${hello}")
file(READ ${SOURCE}/README.md text)
string(FIND "${text}" "```cpp\n${hello}```" at)
if(at EQUAL -1)
  message(SEND_ERROR "README.md does not show examples/hello.cpp as it is; copy it there, without its comment for the build")
endif()
