strut_test(test_pair_law SOURCES test_pair_law.cpp SEES contact RANKS 1)
