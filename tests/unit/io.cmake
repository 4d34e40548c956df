strut_test(test_io SOURCES test_io.cpp test_io_broken_files.cpp test_node_points.cpp test_cells.cpp SEES io points RANKS 1 2 3)
