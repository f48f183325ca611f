# SPDX-License-Identifier: MIT
#
# swivel_together(target size file...): compiles files together, `size` in a piece, which takes a fraction of the time. Each is in a
# namespace of its own, so files may use the same names. The headers that any of them includes come first, outside. Files with compile
# options of their own are not for this.
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
      get_filename_component(folder ${path} DIRECTORY)
      get_filename_component(name ${path} NAME_WE)
      file(STRINGS ${path} lines REGEX "^#(include|if|endif)")
      set(condition "")  # an include that one system needs stays under its condition
      foreach(line IN LISTS lines)
        if(line MATCHES "^#if")
          set(condition "${line}\n")
        elseif(line MATCHES "^#endif")
          set(condition "")
        else()
          string(REGEX REPLACE "\"([^/]*)\"$" "\"${folder}/\\1\"" line "${line}")  # a neighbour
          if(condition)
            set(line "${condition}${line}\n#endif")
          endif()
          list(APPEND headers "${line}\n")
        endif()
      endforeach()
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
