strut_test(test_tool SOURCES ${CMAKE_CURRENT_LIST_DIR}/test_tool.cpp SEES conditions RANKS 1)
strut_test(test_condition_order SOURCES ${CMAKE_CURRENT_LIST_DIR}/test_condition_order.cpp SEES conditions RANKS 1)
