strut_test(test_base SOURCES ${CMAKE_CURRENT_LIST_DIR}/test_base.cpp SEES base RANKS 1 2 3)
