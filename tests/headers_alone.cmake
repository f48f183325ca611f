# SPDX-License-Identifier: MIT
#
# Core and public headers compile alone. check_layers tests that every other header comes first in its own file.
file(GLOB headers RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/core/*.h ${PROJECT_SOURCE_DIR}/include/swivel/*.h*)
add_library(header_check OBJECT)
foreach(header IN LISTS headers)
  string(MAKE_C_IDENTIFIER ${header} unit)
  file(CONFIGURE OUTPUT header_check/${unit}.cpp CONTENT "#include \"${header}\"\n" @ONLY)
  target_sources(header_check PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/header_check/${unit}.cpp)
endforeach()
# Most engines have neither exceptions nor run-time types.
set(all_of_cpp "")
foreach(header swivel swivel_bodies swivel_regions swivel_explain)
  string(APPEND all_of_cpp "#include \"include/swivel/${header}.hpp\"\n")
endforeach()
file(CONFIGURE OUTPUT header_check/engine.cpp CONTENT "${all_of_cpp}" @ONLY)
set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/header_check/engine.cpp PROPERTIES COMPILE_OPTIONS "-fno-exceptions;-fno-rtti")
# For Microsoft's compiler __cplusplus is that of C++98. The headers of the standard library come before it, because they ask for it, too.
file(STRINGS ${PROJECT_SOURCE_DIR}/include/swivel/swivel.hpp standard REGEX "^#include <")
list(JOIN standard "\n" standard)
file(CONFIGURE OUTPUT header_check/microsoft_standard.cpp CONTENT "${standard}
#undef __cplusplus
#define __cplusplus 199711L
#define _MSVC_LANG 202002L
${all_of_cpp}static_assert(sizeof(swivel::Job) > 0);\n" @ONLY)
set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/header_check/microsoft_standard.cpp PROPERTIES COMPILE_OPTIONS -Wno-builtin-macro-redefined)
target_sources(header_check PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/header_check/engine.cpp ${CMAKE_CURRENT_BINARY_DIR}/header_check/microsoft_standard.cpp)
target_link_libraries(header_check PRIVATE swivel_flags)
target_compile_options(header_check PRIVATE -O0)
# The public headers are for other compilers, too. clang can read them as Microsoft's does; __int128 is what that one lacks.
if(CMAKE_CXX_COMPILER_ID MATCHES Clang)
  string(REPLACE ".hpp" ".h" all_of_c "${all_of_cpp}")
  file(CONFIGURE OUTPUT header_check/microsoft_h.c CONTENT "${all_of_c}" @ONLY)
  file(CONFIGURE OUTPUT header_check/microsoft_h.cpp CONTENT "${all_of_c}" @ONLY)
  file(CONFIGURE OUTPUT header_check/microsoft_hpp.cpp CONTENT "${all_of_cpp}" @ONLY)
  foreach(unit h.c h.cpp hpp.cpp)
    list(APPEND microsoft_units ${CMAKE_CURRENT_BINARY_DIR}/header_check/microsoft_${unit})
  endforeach()
  add_library(header_check_microsoft OBJECT ${microsoft_units})
  target_include_directories(header_check_microsoft PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_options(header_check_microsoft PRIVATE -O0 -Wgnu -pedantic -Werror -Wno-\#warnings -fms-extensions -fms-compatibility
                         -fms-compatibility-version=19.30 -U__SIZEOF_INT128__ -Dnear= -Dfar=)  # as windows.h has them
  # In this mode clang does not define what libstdc++'s <atomic> asks for.
  target_compile_definitions(header_check_microsoft PRIVATE __GCC_ATOMIC_TEST_AND_SET_TRUEVAL=1)
  foreach(type BOOL CHAR CHAR8_T CHAR16_T CHAR32_T WCHAR_T SHORT INT LONG LLONG POINTER)
    target_compile_definitions(header_check_microsoft PRIVATE __GCC_ATOMIC_${type}_LOCK_FREE=2)
  endforeach()
endif()
