# SPDX-License-Identifier: MIT
#
# swivel_together(target size file...): compiles files together, `size` in a piece. Each file is in a namespace of its own, so files may use
# the same names. Its macros reach the files after it. A file with compile options of its own cannot be compiled together with others.
#
# The headers of all files come first, outside of the namespaces. They have #pragma once, so the includes inside of the files add nothing.
# A condition around an include comes along. There may be no #else, no #elif and no nested condition before the last include of a file.
function(swivel_together target size)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${ARGN})  # they may include another header
  set(files ${ARGN})
  while(files)
    list(SUBLIST files 0 ${size} some)
    list(REMOVE_ITEM files ${some})
    set(headers "")
    set(bodies "")
    foreach(file IN LISTS some)
      get_filename_component(path ${file} ABSOLUTE)
      get_filename_component(name ${path} NAME_WE)
      swivel_includes(of_file ${path})
      list(APPEND headers ${of_file})
      string(APPEND bodies "namespace file_${name} {\n#include \"${path}\"\n}\n")
    endforeach()
    list(REMOVE_DUPLICATES headers)
    list(JOIN headers "" headers)
    list(GET some 0 first)
    get_filename_component(name ${first} NAME_WE)
    set(together ${CMAKE_CURRENT_BINARY_DIR}/${target}_from_${name}.cpp)
    file(CONFIGURE OUTPUT ${together} CONTENT "${headers}${bodies}" @ONLY)
    target_sources(${target} PRIVATE ${together})
  endwhile()
endfunction()

# swivel_includes(result path): the includes of a file, each with the condition around it.
function(swivel_includes result path)
  get_filename_component(folder ${path} DIRECTORY)
  file(STRINGS ${path} lines REGEX "^#(include|if|else|elif|endif)")
  set(headers "")
  set(condition "")
  set(unknown "")  # the first line that this function cannot follow
  foreach(line IN LISTS lines)
    if(line MATCHES "^#include")
      if(unknown)
        message(FATAL_ERROR "${path}: '${unknown}' comes before the last include; compile this file by itself")
      endif()
      string(REGEX REPLACE "\"([^/]*)\"$" "\"${folder}/\\1\"" line "${line}")  # a neighbour
      if(condition)
        set(line "${condition}\n${line}\n#endif")
      endif()
      list(APPEND headers "${line}\n")
    elseif(line MATCHES "^#endif")
      set(condition "")
    elseif(line MATCHES "^#if" AND NOT condition)
      set(condition "${line}")
    elseif(NOT unknown)
      set(unknown "${line}")
    endif()
  endforeach()
  set(${result} ${headers} PARENT_SCOPE)
endfunction()
