# SPDX-License-Identifier: MIT
#
# swivel_piece(target name file...): adds files to a target that compile as one, in a piece of this name. Files that are added otherwise
# compile alone. Without SWIVEL_UNITY all do.
function(swivel_piece target name)
  target_sources(${target} PRIVATE ${ARGN})
  set_source_files_properties(${ARGN} PROPERTIES UNITY_GROUP ${name})
  set_target_properties(${target} PROPERTIES UNITY_BUILD ${SWIVEL_UNITY} UNITY_BUILD_MODE GROUP)
endfunction()
