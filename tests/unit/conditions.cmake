strut_test(test_tool SOURCES ${CMAKE_CURRENT_LIST_DIR}/test_tool.cpp SEES conditions RANKS 1)
