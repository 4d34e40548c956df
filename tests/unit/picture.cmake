# The pictures are made as a user makes them; 77 where the Debian packages of tools/picture are missing.
add_test(NAME test_picture COMMAND /usr/bin/python3 ${CMAKE_CURRENT_LIST_DIR}/test_picture.py)
set_tests_properties(test_picture PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300)
