strut_test(output_reference SOURCES test_output_reference.cpp SEES output RANKS 1)
