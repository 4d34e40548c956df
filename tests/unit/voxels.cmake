# The Python tools are run as a user runs them; 77 says that their Debian packages are not there.
add_test(NAME test_voxels COMMAND /usr/bin/python3 ${CMAKE_CURRENT_SOURCE_DIR}/test_voxels.py)
set_tests_properties(test_voxels PROPERTIES SKIP_RETURN_CODE 77 ENVIRONMENT "STRUT_MESH=$<TARGET_FILE:strut-mesh>")
