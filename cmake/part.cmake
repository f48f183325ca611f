# SPDX-License-Identifier: MIT
#
# swivel_part(library): how a part of the command compiles. The files of a part compile as one. So templates of Eigen, fmt and JSON are
# instantiated once. -O2 is enough, because the library solves.
function(swivel_part library)
  set_target_properties(${library} PROPERTIES UNITY_BUILD ${SWIVEL_UNITY} UNITY_BUILD_BATCH_SIZE 16)
  target_compile_options(${library} PRIVATE $<$<CONFIG:Release>:-O2>)
  if(TARGET swivel_headers)
    target_precompile_headers(${library} REUSE_FROM swivel_headers)
  endif()
endfunction()

# swivel_part_headers(): compiles the headers that most parts include, once for all parts. The builds with sanitizers and fuzzers and Python's own
# do not call it, and their parts compile the headers themselves.
function(swivel_part_headers)
  file(CONFIGURE OUTPUT part_headers.cpp CONTENT "" @ONLY)
  add_library(swivel_headers OBJECT ${CMAKE_CURRENT_BINARY_DIR}/part_headers.cpp)
  target_link_libraries(swivel_headers PRIVATE swivel_checked Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)
  target_compile_options(swivel_headers PRIVATE $<$<CONFIG:Release>:-O2>)
  target_precompile_headers(swivel_headers PRIVATE <Eigen/Geometry> <filesystem> <fmt/format.h> <fstream> <functional> <map>
                            <nlohmann/json.hpp> <optional> <ranges> <span>)
endfunction()
