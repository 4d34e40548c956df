# The tools are run as a user runs them.
foreach(test IN ITEMS test_mesh test_mesh_arrays)
  strut_test(${test} SOURCES ${test}.cpp SEES io points RANKS 1)
  add_dependencies(${test} strut-mesh)
  target_compile_definitions(${test} PRIVATE STRUT_MESH="$<TARGET_FILE:strut-mesh>")
endforeach()
strut_test(test_compare SOURCES test_compare.cpp SEES io points RANKS 1)
add_dependencies(test_compare strut-compare)
target_compile_definitions(test_compare PRIVATE STRUT_COMPARE="$<TARGET_FILE:strut-compare>")
