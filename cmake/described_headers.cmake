# SPDX-License-Identifier: MIT
# The C headers, as tools/headers/describe has described them.
set(SWIVEL_DESCRIPTION_FILE ${CMAKE_CURRENT_LIST_DIR}/../tools/headers/headers.json)
file(READ ${SWIVEL_DESCRIPTION_FILE} SWIVEL_DESCRIPTION)
set(SWIVEL_HEADERS swivel swivel_bodies swivel_regions swivel_explain)  # they declare the library's functions

# swivel_described(variable place...): the names of what is described there, such as the functions of one header.
function(swivel_described variable)
  string(JSON count LENGTH "${SWIVEL_DESCRIPTION}" ${ARGN})
  set(names "")
  set(n 0)
  while(n LESS count)
    string(JSON name MEMBER "${SWIVEL_DESCRIPTION}" ${ARGN} ${n})
    list(APPEND names ${name})
    math(EXPR n "${n} + 1")
  endwhile()
  set(${variable} ${names} PARENT_SCOPE)
endfunction()

# swivel_functions(variable): the names of the library's functions.
function(swivel_functions variable)
  set(all "")
  foreach(header IN LISTS SWIVEL_HEADERS)
    swivel_described(functions ${header} functions)
    list(APPEND all ${functions})
  endforeach()
  set(${variable} ${all} PARENT_SCOPE)
endfunction()
