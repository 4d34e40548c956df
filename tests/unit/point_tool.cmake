# The driver of one material point, run as a user runs it.
strut_test(test_point_tool SOURCES test_point_tool.cpp RANKS 1)
add_dependencies(test_point_tool strut-point)
target_compile_definitions(test_point_tool PRIVATE STRUT_POINT="$<TARGET_FILE:strut-point>")
