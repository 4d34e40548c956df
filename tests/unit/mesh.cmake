# The tools are run as a user runs them.
strut_test(test_mesh SOURCES test_mesh.cpp SEES io points RANKS 1)
strut_test(test_compare SOURCES test_compare.cpp SEES io points RANKS 1)
add_dependencies(test_mesh strut-mesh)
add_dependencies(test_compare strut-compare)
target_compile_definitions(test_mesh PRIVATE STRUT_MESH="$<TARGET_FILE:strut-mesh>")
target_compile_definitions(test_compare PRIVATE STRUT_COMPARE="$<TARGET_FILE:strut-compare>")
